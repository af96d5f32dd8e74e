#include "tests/closed_loop/simulated_run.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "core/device/kinematics.h"
#include "hal/linux/monotonic_clock.h"
#include "tests/support/small_scenes.h"

namespace godobject::firmware {
namespace {

ControllerConfig::Workspace workspace(const Quaternion& turn = Quaternion::Identity()) {
  ControllerConfig::Workspace workspace;
  workspace.posture << 0.0, -0.5, 0.0, 1.4, 0.0, -1.2, 0.0;
  workspace.turn = turn;
  workspace.start.translation = Vector3(0.0, 0.0, 0.06);
  return workspace;
}

/// Drives to which time passes before the torques of slow cycles are handed over.
class SlowDrives final : public hal::JointDrives {
 public:
  SlowDrives(hal::JointDrives& drives, sim::VirtualClock& clock, std::span<const SlowCycle> slow) noexcept
      : drives_(drives), clock_(clock), slow_(slow) {}

  int joint_count() const noexcept override { return drives_.joint_count(); }
  void request() noexcept override { drives_.request(); }
  std::int64_t collect_ns() const noexcept override { return drives_.collect_ns(); }
  void receive(hal::JointReading& reading) noexcept override { drives_.receive(reading); }
  bool send(const hal::JointCommand& command) noexcept override {
    if (!slow_.empty() && clock_.now_ns() / 1'000'000 >= slow_.front().number) {
      clock_.spend(slow_.front().took_ns);
      slow_ = slow_.subspan(1);
    }
    return drives_.send(command);
  }
  double delay() const noexcept override { return drives_.delay(); }

