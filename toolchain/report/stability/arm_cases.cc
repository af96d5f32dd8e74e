#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "core/device/dynamics.h"
#include "core/device/stability.h"
#include "firmware/configuration/device_file.h"
#include "hal/cia402/bus_plan.h"
#include "hal/cia402/can_drives.h"
#include "sim/can_device.h"
#include "sim/direct_drives.h"
#include "toolchain/files/input_file.h"
#include "toolchain/report/stability/arm_work.h"
#include "toolchain/report/stability/axis_loop.h"
#include "toolchain/report/stability/bounds.h"
#include "toolchain/report/stability/cases.h"
#include "toolchain/report/stability/fast_buses.h"
#include "toolchain/report/study/result_file.h"

namespace godobject::report {
namespace {

namespace bound = stability_bound;

constexpr double kArmPeriod = 1e-3;  // [s]

std::int64_t nanoseconds(double seconds) { return std::llround(1e9 * seconds); }

/// Sampling and delay of an arm's loop [s].
struct ArmTiming {
  double period = kArmPeriod;
  double delay = 0.0;
};

/// The gains in use of an arm; those of the light desktop device are a sixteenth of the other's.
struct ArmGains {
  const char* device;
  Coupling coupling;
};
constexpr ArmGains kGains[] = {{"lwr", {}}, {"desktop6", {125.0, 0.5, 0.75, 0.003}}};

Coupling planted(Coupling coupling, const LoopFault& fault) {
  coupling.stiffness *= fault.gain;
  coupling.rotation_stiffness *= fault.gain;
  coupling.damping *= fault.gain * fault.damping_gain;
  coupling.rotation_damping *= fault.gain * fault.damping_gain;
  return coupling;
}

ArmLoop loop_at(const ArmModel& model, const JointVector& q, const Coupling& coupling, const ArmTiming& timing) {
  const ArmKinematics kinematics = forward_kinematics(model, q);
  ArmLoop loop;
  loop.joint_count = model.joint_count;
  loop.mass = mass_matrix(model, kinematics);
  for (int i = 0; i < model.joint_count; ++i) loop.damping[i] = model.joints.at(static_cast<std::size_t>(i)).damping;
  loop.jacobian = geometric_jacobian(kinematics, kinematics.H_RM.translation);
  loop.stiffness = coupling.stiffness;
  loop.rotation_stiffness = coupling.rotation_stiffness;
  loop.tool_damping = coupling.damping;
  loop.rotation_tool_damping = coupling.rotation_damping;
  loop.timing = {timing.period, timing.delay, 2};
  return loop;
}

/// The arm without weight (its compensation would be sampled and delayed too) on drives without rounding, in lock-step:
/// the plant advances only while the clock sleeps.
class CoupledArm {
 public:
  CoupledArm(const ArmModel& model, const JointVector& q, const Coupling& coupling, const ArmTiming& timing)
      : model_(model),
        coupling_(coupling),
        period_(timing.period),
        plant_(model, q),
        hardware_(ideal_hardware()),
        drives_(plant_, hardware_, {nanoseconds(timing.period), nanoseconds(timing.delay)}),
        clock_(drives_) {
    target_ = forward_kinematics(model, q).H_RM;
    // released a hundredth of a millimetre and of a milliradian away, in a random direction
    target_.translation += 1e-5 * Vector3(0.6, -0.5, 0.62);
    target_.rotation = exp_rotation(1e-5 * Vector3(-0.4, 0.7, 0.6)) * target_.rotation;
  }

  /// Runs `cycles` periods and returns the root of the coupling's largest energy.
  double swing(int cycles) {
    double most = 0.0;
    for (int i = 0; i < cycles; ++i) most = std::max(most, cycle());
    return most;
  }

 private:
  static std::array<sim::JointHardwareParameters, kMaxJoints> ideal_hardware() {
    std::array<sim::JointHardwareParameters, kMaxJoints> hardware;
    for (auto& joint : hardware) {
      joint.torque_limit = 1e6;
      joint.brake_open_ns = 0;
      joint.enable_ns = 0;
    }
    return hardware;
  }

