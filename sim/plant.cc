#include "sim/plant.h"

#include <cassert>
#include <cmath>

namespace godobject::sim {
namespace {

constexpr std::size_t at(int i) noexcept { return static_cast<std::size_t>(i); }

double power(const Wrench& wrench, const Motion& velocity) noexcept {
  return wrench.force.dot(velocity.translation) + wrench.torque.dot(velocity.rotation);
}

/// The hand is one body with the tool: its mass goes with the payload.
ArmModel with_hand(ArmModel model, const HandParameters& hand) noexcept {
  if (hand.grip != Grip::kRigid) return model;
  LinkMass& payload = model.payload;
  const double mass = payload.mass + hand.mass;
  const double reduced = payload.mass * hand.mass / mass;
  const Vector3& c = payload.com;
  payload.inertia +=
      hand.inertia * Matrix3::Identity() + reduced * (c.squaredNorm() * Matrix3::Identity() - c * c.transpose());
  payload.com = (payload.mass / mass * c).eval();
  payload.mass = mass;
  return model;
}

/// A time `seconds` on from `start`, at velocity and acceleration given; angles within a step are so small that a
/// rotation vector may be integrated like a position (its error is of the order of the step's fourth power).
BodyState moved(const BodyState& start, double seconds, const Motion& acceleration, const Motion& velocity) noexcept {
  BodyState state;
  const double square = 0.5 * seconds * seconds;
  state.pose.translation =
      start.pose.translation + seconds * start.velocity.translation + square * acceleration.translation;
  state.pose.rotation =
      exp_rotation(seconds * start.velocity.rotation + square * acceleration.rotation) * start.pose.rotation;
  state.velocity = velocity;
  return state;
}

Motion sum(const Motion& a, double factor, const Motion& b) noexcept {
  return {a.translation + factor * b.translation, a.rotation + factor * b.rotation};
}

}  // namespace

void PlantWork::add(double seconds, const PlantWork& power) noexcept {
  motor += seconds * power.motor;
  hand += seconds * power.hand;
  operator_arm += seconds * power.operator_arm;
  load += seconds * power.load;
  friction += seconds * power.friction;
}

Plant::Plant(const ArmModel& model, const JointVector& q, const JointVector& dry_friction,
             const OperatorHand& hand) noexcept
    : arm_(with_hand(model, hand.parameters())), hand_(hand), dry_friction_(dry_friction), q_(q) {
  for (int i = 0; i < model.joint_count; ++i) damping_[i] = model.joints[at(i)].damping;
  if (hand.parameters().grip == Grip::kRigid) carried_W_.force = -hand.parameters().mass * model.gravity_W;
  arm_.set_posture(q_, posture_);
  hand_state_ = tool();
  target_ = hand_.target(0.0);
}

BodyState Plant::tool(const ArmPosture& posture, const JointVector& qd) const noexcept {
  return {arm_.tool_pose(posture), arm_.tool_velocity(posture, qd)};
}

JointVector Plant::gravity_torque() const noexcept {
  return arm_.bias_torque(posture_, JointVector::Zero()) - arm_.tool_torque(posture_, carried_W_);
}

double Plant::arm_energy() const noexcept {
  return arm_.kinetic_energy(posture_, qd_) + arm_.potential_energy(posture_);
}

double Plant::hand_energy() const noexcept { return hand_.energy(target_, hand_state_, tool()); }

/// All torques but dry friction's, inertial ones included; what they and the hand do goes to `rates`.
JointVector Plant::applied_torque(const Instant& instant, const JointVector& motor, Rates& rates) const noexcept {
  const HandParameters& hand = hand_.parameters();
  const JointVector viscous = damping_.cwiseProduct(instant.qd);
  JointVector applied = motor - viscous - arm_.bias_torque(instant.posture, instant.qd);
  rates.power.motor = motor.cwiseProduct(instant.qd);
  rates.power.friction = -viscous.dot(instant.qd);

  const BodyState tool_state = tool(instant.posture, instant.qd);
  const Motion& velocity = tool_state.velocity;
  Wrench on_tool = tool_load_W_;
  rates.power.load = power(tool_load_W_, velocity);
  if (hand.grip != Grip::kNone) {
    HandWrenches wrenches = hand_.wrenches(instant.target, instant.hand, tool_state);
    wrenches.on_tool.force += carried_W_.force;
    on_tool.force += wrenches.on_tool.force;
    on_tool.torque += wrenches.on_tool.torque;
    rates.power.hand.head<3>() = wrenches.on_tool.force.cwiseProduct(velocity.translation);
    rates.power.hand.tail<3>() = wrenches.on_tool.torque.cwiseProduct(velocity.rotation);
    if (hand.grip == Grip::kSpring) {
      rates.hand.translation = (wrenches.on_hand.force - wrenches.on_tool.force) / hand.mass;
      rates.hand.rotation = (wrenches.on_hand.torque - wrenches.on_tool.torque) / hand.inertia;
      rates.power.operator_arm = power(wrenches.on_hand, instant.hand.velocity);
    } else {
      rates.power.operator_arm = rates.power.hand.sum();
    }
  }
  return applied + arm_.tool_torque(instant.posture, on_tool);
}

JointVector Plant::accelerations(const ArmPosture& posture, const JointVector& applied,
                                 const Stick& stick) const noexcept {
  if (!stick.is_dry) return moving_.solve(applied);
  return stick.acceleration + moving_.solve(applied + stick.slip_torque - posture.mass * stick.acceleration);
}

/// Coulomb's law for a step as a linear complementarity problem with bounds: each joint gets the acceleration that
/// brings it to rest by the end of the step, or, where the torque that this takes is out of reach, the greatest one
/// towards it. Found by exchange, from what held in the step before: the joint that is overcharged most slips, one that
/// its friction would drive beyond rest sticks.
Plant::Stick Plant::find_stick(double seconds, const JointVector& applied, const JointVector& capacity,
                               JointVector& qdd) noexcept {
  const int n = joint_count();
  const JointVector to_rest = -1.0 / seconds * qd_;
  Stick stick;
  for (int i = 0; i < n; ++i) {
    if (!(capacity[i] > 0.0)) continue;
    stick.is_dry = true;
    stick.held[at(i)] = last_slip_torque_[i] == 0.0;
    if (stick.held[at(i)]) {
      stick.acceleration[i] = to_rest[i];
    } else {
      stick.slip_torque[i] = std::copysign(capacity[i], last_slip_torque_[i]);
    }
  }
  // one round as a rule, a few where a joint comes to rest or breaks away; the bound keeps the time of a step
  for (int round = 0;; ++round) {
    moving_.factor(posture_.mass, n, stick.held);
    qdd = accelerations(posture_, applied, stick);
    if (!stick.is_dry || round == 4 * n) break;
    const JointVector needed = posture_.mass * qdd - applied;
    int exchanged = -1;
    double charge = 1.0;
    for (int i = 0; i < n; ++i) {
      if (stick.held[at(i)] && std::fabs(needed[i]) > charge * capacity[i]) {
        charge = std::fabs(needed[i]) / capacity[i];
        exchanged = i;
      }
    }
    for (int i = 0; i < n; ++i) {
      if (stick.slip_torque[i] * (qdd[i] - to_rest[i]) > 0.0) exchanged = i;
    }
    if (exchanged < 0) break;
    bool& held = stick.held[at(exchanged)];
    held = !held;
    stick.acceleration[exchanged] = held ? to_rest[exchanged] : 0.0;
    stick.slip_torque[exchanged] = held ? 0.0 : std::copysign(capacity[exchanged], needed[exchanged]);
  }
  last_slip_torque_ = stick.slip_torque;
  return stick;
}

double Plant::dry_power(const Instant& instant, const JointVector& applied, const Stick& stick,
                        const JointVector& qdd) const noexcept {
  if (!stick.is_dry) return 0.0;
  double power = 0.0;
  for (int i = 0; i < joint_count(); ++i) {
    if (instant.qd[i] == 0.0) continue;
    const double torque = stick.held[at(i)] ? instant.posture.mass.row(i).dot(qdd) - applied[i] : stick.slip_torque[i];
    power += torque * instant.qd[i];
  }
  return power;
}

Plant::Rates Plant::rates(const Instant& instant, const JointVector& motor, const Stick& stick) const noexcept {
  Rates rates;
  const JointVector applied = applied_torque(instant, motor, rates);
  rates.qdd = accelerations(instant.posture, applied, stick);
  rates.power.friction += dry_power(instant, applied, stick, rates.qdd);
  return rates;
}

void Plant::step(std::int64_t duration_ns, const JointLoad& load) noexcept {
  assert(duration_ns > 0 && duration_ns <= kStep_ns);
  const double time = 1e-9 * static_cast<double>(now_ns_);
  const double h = 1e-9 * static_cast<double>(duration_ns);
  const BodyState& hand = hand_state_;
  const JointVector& motor = load.motor;

  const Instant instant1{posture_, qd_, hand, target_};
  Rates k1;
  const JointVector applied = applied_torque(instant1, motor, k1);
  const Stick stick = find_stick(h, applied, dry_friction_ + load.brake, k1.qdd);
  k1.power.friction += dry_power(instant1, applied, stick, k1.qdd);

  // the second and third stage share positions
  const BodyState target2 = hand_.target(time + 0.5 * h);
  arm_.set_posture(q_ + 0.5 * h * qd_ + 0.125 * h * h * k1.qdd, stage_posture_);
  moving_.factor(stage_posture_.mass, joint_count(), stick.held);
  const JointVector qd2 = qd_ + 0.5 * h * k1.qdd;
  BodyState hand2 = moved(hand, 0.5 * h, k1.hand, sum(hand.velocity, 0.5 * h, k1.hand));
  const Rates k2 = rates({stage_posture_, qd2, hand2, target2}, motor, stick);
  const JointVector qd3 = qd_ + 0.5 * h * k2.qdd;
  hand2.velocity = sum(hand.velocity, 0.5 * h, k2.hand);
  const Rates k3 = rates({stage_posture_, qd3, hand2, target2}, motor, stick);

  target_ = hand_.target(time + h);
  arm_.set_posture(q_ + h * qd_ + 0.5 * h * h * k3.qdd, stage_posture_);
  moving_.factor(stage_posture_.mass, joint_count(), stick.held);
  const JointVector qd4 = qd_ + h * k3.qdd;
  const BodyState hand4 = moved(hand, h, k3.hand, sum(hand.velocity, h, k3.hand));
  const Rates k4 = rates({stage_posture_, qd4, hand4, target_}, motor, stick);

  q_ += h * qd_ + h * h / 6.0 * (k1.qdd + k2.qdd + k3.qdd);
  qd_ += h / 6.0 * (k1.qdd + 2.0 * (k2.qdd + k3.qdd) + k4.qdd);
  for (int i = 0; i < joint_count(); ++i) {
    // at rest to the last bit; and friction never drives a joint
    if (stick.held[at(i)] || qd_[i] * stick.slip_torque[i] > 0.0) qd_[i] = 0.0;
  }
  const Motion thirds = sum(sum(k1.hand, 1.0, k2.hand), 1.0, k3.hand);
  const Motion sixths = sum(sum(k1.hand, 1.0, k4.hand), 2.0, sum(k2.hand, 1.0, k3.hand));
  hand_state_ = moved(hand, h, {thirds.translation / 3.0, thirds.rotation / 3.0}, sum(hand.velocity, h / 6.0, sixths));
  hand_state_.pose.rotation.normalize();
  work_.add(h / 6.0, k1.power);
  work_.add(h / 3.0, k2.power);
  work_.add(h / 3.0, k3.power);
  work_.add(h / 6.0, k4.power);

  arm_.set_posture(q_, posture_);
  if (hand_.parameters().grip != Grip::kSpring) hand_state_ = tool();
  now_ns_ += duration_ns;
}

}  // namespace godobject::sim
