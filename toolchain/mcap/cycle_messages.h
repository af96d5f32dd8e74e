#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "toolchain/figures/replay_log.h"
#include "toolchain/figures/telemetry_log.h"
#include "toolchain/viewer/scene_bodies.h"

namespace godobject::mcap {

/// The topics of a motion (README.md).
enum class Topic { kTfStatic, kTf, kBodies, kForceArrow, kWrench, kCycle, kSolverTimes, kJointStates, kController };

/// Name, type and durability of a topic.
struct TopicInfo {
  Topic topic;
  std::string_view name;           ///< as `/wrench`
  std::string_view package, type;  ///< as `geometry_msgs` and `WrenchStamped`
  bool latched = false;            ///< also those who subscribe later get the last message

  std::string schema_name() const;  ///< as `geometry_msgs/msg/WrenchStamped`
  std::string schema() const;       ///< as from message_definition
};

/// Returns the topics of a replay.
std::vector<TopicInfo> replay_topics();

/// Returns the topics of a controller.
std::vector<TopicInfo> controller_topics();

/// A message of ROS 2 in its encoding, CDR.
struct TopicMessage {
  Topic topic;
  std::string bytes;
};

/// Largest number of triangles of a body in the messages; each takes 72 bytes.
inline constexpr std::size_t kMaxTriangles = 200'000;

/// Returns a time [s] from 0 to 2^31 s in nanoseconds.
std::uint64_t nanoseconds(double t);

/// Makes the messages of a motion in a scene. Times are in nanoseconds, less than 2^31 s.
class CycleMessages {
 public:
  /// `bodies` outlive this object. `up_axis`: axis of W that points up, 0 .. 2. `force`: that has an arrow as long as
  /// the moving body [N].
  CycleMessages(const viewer::SceneBodies& bodies, int up_axis, double force);

  /// Returns the message of /tf_static.
  TopicMessage upright(std::uint64_t time_ns) const;

  /// Returns the message of /bodies. Throws Failure (kBadData) if a body has more than kMaxTriangles triangles.
  TopicMessage bodies(std::uint64_t time_ns) const;

  /// Returns the messages of a cycle: /tf, /wrench, /force_arrow, /cycle. `H_WD`: the device pose; that of the row need
  /// not be one.
  std::vector<TopicMessage> cycle(std::uint64_t time_ns, const figures::ReplayRow& row, const Pose& H_WD) const;

  /// Returns the message of /solver_times.
  static TopicMessage solver_times(std::uint64_t time_ns, const figures::ReplayRow& row);

  /// Returns the messages of /joint_states and /controller.
  static std::vector<TopicMessage> controller(std::uint64_t time_ns, const figures::TelemetryRow& row);

 private:
  std::string force_arrow(std::uint64_t time_ns, const Vector3& force) const;
  std::string outcome(std::uint64_t time_ns, const figures::ReplayRow& row, const Pose& H_WD) const;

  const viewer::SceneBodies& bodies_;
  const int up_axis_;
  const Vector3 p_M_;          ///< the moving body's centre of mass [m]
  const double arrow_length_;  ///< of `force_` [m]
  const double force_;         ///< [N]
};

}  // namespace godobject::mcap
