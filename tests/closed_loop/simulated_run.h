#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/scene/scene_view.h"
#include "firmware/configuration/controller_file.h"
#include "firmware/cycle/control_cycle.h"
#include "firmware/loop/controller_run.h"
#include "sim/direct_drives.h"
#include "tests/support/scene_image_builder.h"
#include "toolchain/files/aligned_bytes.h"

namespace godobject::firmware {

/// Returns the image of a ball over a plate.
const test::SceneImage& plate();

/// The wanted position of the ball's centre in the scene [m] at a time.
struct Waypoint {
  double t;  ///< [s]
  Vector3 p_W;
};

/// Returns a smooth path through the waypoints, one position each millisecond, at rest at each waypoint.
std::vector<Vector3> path_through(std::span<const Waypoint> waypoints);

/// Returns the placement that all runs share: the light-weight robot, its tool 60 mm above the origin of a small scene.
/// `turn` maps directions of the room to directions of the scene.
Placement run_placement(const Quaternion& turn = Quaternion::Identity());
void set_run_gains(double stiffness, SceneView& scene);
CycleSetup run_setup(const SceneView& scene, const Placement& placement);

/// Returns the tool's poses in the room that move the ball along `path`, preceded by the tool's pose at the start.
std::vector<Pose> run_path(const Placement& placement, std::span<const Vector3> path);

/// The record of a cycle, with torques and position of the simulated arm.
struct SimulatedCycle {
  std::int64_t number = 0;  ///< period since time zero
  CycleTimes times;
  CycleRecord record;
  JointVector pushed;  ///< torques of enabled drives minus the gravity torques [Nm]
  Vector3 tool_R;      ///< position of the tool [m]
};

/// A cycle that computes slowly: its torques reach the drives that much later.
struct SlowCycle {
  std::int64_t number = 0;  ///< period since time zero
  std::int64_t took_ns = 0;
};

/// Runs the whole controller in virtual time on the light-weight robot, with a hand that leads the ball along a path.
/// At the start the tool is 60 mm above the origin of a small scene.
class SimulatedRun {
 public:
  struct Options {
    std::vector<Vector3> path;  ///< positions of the ball in the scene, 1 ms apart, from time `begin` on
    double begin = 0.4;         ///< [s]; from then on forces are rendered in full
    std::vector<sim::DriveFault> faults;
    std::vector<sim::LateWake> late;
    std::vector<SlowCycle> slow;  ///< in order of time; other cycles compute in no time
    sim::DriveTiming timing;
    std::int32_t counter_at_zero = 0;
    bool sign_test = false;
    int reversed_joint = -1;  ///< this joint's motor turns the wrong way; -1: none
    JointVector dry_friction = JointVector::Zero();
    double scene_stiffness = 2000.0;
    bool friction = true;
    HandLimits hand;                               ///< limits of force and speed at the hand
    std::int64_t command_deadline_ns = 4'000'000;  ///< a drive that gets no command for longer trips
    std::int64_t enable_ns = 3'000'000;            ///< from the request until a drive's power stage is on
    /// Returns the wrench on the tool about its origin in each cycle, in place of the hand's grip. If it is set, the
    /// drives round nothing, and motions that leave the tool at rest are not damped.
    std::function<Wrench(std::int64_t cycle, const sim::BodyState& tool)> load;
    std::uint32_t engage_cycles = 50;
    double more_payload = 0.0;                 ///< at the tool of the real arm, of which the model knows nothing [kg]
    double more_mass = 0.0;                    ///< of the real arm's links: share of the model's
    bool weightless = false;                   ///< no gravity acts, and the controller compensates none
    Quaternion turn = Quaternion::Identity();  ///< as in `run_placement`
  };

  SimulatedRun(const test::SceneImage& image, const Options& options);

  /// Runs `cycles` cycles, then asks the controller to end and runs it until its mode is ENDED or it refuses to start.
  void run(std::int64_t cycles);

  /// Checks all cycles so far: torques must be finite and within the limits, and a torque must not change by more than
  /// a twentieth of its limit in a cycle, except in FADE and STOP. Returns the first violation as text; empty: none.
  std::string violation() const;

  /// Returns the number of cycles from the period `number` to the first one without rendering, both included; 0: never.
  int cycles_to_stop(std::int64_t number) const;

  std::vector<SimulatedCycle> cycles;
  RunRequests requests;
  RunReport report;

  const ControlCycle& controller() const { return *cycle_; }
  sim::DirectDrives& drives() { return *drives_; }
  const sim::Plant& plant() const { return *plant_; }
  const Device& device() const { return placement_.device; }
  const SceneView& scene() const { return scene_; }
  double delay() const { return drives_->delay(); }
  static const JointVector& posture();  ///< at the start
  static constexpr int kVelocityWindow = 2;
  static constexpr std::int64_t kCompute_ns = 120'000;  ///< computing time that the plan leaves

 private:
  SceneView scene_;
  std::function<Wrench(std::int64_t cycle, const sim::BodyState& tool)> load_;
  Placement placement_;
  std::vector<Pose> path_R_;
  std::vector<sim::DriveFault> faults_;
  std::vector<sim::LateWake> late_;
  std::vector<SlowCycle> slow_;
  std::array<sim::JointHardwareParameters, kMaxJoints> hardware_;
  std::unique_ptr<sim::Plant> plant_;
  std::unique_ptr<sim::DirectDrives> drives_;
  std::unique_ptr<sim::VirtualClock> clock_;
  std::unique_ptr<hal::JointDrives> slow_drives_;
  std::unique_ptr<TelemetryRing> ring_;
  files::AlignedBytes memory_{GodObject::memory_size(Scene::of(scene_))};
  std::unique_ptr<ControlCycle> cycle_;
};

}  // namespace godobject::firmware
