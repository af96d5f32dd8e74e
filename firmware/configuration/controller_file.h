#pragma once

#include <filesystem>
#include <optional>

#include "core/device/workspace_mapping.h"
#include "core/scene/scene.h"
#include "godobject/god_object.h"
#include "firmware/configuration/device_file.h"
#include "godobject/pose.h"

namespace godobject::firmware {

/// What CONTROLLER.toml decides. SI units. Keys and defaults: firmware/README.md.
struct ControllerConfig {
  struct SceneChoice {
    std::filesystem::path image;
    std::optional<Solver> solver;  ///< none: the image's
    std::optional<bool> friction;  ///< none: on if the image has it
  } scene;

  Device device;

  /// With the arm at `posture` the moving mesh is at `start` in the scene; `turn` takes directions of the room R to
  /// those of the scene W, R_WR.
  struct Workspace {
    Quaternion turn = Quaternion::Identity();
    JointVector posture = JointVector::Zero();  ///< [rad]
    Pose start;                                 ///< H_WM
    double scale = 1.0;                         ///< motion in the scene to motion of the hand
  } workspace;

  struct Loop {
    bool real_time = false;  ///< of the simulated bus: with the machine's clock, not in virtual time
    int cpu = -1;            ///< that the loop is bound to; -1: none
    int priority = 80;       ///< SCHED_FIFO
    int velocity_window = 4;
    double compute = 120e-6;  ///< that computing may take in the bus plan [s]
  } loop;

  /// Of the hand, in the room; a `stop` beyond its threshold is a fault.
  struct Limits {
    double force = 30.0;            ///< [N]
    double torque = 3.0;            ///< [Nm]
    double speed = 1.0;             ///< from here on force along the motion fades out and damping comes [m/s]
    double speed_stop = 1.5;        ///< [m/s]
    double turn = 6.0;              ///< the same of rotations [rad/s]
    double turn_stop = 9.0;         ///< [rad/s]
    double joint_speed = 0.8;       ///< the same of each joint, share of its limit [1]
    double joint_speed_stop = 1.0;  ///< [1]
    double stuck_torque = 0.005;    ///< above dry friction: pushed by more a joint should move, share of its limit [1]
    double torque_rate = 0.05;      ///< largest change of a joint's torque in a cycle, share of its limit [1]
  } limits;

  struct Engage {
    double force = 0.5;  ///< contact force below which rendering begins [N]
    double ramp = 0.5;   ///< in which it then rises to all of it [s]
  } engage;

  struct Start {
    double wait = 5.0;      ///< for all drives to answer [s]
    bool sign_test = true;  ///< each joint must move the way it is pushed
    double push = 0.05;     ///< largest torque of that test, share of the joint's limit [1]
    double motion = 0.002;  ///< that is looked for [rad]
  } start;

  /// Of the virtual coupling; none: the scene's.
  struct Gains {
    std::optional<double> stiffness;   ///< k_D [N/m]
    std::optional<double> damping;     ///< b_D [Ns/m]
    std::optional<double> rotational;  ///< k_VC,r [m^2]
    double margin = 1.25;              ///< factor by which the stiffness must be below the stability boundary [1]
  } gains;

  /// Of the time-domain passivity controller.
  struct Passivity {
    double damping = 0.0;  ///< most that it injects at the hand [Ns/m]; 0: it is off
  } passivity;

  struct Telemetry {
    std::filesystem::path folder;  ///< empty: none is written
    int every = 1;                 ///< cycles a record
    bool bus = false;              ///< what goes over the buses, too
  } telemetry;

  /// The simulated device; a hand holds its tool.
  struct Simulation {
    std::filesystem::path path;  ///< of the moving mesh in the scene, that the hand follows; empty: it rests
    double slower = 1.0;         ///< how many times as long as the path says the hand takes [1]
    double begin = 8.0;          ///< when the hand begins to follow it [s]
  } simulation;
};

/// Reads and validates a controller file and the device file that it names; paths in it are relative to it.
/// Throws command::Failure: kNoInput if the file cannot be read, kBadConfig naming file, line and key.
ControllerConfig read_controller_file(const std::filesystem::path& file);

/// The scene with the gains of the controller in place of its own.
void set_gains(const ControllerConfig::Gains& gains, Scene& scene) noexcept;

/// How the workspace lies in the scene.
struct Placement {
  WorkspaceMappingParameters mapping;
  Pose H_TM;      ///< the moving mesh's frame in T, the tool's frame of the device file
  Device device;  ///< with the tool's frame at the mesh's
};

/// The mesh is at `start` when the arm is at `posture`, and held by its centre of mass `p_MB` [m], in the scene: there
/// the hand feels rotations without a lever.
Placement place(const ControllerConfig::Workspace& workspace, const Device& device, const Vector3& p_MB);

}  // namespace godobject::firmware
