#include "toolchain/mcap/ros_messages.h"

#include <fmt/format.h>

namespace godobject::mcap {
namespace {

void append(CdrWriter& cdr, const Vector3& v) {
  for (int axis = 0; axis < 3; ++axis) cdr.float64(v[axis]);
}

/// As geometry_msgs/Transform and geometry_msgs/Pose: the position, then the quaternion x, y, z, w.
void append(CdrWriter& cdr, const Pose& pose) {
  append(cdr, pose.translation);
  for (int i = 0; i < 4; ++i) cdr.float64(pose.rotation.coeffs()[i]);
}

void append(CdrWriter& cdr, std::span<const double> numbers) {
  cdr.count(numbers.size());
  for (const double number : numbers) cdr.float64(number);
}

/// The fields of a marker behind its points, all empty: colours of points, texture, text and mesh file.
void append_unused_fields(CdrWriter& cdr) {
  cdr.count(0);               // colors
  cdr.string("");             // texture_resource
  append_header(cdr, 0, "");  // texture
  cdr.string("");             // texture.format
  cdr.count(0);               // texture.data
  cdr.count(0);               // uv_coordinates
  cdr.string("");             // text
  cdr.string("");             // mesh_resource
  cdr.string("");             // mesh_file.filename
  cdr.count(0);               // mesh_file.data
  cdr.boolean(false);         // mesh_use_embedded_materials
}

void append(CdrWriter& cdr, std::uint64_t time_ns, const Marker& marker) {
  append_header(cdr, time_ns, marker.frame);
  cdr.string(marker.name);
  cdr.int32(0);  // id
  cdr.int32(static_cast<std::int32_t>(marker.type));
  cdr.int32(static_cast<std::int32_t>(marker.action));
  append(cdr, Pose{});
  append(cdr, marker.scale);
  for (int i = 0; i < 4; ++i) cdr.float32(marker.color[i]);
  cdr.int32(0);  // lifetime: without end
  cdr.uint32(0);
  cdr.boolean(true);  // frame_locked
  cdr.count(marker.points.size());
  for (const Vector3& point : marker.points) append(cdr, point);
  append_unused_fields(cdr);
}

}  // namespace

void append_header(CdrWriter& cdr, std::uint64_t time_ns, std::string_view frame) {
  constexpr std::uint64_t kSecond_ns = 1'000'000'000;
  cdr.int32(static_cast<std::int32_t>(time_ns / kSecond_ns));
  cdr.uint32(static_cast<std::uint32_t>(time_ns % kSecond_ns));
  cdr.string(frame);
}

std::string transform_message(std::uint64_t time_ns, std::span<const FrameTransform> transforms) {
  CdrWriter cdr;
  cdr.count(transforms.size());
  for (const FrameTransform& transform : transforms) {
    append_header(cdr, time_ns, transform.parent);
    cdr.string(transform.child);
    append(cdr, transform.H_PC);
  }
  return cdr.bytes();
}

std::string wrench_message(std::uint64_t time_ns, std::string_view frame, const Wrench& wrench) {
  CdrWriter cdr;
  append_header(cdr, time_ns, frame);
  append(cdr, wrench.force);
  append(cdr, wrench.torque);
  return cdr.bytes();
}

std::string joint_message(std::uint64_t time_ns, std::span<const double> position, std::span<const double> velocity,
                          std::span<const double> torque) {
  CdrWriter cdr;
  append_header(cdr, time_ns, "");
  cdr.count(torque.size());
  for (std::size_t i = 1; i <= torque.size(); ++i) cdr.string(fmt::format("joint{}", i));
  append(cdr, position);
  append(cdr, velocity);
  append(cdr, torque);
  return cdr.bytes();
}

std::string marker_message(std::uint64_t time_ns, std::span<const Marker> markers) {
  CdrWriter cdr;
  cdr.count(markers.size());
  for (const Marker& marker : markers) append(cdr, time_ns, marker);
  return cdr.bytes();
}

}  // namespace godobject::mcap
