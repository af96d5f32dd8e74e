#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/device/workspace_mapping.h"
#include "core/scene/scene_view.h"
#include "firmware/configuration/device_file.h"
#include "godobject/god_object.h"
#include "godobject/pose.h"

namespace godobject::firmware {

/// Largest share of a period that is the default of loop.compute. Chosen: with FD frames alone, one joint a bus and
/// data at 8 Mbit/s it leaves room for the frames at 4 kHz.
inline constexpr double kComputeShare = 0.16;

/// The contents of CONTROLLER.toml in SI units. firmware/README.md explains keys and defaults.
struct ControllerConfig {
  struct SceneChoice {
    std::filesystem::path image;
    std::optional<Solver> solver;  ///< none: the image's default
    std::optional<bool> friction;  ///< none: on if the image has it
  } scene;

  Device device;
  std::string text;  ///< of the file, as it was read

  /// With the arm at `posture` the moving mesh is at `start` in the scene. `turn` is R_WR: it rotates directions of the
  /// room R into the scene W.
  struct Workspace {
    Quaternion turn = Quaternion::Identity();
    JointVector posture = JointVector::Zero();  ///< [rad]
    Pose start;                                 ///< H_WM
    double scale = 1.0;                         ///< motion in the scene per motion of the hand [1]
  } workspace;

  struct Loop {
    bool real_time = false;              ///< of a simulated arm: keep to the machine's clock
    int cpu = -1;                        ///< processor of the loop; -1: any
    int priority = 80;                   ///< of SCHED_FIFO
    int velocity_window = 4;             ///< N of VelocityEstimator [samples]; default: over 3 ms
    double compute = 120e-6;             ///< computing time in the bus plan [s]
    std::optional<double> cycle_budget;  ///< time of `contact` in a cycle [s]; 0: no limit
  } loop;

  /// Limits at the hand and of the joints. A speed above a `stop` limit is a fault.
  struct Limits {
    double force = 30.0;            ///< [N]
    double torque = 3.0;            ///< [Nm]
    double speed = 1.0;             ///< above it force along the motion fades out and damping rises [m/s]
    double speed_stop = 1.5;        ///< [m/s]
    double turn = 6.0;              ///< as `speed`, for rotations [rad/s]
    double turn_stop = 9.0;         ///< [rad/s]
    double joint_speed = 0.8;       ///< as `speed`, for each joint: share of its speed limit [1]
    double joint_speed_stop = 1.0;  ///< [1]
    double stuck_torque =
        0.005;  ///< torque above which a joint should move, above its dry friction: share of its limit [1]
    double torque_rate = 0.05;  ///< largest change of a joint's torque in 1 ms, share of its limit [1]
  } limits;

  struct Engage {
    double force = 0.5;  ///< contact force below which rendering begins [N]
    double ramp = 0.5;   ///< duration of the rise to the full wrench [s]
  } engage;

  struct Start {
    double wait = 5.0;      ///< until all drives must answer [s]
    bool sign_test = true;  ///< check that each joint moves in the direction of its torque
    double push = 0.05;     ///< largest torque of that test: share of the joint's limit [1]
    double motion = 0.002;  ///< deviation that it looks for [rad]
  } start;

  /// Gains of the virtual coupling; none: the scene's.
  struct Gains {
    std::optional<double> stiffness;   ///< k_D [N/m]
    std::optional<double> damping;     ///< b_D [Ns/m]
    std::optional<double> rotational;  ///< k_VC,r [m^2]
    double margin = 1.25;              ///< least factor from the stiffness to the stability boundary [1]
  } gains;

  /// The passivity controller.
  struct Passivity {
    double damping = 0.0;  ///< b_max, its largest damping at the hand [Ns/m]; 0: off
  } passivity;

  struct Telemetry {
    std::filesystem::path folder;  ///< of the logs; empty: nothing is written
    int every = 1;                 ///< cycles a row
    bool bus = false;              ///< log the frames on the buses, too
    /// Of the records of stops, which no key of the file names; empty: beside the logs, if there are any.
    std::filesystem::path incidents;
    bool needs_incidents = true;  ///< false: a run goes on if `incidents` cannot be made
    std::string program;          ///< name and version of the program, for the records

    /// True: stops are recorded, or the buses are logged.
    bool records_frames() const { return bus || !folder.empty() || !incidents.empty(); }
  } telemetry;

  /// The simulated arm and the hand that holds its tool.
  struct Simulation {
    std::filesystem::path path;  ///< target poses of the moving mesh in the scene; empty: the hand rests
    double slower = 1.0;         ///< factor on the duration of the path [1]
    double begin = 8.0;          ///< time at which the path begins [s]
  } simulation;
};

/// Reads and validates a controller file and the device file that it names. Paths in it are relative to the file.
/// Throws command::Failure: kNoInput if the file cannot be read, kBadConfig naming file, line and key.
ControllerConfig read_controller_file(const std::filesystem::path& file);

/// Replaces gains of the scene by those that the controller file has.
void set_gains(const ControllerConfig::Gains& gains, SceneView& scene) noexcept;

/// Returns the scene with the gains of the controller and the period of its device.
SceneView configured(SceneView scene, const ControllerConfig& config) noexcept;

/// The workspace in the scene and the device with the mesh in its hand.
struct Placement {
  WorkspaceMappingParameters mapping;
  Pose H_TM;      ///< the mesh in T, the tool frame of the device file
  Device device;  ///< with M as its tool frame
};

/// Places the mesh in the hand such that it is at `start` when the arm is at `posture`. The hand holds it by its centre
/// of mass `p_MB` [m], in the scene's scale, so it feels rotations without a lever.
Placement place(const ControllerConfig::Workspace& workspace, const Device& device, const Vector3& p_MB);

}  // namespace godobject::firmware