  double cycle() {
    hal::JointReading reading;
    drives_.receive(reading);
    const ArmKinematics kinematics = forward_kinematics(model_, reading.position);
    Motion x;
    x.translation = kinematics.H_RM.translation - target_.translation;
    x.rotation = log_rotation(kinematics.H_RM.rotation * target_.rotation.conjugate());
    if (!started_) x_before_ = x;
    started_ = true;
    Eigen::Matrix<double, 6, 1> wrench;
    wrench << -coupling_.stiffness * x.translation -
                  coupling_.damping / period_ * (x.translation - x_before_.translation),
        -coupling_.rotation_stiffness * x.rotation -
            coupling_.rotation_damping / period_ * (x.rotation - x_before_.rotation);
    x_before_ = x;
    const Jacobian J = geometric_jacobian(kinematics, kinematics.H_RM.translation);
    static_cast<void>(drives_.send({J.transpose() * wrench, hal::PowerRequest::kEnable}));
    deadline_ns_ += nanoseconds(period_);
    clock_.sleep_until(deadline_ns_);
    return std::sqrt(coupling_.stiffness * x.translation.squaredNorm() +
                     coupling_.rotation_stiffness * x.rotation.squaredNorm());
  }

  ArmModel model_;
  Coupling coupling_;
  double period_;
  sim::Plant plant_;
  std::array<sim::JointHardwareParameters, kMaxJoints> hardware_;
  sim::DirectDrives drives_;
  sim::VirtualClock clock_;
  Pose target_;
  Motion x_before_;
  bool started_ = false;
  std::int64_t deadline_ns_ = 0;
};

/// Returns the share at which the growth, linear in between, passes zero; the arguments are shares and their growth.
double zero_between(double low, double grown_low, double high, double grown_high) {
  return low - grown_low * (high - low) / (grown_high - grown_low);
}

JointVector posture(const ArmModel& model, std::mt19937& random) {
  JointVector q = JointVector::Zero();
  for (int i = 0; i < model.joint_count; ++i) {
    const ArmJoint& joint = model.joints.at(static_cast<std::size_t>(i));
    std::uniform_real_distribution<double> within(0.3, 0.7);
    q[i] = joint.lower + within(random) * (joint.upper - joint.lower);
  }
  return q;
}

/// Returns the growth at 0.98 and 1.02 of the exact boundary.
std::array<double, 2> growth_at_boundary(const ArmModel& model, const JointVector& q, const Coupling& coupling,
                                         double margin, const ArmTiming& timing, const LoopFault& fault) {
  std::array<double, 2> grown{};
  for (std::size_t side = 0; side < 2; ++side) {
    const double share = side == 0 ? 0.98 : 1.02;
    Coupling scaled = coupling;
    scaled.stiffness *= share * margin;
    scaled.rotation_stiffness *= share * margin;
    CoupledArm arm(model, q, planted(scaled, fault), {timing.period, timing.delay + fault.late * timing.period});
    // the same times at shorter periods: swings are those of the arm
    const int a_millisecond = std::max(1, static_cast<int>(std::lround(kArmPeriod / timing.period)));
    arm.swing(1500 * a_millisecond);
    const double first = arm.swing(500 * a_millisecond);
    arm.swing(2500 * a_millisecond);
    grown[side] = std::log(arm.swing(500 * a_millisecond) / first);
  }
  return grown;
}

/// A4 on the whole matrix: finds the boundary between 0.98 and 1.02 of the exact one, at random postures.
CaseResult whole_arm(const firmware::Device& device, const Coupling& coupling, const StabilityRequest& request) {
  ArmModel model = device.model;
  model.gravity_R.setZero();
  CaseResult result;
  Sheet sheet{.name = "stability_arm",
              .columns = {"device", "posture", "t_d_ms", "margin_exact", "margin_simulated", "passivity_excess"},
              .rows = {}};
  std::mt19937 random(13 + request.seed);
  double wrong = 0.0;
  int loops = 0;
  for (int i = 0; i < (request.quick ? 1 : 4); ++i) {
    const JointVector q = posture(model, random);
    for (const double delay : {1e-3, 1.3e-3}) {
      const ArmTiming timing{.delay = delay};
      const ArmLoop loop = loop_at(model, q, coupling, timing);
      const double margin = stiffness_margin(loop);
      const auto grown = growth_at_boundary(model, q, coupling, margin, timing, request.fault);
      wrong += static_cast<double>(!(grown[0] < 0.0)) + static_cast<double>(!(grown[1] >= 0.0));
      const double measured = zero_between(0.98, grown[0], 1.02, grown[1]);
      const double in_use = stiffness_margin(loop_at(model, q, planted(coupling, request.fault), timing));
      const std::string where = fmt::format("{} posture {} t_d {} ms", device.name, i, 1e3 * delay);
      sheet.rows.push_back({device.name, std::to_string(i), cell(1e3 * delay), cell(margin), cell(measured * margin),
                            cell(passivity_excess(loop))});
      result.findings.push_back(judged(bound::kArm, kPercent * std::fabs(measured - 1.0), where));
      result.findings.push_back(judged(bound::kGainsInUse, 1.0 / in_use, where));
      result.findings.push_back({.row = "A13",
                                 .what = "gains in use: passivity excess (below 0: not passive)",
                                 .unit = "Nms",
                                 .value = passivity_excess(loop),
                                 .most = {},
                                 .where = where});
      ++loops;
    }
  }
  result.findings.push_back(judged(bound::kArmWrongSide, wrong, fmt::format("{} loops", loops)));
  result.sheets.push_back(sheet);
  return result;
}

/// A13, the linear rule: a hand moves the simulated arm slowly back and forth along the direction that the rule states
/// as the least passive. The rule's eigenvalue is the energy that the hand must supply, over that of 1 Nms/rad.
CaseResult passive_arm(const firmware::Device& device, const Coupling& coupling, const StabilityRequest& request) {
  CaseResult result;
  ArmModel model = device.model;
  model.gravity_R.setZero();
  Coupling spring = coupling;
  spring.damping = spring.rotation_damping = 0.0;
  std::mt19937 random(14 + request.seed);
  for (int i = 0; i < (request.quick ? 2 : 20); ++i) {
    const JointVector q = posture(model, random);
    for (const double delay : {0.0, 0.5e-3, 1.3e-3}) {
      const ArmLoop loop = loop_at(model, q, spring, {.delay = delay});
      const Eigen::Index n = loop.joint_count;
      Eigen::Matrix<double, 6, 1> k;
      k << Vector3::Constant(loop.stiffness), Vector3::Constant(loop.rotation_stiffness);
      const Eigen::MatrixXd J = loop.jacobian.leftCols(n);
      const Eigen::MatrixXd K = J.transpose() * k.asDiagonal() * J;
      Eigen::MatrixXd rule = -(0.5 * kArmPeriod + delay) * K;
      rule.diagonal() += loop.damping.head(n);
      JointVector way = JointVector::Zero();
      way.head(n) = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(rule).eigenvectors().col(0);
      const double measured =
          work_along(model, q, way, planted(spring, request.fault), delay + request.fault.late * kArmPeriod);
      const double stated = passivity_excess(loop);
      // relative to the larger of both terms, which cancel if the joints absorb the energy of the delay
      const double taken = way.dot(loop.damping.cwiseProduct(way));
      result.findings.push_back(
          judged(bound::kLeastPassive, kPercent * std::fabs(measured - stated) / std::max(taken, taken - stated),
                 fmt::format("{} t_d {} ms: {:.4g} of {:.4g} Nms", device.name, 1e3 * delay, measured, stated)));
    }
  }
  return result;
}

/// Independent rotors, each a joint on the device's own buses. Only the delay of the schedule lies between a position
/// and its torque. Each rotor's swing grows or decays within seconds, with half of its drive's torque.
ArmModel rotors(const hal::BusLayout& layout) {
  constexpr double kDampingOfTorque = 0.03;  // s/rad
  constexpr double kSettling = 0.5;          // m/b [s]
  ArmModel model;
  model.joint_count = layout.joint_count;
  for (int i = 0; i < layout.joint_count; ++i) {
    ArmJoint& joint = model.joints.at(static_cast<std::size_t>(i));
    joint.link = {1e-9, Vector3::Zero(), Matrix3::Zero()};
    joint.torque = layout.drives.at(static_cast<std::size_t>(i)).torque_limit;
    joint.damping = kDampingOfTorque * joint.torque;
    joint.rotor = kSettling * joint.damping;
    joint.lower = -10.0;
    joint.upper = 10.0;
    joint.velocity = 10.0;
  }
  model.gravity_R.setZero();
  return model;
}

/// Runs all joints of the device's layout over simulated CAN with the controller's own drives, each joint on a spring
/// with `share` of its exact boundary at the delay of the bus plan. Returns the logarithm of the growth of each joint.
std::optional<JointVector> growth_on_the_bus(const hal::BusLayout& layout, const ArmModel& model, double share,
                                             const JointVector& stiffness, double gain) {
  const int a_millisecond = std::max(1, static_cast<int>(std::lround(kArmPeriod / layout.period)));
  const int settle = 500 * a_millisecond;
  const int stretch = 500 * a_millisecond;
  const int apart = 4000 * a_millisecond;
  auto hardware = sim::usual_hardware(model);
  for (auto& joint : hardware) joint.encoder_step = 0.0;
  JointVector begin = JointVector::Zero();
  for (int i = 0; i < layout.joint_count; ++i) {
    begin[i] = std::min(0.02, 0.5 * model.joints.at(static_cast<std::size_t>(i)).torque / stiffness[i]);
  }
  sim::Plant plant(model, begin);
  const auto device = std::make_unique<sim::CanDevice>(plant, layout, hardware);
  sim::VirtualClock clock(*device);
  std::array<hal::CanBus*, hal::kMaxBuses> wires{};
  for (int i = 0; i < layout.bus_count; ++i) wires.at(static_cast<std::size_t>(i)) = &device->bus(i);
  const hal::BusPlan plan = hal::plan_buses(layout);
  std::optional<hal::CanDrives> drives;  // it must not be on the heap
  drives.emplace(layout, std::span(wires.data(), static_cast<std::size_t>(layout.bus_count)), plan.timing);
  if (drives->bring_up(clock).status != hal::BringUpStatus::kOk) return std::nullopt;
  const std::int64_t period_ns = nanoseconds(layout.period);
  clock.sleep_until((device->now_ns() / period_ns + 1) * period_ns);
  JointVector low[2] = {JointVector::Constant(1e9), JointVector::Constant(1e9)};
  JointVector high[2] = {JointVector::Constant(-1e9), JointVector::Constant(-1e9)};
  hal::JointReading reading;
  for (int k = 0; k < settle + 2 * stretch + apart; ++k) {
    const std::int64_t begin_ns = device->now_ns();
    drives->request();
    clock.sleep_until(begin_ns + drives->collect_ns());
    drives->receive(reading);
    const JointVector torque = -gain * share * stiffness.cwiseProduct(reading.position);
    if (!drives->send({torque, hal::PowerRequest::kEnable})) return std::nullopt;
    clock.sleep_until(begin_ns + period_ns);
    const int part = k < settle ? -1 : k < settle + stretch ? 0 : k < settle + stretch + apart ? -1 : 1;
    if (part < 0) continue;
    low[part] = low[part].cwiseMin(plant.positions());
    high[part] = high[part].cwiseMax(plant.positions());
  }
  return JointVector(((high[1] - low[1]).array() / (high[0] - low[0]).array()).log().matrix());
}

/// Finds the boundary of each joint on a spring over simulated CAN, and adds it to `sheet`. Torques of `fault.gain`.
void boundaries_on_the_bus(const std::string& name, const hal::BusLayout& layout, const LoopFault& fault, Sheet& sheet,
                           CaseResult& result) {
  const hal::BusPlan plan = hal::plan_buses(layout);
  const ArmModel model = rotors(layout);
  JointVector exact = JointVector::Zero();
  for (int i = 0; i < layout.joint_count; ++i) {
    AxisLoop loop;
    loop.mass = model.joints.at(static_cast<std::size_t>(i)).rotor;
    loop.damping = model.joints.at(static_cast<std::size_t>(i)).damping;
    loop.timing.period = layout.period;
    loop.timing.delay = 1e-9 * static_cast<double>(plan.unblocked_ns.at(static_cast<std::size_t>(i)));
    exact[i] = stability_boundary(loop);
  }
  constexpr double kShares[2] = {0.96, 1.04};
  const auto below = growth_on_the_bus(layout, model, kShares[0], exact, fault.gain);
  const auto above = growth_on_the_bus(layout, model, kShares[1], exact, fault.gain);
  for (int i = 0; i < layout.joint_count; ++i) {
    const double measured =
        below && above ? zero_between(kShares[0], (*below)[i], kShares[1], (*above)[i]) : std::nan("");
    const double delay_us = 1e-3 * static_cast<double>(plan.unblocked_ns.at(static_cast<std::size_t>(i)));
    sheet.rows.push_back({name, cell(kMilli * layout.period), std::to_string(i), cell(delay_us), cell(exact[i]),
                          cell(measured * exact[i])});
    result.findings.push_back(
        judged(bound::kBus, kPercent * std::fabs(measured - 1.0),
               fmt::format("{} T {:g} ms joint {} t_d {:.0f} us", name, kMilli * layout.period, i, delay_us)));
  }
  result.findings.push_back(judged(bound::kBusDelay, plan.timing.delay_s / layout.period + fault.late,
                                   fmt::format("{} T {:g} ms", name, kMilli * layout.period)));
}

Sheet bus_sheet(const char* name) {
  return {.name = name, .columns = {"device", "T_ms", "joint", "t_d_plan_us", "K_exact", "K_measured"}, .rows = {}};
}

CaseResult bus_schedule(const firmware::Device& device, const LoopFault& fault) {
  CaseResult result;
  Sheet sheet = bus_sheet("stability_bus");
  boundaries_on_the_bus(device.name, device.bus, fault, sheet, result);
  result.sheets.push_back(sheet);
  return result;
}

/// To four digits, for tables that people read.
double rounded(double value) { return std::stod(fmt::format("{:.4g}", value)); }

/// The time at which the last torque of a cycle, or the SDO frame in its place, is on the wires [s].
double end_of(const hal::BusLayout& layout, const hal::BusPlan& plan) {
  std::int64_t end_ns = 0;
  for (int i = 0; i < layout.bus_count; ++i) {
    const hal::BusLoad& load = plan.buses.at(static_cast<std::size_t>(i));
    end_ns = std::max({end_ns, load.end_ns, load.slot_ns});
  }
  return 1e-9 * static_cast<double>(end_ns);
}

/// The wall that a device can render at several periods, each with the delay of its bus plan: the stiffness at the hand
/// that the arm bears, in the middle of its joints' ranges, and that of each joint over simulated CAN.
CaseResult rates(const firmware::Device& device, const Coupling& coupling, const StabilityRequest& request) {
  ArmModel model = device.model;
  model.gravity_R.setZero();
  JointVector q = JointVector::Zero();
  for (int i = 0; i < model.joint_count; ++i) {
    const ArmJoint& joint = model.joints.at(static_cast<std::size_t>(i));
    q[i] = 0.4 * joint.lower + 0.6 * joint.upper;
  }
  CaseResult result;
  Sheet walls{.name = "stability_rate",
              .columns = {"device", "T_ms", "t_d_us", "wall_exact_N_per_m", "wall_N_per_m"},
              .rows = {}};
  Sheet joints = bus_sheet("stability_rate_joints");
  double at_1_kHz = 0.0;
  const std::vector<double> periods =
      request.quick ? std::vector{1e-3, 0.25e-3} : std::vector{4e-3, 2e-3, 1e-3, 0.5e-3, 0.25e-3};
  for (const double period : periods) {
    const hal::BusLayout layout = layout_for(device.bus, period);
    const hal::BusPlan plan = hal::plan_buses(layout);
    const std::string where = fmt::format("{} T {:g} ms", device.name, kMilli * period);
    const ArmTiming timing{period, plan.timing.delay_s};
    const double margin = stiffness_margin(loop_at(model, q, coupling, timing));
    const auto grown = growth_at_boundary(model, q, coupling, margin, timing, request.fault);
    const double measured = zero_between(0.98, grown[0], 1.02, grown[1]);
    walls.rows.push_back({device.name, cell(kMilli * period), cell(rounded(1e6 * timing.delay)),
                          cell(rounded(margin * coupling.stiffness)),
                          cell(rounded(measured * margin * coupling.stiffness))});
    result.findings.push_back(judged(bound::kRate, kPercent * std::fabs(measured - 1.0), where));
    result.findings.push_back(judged(bound::kRatePlan, end_of(layout, plan) / period + request.fault.late, where));
    const ArmTiming planted_timing{period, timing.delay + request.fault.late * kArmPeriod};
    const double wall = stiffness_margin(loop_at(model, q, coupling, planted_timing));
    if (period == 1e-3) at_1_kHz = wall;
    if (period == 0.25e-3) result.findings.push_back(judged(bound::kStiffer, at_1_kHz / wall, where));
    if (period < 1e-3) boundaries_on_the_bus(device.name, layout, request.fault, joints, result);
  }
  result.sheets.push_back(walls);
  result.sheets.push_back(joints);
  return result;
}

}  // namespace

std::vector<StudyCase> arm_cases(const StabilityRequest& request) {
  std::vector<StudyCase> cases;
  for (const auto& [name, coupling] : kGains) {
    const std::filesystem::path file = request.devices / fmt::format("{}.toml", name);
    files::require_regular_input(file, "name the folder of the device files with --devices");
    const std::string inputs = fmt::format("{} device {}", inputs_of(request), file_digest(file));
    const auto add = [&](const char* what, std::function<CaseResult(const firmware::Device&)> run) {
      cases.push_back(
          {.name = fmt::format("stability.{}-{}", what, name),
           .inputs = inputs,
           .run = [file, run = std::move(run)](const auto&) { return run(firmware::read_device_file(file)); }});
    };
    add("arm", [&coupling = coupling, request](const firmware::Device& device) {
      return whole_arm(device, coupling, request);
    });
    add("passive-arm", [&coupling = coupling, request](const firmware::Device& device) {
      return passive_arm(device, coupling, request);
    });
    add("bus", [request](const firmware::Device& device) { return bus_schedule(device, request.fault); });
    add("rate",
        [&coupling = coupling, request](const firmware::Device& device) { return rates(device, coupling, request); });
  }
  return cases;
}

}  // namespace godobject::report
