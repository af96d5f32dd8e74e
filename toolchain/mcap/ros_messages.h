#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "godobject/pose.h"
#include "toolchain/mcap/cdr_writer.h"

namespace godobject::mcap {

/// Appends the fields of std_msgs/Header. `time_ns`: less than 2^31 s [ns].
void append_header(CdrWriter& cdr, std::uint64_t time_ns, std::string_view frame);

/// The pose of a frame in its parent.
struct FrameTransform {
  std::string_view parent, child;
  Pose H_PC;
};

/// Returns a tf2_msgs/TFMessage.
std::string transform_message(std::uint64_t time_ns, std::span<const FrameTransform> transforms);

/// Returns a geometry_msgs/WrenchStamped: a wrench about the origin of `frame` and along its axes.
std::string wrench_message(std::uint64_t time_ns, std::string_view frame, const Wrench& wrench);

/// Returns a sensor_msgs/JointState: joints `joint1`, `joint2`, ... `torque` has one number a joint [Nm], `position`
/// [rad] and `velocity` [rad/s], too, or none if they are not known.
std::string joint_message(std::uint64_t time_ns, std::span<const double> position, std::span<const double> velocity,
                          std::span<const double> torque);

/// A body or an arrow that a viewer draws in a frame and moves with this frame.
struct Marker {
  enum class Type : std::int32_t { kArrow = 0, kTriangles = 11 };
  enum class Action : std::int32_t { kShow = 0, kRemove = 2 };

  std::string_view frame, name;
  Type type = Type::kTriangles;
  Action action = Action::kShow;
  Vector3 scale = Vector3::Ones();  ///< of an arrow: diameters of its shaft and its head, length of its head [m]
  Eigen::Vector4f color;            ///< red, green, blue, opacity [0, 1]
  std::vector<Vector3> points;      ///< corners of triangles, three each; of an arrow: its begin and its end [m]
};

/// Returns a visualization_msgs/MarkerArray.
std::string marker_message(std::uint64_t time_ns, std::span<const Marker> markers);

}  // namespace godobject::mcap
