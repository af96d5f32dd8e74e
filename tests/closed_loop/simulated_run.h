#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/scene/scene.h"
#include "firmware/configuration/controller_file.h"
#include "firmware/cycle/control_cycle.h"
#include "firmware/loop/controller_run.h"
#include "sim/direct_drives.h"
#include "tests/support/scene_image_builder.h"

namespace godobject::firmware {

/// Where the ball is to be at a time, centre in the scene [m].
struct Waypoint {
  double t;  ///< [s]
  Vector3 p_W;
};

/// Smooth motion from one to the next, at rest at each.
std::vector<Vector3> path_through(std::span<const Waypoint> waypoints);

/// What all runs share: the light-weight robot, its tool 60 mm above the origin of a small scene.
/// `turn` takes directions of the room to those of the scene.
Placement run_placement(const Quaternion& turn = Quaternion::Identity());
void set_run_gains(double stiffness, Scene& scene);
CycleSetup run_setup(const Scene& scene, const Placement& placement);

/// The way of the ball as the tool's in the room, from where the tool is at the start.
std::vector<Pose> run_path(const Placement& placement, std::span<const Vector3> path);

/// A cycle, with what the device did.
struct SimulatedCycle {
  std::int64_t number = 0;  ///< period since time zero
  CycleTimes times;
  CycleRecord record;
  JointVector pushed;  ///< torques of enabled drives without what gravity asks for [Nm]
  Vector3 tool_R;      ///< where the tool is [m]
};

/// The light-weight robot, its tool 60 mm above the origin of a small scene at the start, a hand that follows a path of
/// the ball, and the whole controller on them, in virtual time.
class SimulatedRun {
 public:
  struct Options {
    std::vector<Vector3> path;  ///< of the ball in the scene, 1 ms apart, from time `begin` on
    double begin = 0.4;         ///< [s]; what is rendered then is at full
    std::vector<sim::DriveFault> faults;
    std::vector<sim::LateWake> late;
    sim::DriveTiming timing;
    std::int32_t counter_at_zero = 0;
    bool sign_test = false;
    int reversed_joint = -1;  ///< its motor is connected the wrong way round
    JointVector dry_friction = JointVector::Zero();
    double scene_stiffness = 2000.0;
    bool friction = true;
    HandLimits hand;                               ///< what the hand may be given
    std::int64_t command_deadline_ns = 4'000'000;  ///< without commands for longer a drive trips
    std::int64_t enable_ns = 3'000'000;            ///< from the request to a drive's power stage
    /// What is put on the tool in each cycle instead of a hand's grip, about its origin; the drives round nothing then,
    /// and motions that leave the tool at rest are not damped.
    std::function<Wrench(std::int64_t cycle, const sim::BodyState& tool)> load;
    bool weightless = false;                   ///< neither is the arm drawn down nor held against it
    Quaternion turn = Quaternion::Identity();  ///< as `run_placement`
  };

  SimulatedRun(const test::SceneImage& image, const Options& options);

  /// To the end of `cycles` periods, then it is asked to end unless `ends` is false: it may be gone on with.
  void run(std::int64_t cycles);

  /// Of all cycles so far what must always hold: finite torques within the limits, and no jump of a torque larger than
  /// a twentieth of the limit but in FADE and STOP. Empty, or what does not.
  std::string violation() const;

  /// Cycles from `number` on until nothing is rendered any more, that of `number` being the first; 0 if it never is.
  int cycles_to_stop(std::int64_t number) const;

  std::vector<SimulatedCycle> cycles;
  RunRequests requests;
  RunReport report;

  const ControlCycle& controller() const { return *cycle_; }
  sim::DirectDrives& drives() { return *drives_; }
  const sim::Plant& plant() const { return *plant_; }
  const Device& device() const { return placement_.device; }
  const Scene& scene() const { return scene_; }
  double delay() const { return drives_->delay(); }
  static const JointVector& posture();  ///< at the start
  static constexpr int kVelocityWindow = 2;

 private:
  Scene scene_;
  std::function<Wrench(std::int64_t cycle, const sim::BodyState& tool)> load_;
  Placement placement_;
  std::vector<Pose> path_R_;
  std::vector<sim::DriveFault> faults_;
  std::vector<sim::LateWake> late_;
  std::array<sim::JointHardwareParameters, kMaxJoints> hardware_;
  std::unique_ptr<sim::Plant> plant_;
  std::unique_ptr<sim::DirectDrives> drives_;
  std::unique_ptr<sim::VirtualClock> clock_;
  std::unique_ptr<TelemetryRing> ring_;
  std::unique_ptr<ControlCycle> cycle_;
};

}  // namespace godobject::firmware