 private:
  hal::JointDrives& drives_;
  sim::VirtualClock& clock_;
  std::span<const SlowCycle> slow_;
};

}  // namespace

const test::SceneImage& plate() {
  static const test::SceneImage image = test::ball_over_plate();
  return image;
}

std::vector<Vector3> path_through(std::span<const Waypoint> waypoints) {
  std::vector<Vector3> path;
  for (std::size_t i = 0; i + 1 < waypoints.size(); ++i) {
    const Waypoint& from = waypoints[i];
    const Waypoint& to = waypoints[i + 1];
    const int rows = static_cast<int>(std::lround(1e3 * (to.t - from.t)));
    for (int k = 0; k < rows; ++k) {
      path.push_back(from.p_W + (0.5 - 0.5 * std::cos(M_PI * k / rows)) * (to.p_W - from.p_W));
    }
  }
  path.push_back(waypoints.back().p_W);
  return path;
}

const JointVector& SimulatedRun::posture() {
  static const JointVector posture = workspace().posture;
  return posture;
}

Placement run_placement(const Quaternion& turn) {
  return place(workspace(turn), read_device_file(GODOBJECT_DEVICES_DIR "/lwr.toml"), Vector3::Zero());
}

void set_run_gains(double stiffness, SceneView& scene) {
  ControllerConfig::Gains gains;
  gains.stiffness = stiffness;
  gains.damping = 5.0;
  gains.rotational = 0.003;
  set_gains(gains, scene);
}

CycleSetup run_setup(const SceneView& scene, const Placement& placement) {
  CycleSetup setup;
  setup.scene = &scene;
  setup.friction = true;
  setup.arm = &placement.device.model;
  setup.joint_torque = &placement.device.torque;
  setup.mapping = placement.mapping;
  setup.velocity_window = SimulatedRun::kVelocityWindow;
  setup.stuck_torque = 0.002;

  return setup;
}

std::vector<Pose> run_path(const Placement& placement, std::span<const Vector3> path) {
  const Pose rest = forward_kinematics(placement.device.model, SimulatedRun::posture()).H_RM;
  std::vector<Pose> in_room{rest};
  for (const Vector3& p_W : path) in_room.push_back({rest.rotation, p_W - placement.mapping.H_WR.translation});
  return in_room;
}

SimulatedRun::SimulatedRun(const test::SceneImage& image, const Options& options)
    : scene_(test::open_scene(image)),
      load_(options.load),
      placement_(run_placement(options.turn)),
      path_R_(run_path(placement_, options.path)),
      faults_(options.faults),
      late_(options.late),
      slow_(options.slow) {
  set_run_gains(options.scene_stiffness, scene_);
  if (options.weightless) placement_.device.model.gravity_R.setZero();
  const ArmModel& arm = placement_.device.model;
  ArmModel real = arm;
  real.payload.mass += options.more_payload;
  for (ArmJoint& joint : real.joints) joint.link.mass *= 1.0 + options.more_mass;
  hardware_ = sim::usual_hardware(arm);
  for (auto& joint : hardware_) {
    joint.counter_at_zero = options.counter_at_zero;
    joint.command_deadline_ns = options.command_deadline_ns;
    joint.enable_ns = options.enable_ns;
    if (load_) joint.encoder_step = joint.torque_step = 0.0;
  }
  if (load_) placement_.device.torque.null_damping.setZero();
  if (options.reversed_joint >= 0) hardware_[static_cast<std::size_t>(options.reversed_joint)].motor_sign = -1.0;
  sim::HandParameters hand;
  hand.grip = load_ ? sim::Grip::kNone : sim::Grip::kSpring;
  plant_ =
      std::make_unique<sim::Plant>(real, SimulatedRun::posture(), options.dry_friction,
                                   sim::OperatorHand(hand, path_R_, static_cast<std::int64_t>(1e9 * options.begin)));
  drives_ = std::make_unique<sim::DirectDrives>(*plant_, hardware_, options.timing, faults_);
  clock_ = std::make_unique<sim::VirtualClock>(*drives_, late_);
  slow_drives_ = std::make_unique<SlowDrives>(*drives_, *clock_, slow_);
  ring_ = std::make_unique<TelemetryRing>();

  CycleSetup setup = run_setup(scene_, placement_);
  setup.friction = options.friction;
  setup.supervisor.engage_cycles = options.engage_cycles;
  setup.hand = options.hand;
  setup.supervisor.sign_test = options.sign_test;
  setup.memory = memory_.span();
  cycle_ = std::make_unique<ControlCycle>(setup, *slow_drives_);
  if (cycle_->start() != Status::kOk) throw std::runtime_error("the scene lacks the solver");
}

void SimulatedRun::run(std::int64_t count) {
  hal::MonotonicClock stopwatch;
  const RunSetup setup{
      .cycles = static_cast<std::uint64_t>(count), .stopwatch = &stopwatch, .compute_ns = kCompute_ns};
  run_controller(setup, *clock_, *cycle_, requests, *ring_, report, [this] {
    TelemetryRecord row;
    while (ring_->pop(row)) {
      SimulatedCycle cycle{row.times.deadline_ns / 1'000'000, row.times, row.cycle, JointVector::Zero(),
                           plant_->tool().pose.translation};
      const JointVector gravity = plant_->gravity_torque();
      for (int i = 0; i < plant_->joint_count(); ++i) {
        if (drives_->joint(i).state() != hal::DriveState::kEnabled) continue;
        cycle.pushed[i] = drives_->joint(i).motor_torque() - gravity[i];
      }
      cycles.push_back(cycle);
    }
    if (load_) plant_->set_tool_load(load_(plant_->now_ns() / 1'000'000, plant_->tool()));
  });
}

std::string SimulatedRun::violation() const {
  if (drives_->counters().not_finite > 0) return "a torque was not finite";
  JointVector before = JointVector::Zero();
  for (const SimulatedCycle& cycle : cycles) {
    const Mode mode = cycle.record.mode;
    const bool free_rate =
        mode == Mode::kFade || mode == Mode::kStopping || mode == Mode::kStopped || mode == Mode::kEnded;
    for (int i = 0; i < placement_.device.model.joint_count; ++i) {
      const double limit = placement_.device.model.joints[static_cast<std::size_t>(i)].torque;
      const double torque = cycle.record.torque[i];
      if (!(std::fabs(torque) <= limit)) return "torque beyond the limit in cycle " + std::to_string(cycle.number);
      if (!free_rate && std::fabs(torque - before[i]) > 0.05 * limit * (1.0 + 1e-9)) {
        return "torque jumps in cycle " + std::to_string(cycle.number);
      }
    }
    before = cycle.record.torque;
  }
  return {};
}

int SimulatedRun::cycles_to_stop(std::int64_t number) const {
  for (const SimulatedCycle& cycle : cycles) {
    if (cycle.number >= number && cycle.record.share == 0.0) return static_cast<int>(cycle.number - number + 1);
  }
  return 0;
}

}  // namespace godobject::firmware
