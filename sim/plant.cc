#include "sim/plant.h"

#include <cassert>
#include <cmath>

#include "sim/index.h"

namespace godobject::sim {
namespace {

/// Work of a wrench along a small displacement [J].
double work_of(const Wrench& F_M_R, const Motion& displacement) noexcept {
  return F_M_R.force.dot(displacement.translation) + F_M_R.torque.dot(displacement.rotation);
}

/// The model with a rigidly gripped hand: its mass is added to the payload.
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

/// The pose after `seconds`. Integrates the rotation vector like a position: angles within a step are small, and the
/// error is of the order of the step's third power.
Pose moved(const Pose& start, double seconds, const Motion& velocity) noexcept {
  return {exp_rotation(seconds * velocity.rotation) * start.rotation,
          start.translation + seconds * velocity.translation};
}

Motion sum(const Motion& a, double factor, const Motion& b) noexcept {
  return {a.translation + factor * b.translation, a.rotation + factor * b.rotation};
}

}  // namespace

Plant::Plant(const ArmModel& model, const JointVector& q, const JointVector& dry_friction,
             const OperatorHand& hand) noexcept
    : arm_(with_hand(model, hand.parameters())), hand_(hand), dry_friction_(dry_friction), q_(q) {
  for (int i = 0; i < model.joint_count; ++i) damping_[i] = model.joints[at(i)].damping;
  if (hand.parameters().grip == Grip::kRigid) carried_R_.force = -hand.parameters().mass * model.gravity_R;
  hand_state_ = tool();
}

ArmPosture Plant::posture() const noexcept {
  ArmPosture posture;
  arm_.set_posture(q_, posture);
  return posture;
}

BodyState Plant::hand() const noexcept { return hand_.parameters().grip == Grip::kSpring ? hand_state_ : tool(); }

BodyState Plant::tool(const ArmPosture& posture, const JointVector& qd) const noexcept {
  return {arm_.tool_pose(posture), arm_.tool_velocity(posture, qd)};
}

JointVector Plant::gravity_torque() const noexcept {
  const ArmPosture here = posture();
  return arm_.bias_torque(here, JointVector::Zero()) - arm_.tool_torque(here, carried_R_);
}

double Plant::arm_energy() const noexcept {
  const ArmPosture here = posture();
  return arm_.kinetic_energy(here, qd_) + arm_.potential_energy(here);
}

double Plant::hand_energy() const noexcept {
  return hand_.energy(hand_.target(1e-9 * static_cast<double>(now_ns_)), hand_state_, tool());
}

Plant::Forces Plant::forces(const JointVector& qd, const BodyState& hand_state, const BodyState& target,
                            const JointVector& motor) const noexcept {
  const HandParameters& hand = hand_.parameters();
  Forces forces;
  forces.viscous = -damping_.cwiseProduct(qd);
  forces.applied = motor + forces.viscous - arm_.bias_torque(posture_, qd);
  Wrench F_M_R = tool_load_R_;
  if (hand.grip != Grip::kNone) {
    forces.hand = hand_.wrenches(target, hand_state, tool(posture_, qd));
    forces.hand.F_M_R.force += carried_R_.force;
    F_M_R.force += forces.hand.F_M_R.force;
    F_M_R.torque += forces.hand.F_M_R.torque;
  }
  if (hand.grip == Grip::kSpring) {
    forces.hand_acceleration.translation = (forces.hand.F_H_R.force - forces.hand.F_M_R.force) / hand.mass;
    forces.hand_acceleration.rotation = (forces.hand.F_H_R.torque - forces.hand.F_M_R.torque) / hand.inertia;
  }
  forces.applied += arm_.tool_torque(posture_, F_M_R);
  return forces;
}

JointVector Plant::accelerations(const JointVector& applied, const Stick& stick) const noexcept {
  if (!stick.is_dry) return moving_.solve(applied);
  return stick.acceleration + moving_.solve(applied + stick.slip_torque - posture_.mass * stick.acceleration);
}

/// Coulomb's law for a step, a linear complementarity problem with bounds: each joint gets the acceleration that brings
/// it to rest by the end of the step or, if that takes more than the friction torque, the largest acceleration towards
/// rest. Solved by exchange from the solution of the step before: the joint that exceeds its friction most begins to
/// slip, and a joint that friction would drive beyond rest begins to stick.
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
  // usually one round, a few when a joint comes to rest or breaks away; 4 n bounds the time of a step
  for (int round = 0;; ++round) {
    moving_.factor(posture_.mass, n, stick.held);
    qdd = accelerations(applied, stick);
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

double Plant::dry_work(const JointVector& applied, const Stick& stick, const JointVector& qdd,
                       const JointVector& displacement) const noexcept {
  if (!stick.is_dry) return 0.0;
  double work = 0.0;
  for (int i = 0; i < joint_count(); ++i) {
    if (displacement[i] == 0.0) continue;
    const double torque = stick.held[at(i)] ? posture_.mass.row(i).dot(qdd) - applied[i] : stick.slip_torque[i];
    work += torque * displacement[i];
  }
  return work;
}

void Plant::add_work(const Forces& forces, const JointVector& motor, const JointVector& displacement,
                     const Motion& hand_displacement) noexcept {
  const Motion tool_displacement = arm_.tool_velocity(posture_, displacement);
  work_.motor += motor.cwiseProduct(displacement);
  work_.friction += forces.viscous.dot(displacement);
  work_.load += work_of(tool_load_R_, tool_displacement);
  if (hand_.parameters().grip == Grip::kNone) return;
  const Wrench& F_M_R = forces.hand.F_M_R;
  const Vector3 along = F_M_R.force.cwiseProduct(tool_displacement.translation);
  const Vector3 about = F_M_R.torque.cwiseProduct(tool_displacement.rotation);
  work_.hand.head<3>() += along;
  work_.hand.tail<3>() += about;
  const bool spring = hand_.parameters().grip == Grip::kSpring;
  work_.operator_arm += spring ? work_of(forces.hand.F_H_R, hand_displacement) : along.sum() + about.sum();
}

void Plant::step(std::int64_t duration_ns, const JointLoad& load) noexcept {
  assert(duration_ns > 0 && duration_ns <= kStep_ns);
  const double time = 1e-9 * static_cast<double>(now_ns_);
  const double h = 1e-9 * static_cast<double>(duration_ns);
  const JointVector& motor = load.motor;

  arm_.set_posture(q_ + 0.5 * h * qd_, posture_);
  BodyState hand = hand_state_;
  hand.pose = moved(hand_state_.pose, 0.5 * h, hand_state_.velocity);
  const BodyState target = hand_.target(time + 0.5 * h);
  const Forces begin = forces(qd_, hand, target, motor);
  JointVector qdd;
  const Stick stick = find_stick(h, begin.applied, dry_friction_ + load.brake, qdd);

  hand.velocity = sum(hand_state_.velocity, 0.5 * h, begin.hand_acceleration);
  const Forces middle = forces(qd_ + 0.5 * h * qdd, hand, target, motor);
  qdd = accelerations(middle.applied, stick);

  const JointVector displacement = h * qd_ + 0.5 * h * h * qdd;
  const Motion hand_mean = sum(hand_state_.velocity, 0.5 * h, middle.hand_acceleration);
  add_work(middle, motor, displacement, {h * hand_mean.translation, h * hand_mean.rotation});
  work_.friction += dry_work(middle.applied, stick, qdd, displacement);
  q_ += displacement;
  qd_ += h * qdd;
  for (int i = 0; i < joint_count(); ++i) {
    // a held joint is exactly at rest, and friction never drives a joint
    if (stick.held[at(i)] || qd_[i] * stick.slip_torque[i] > 0.0) qd_[i] = 0.0;
  }
  hand_state_.pose = moved(hand_state_.pose, h, hand_mean);
  hand_state_.pose.rotation.normalize();
  hand_state_.velocity = sum(hand_state_.velocity, h, middle.hand_acceleration);
  now_ns_ += duration_ns;
}

}  // namespace godobject::sim
