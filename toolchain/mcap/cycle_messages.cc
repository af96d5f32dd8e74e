#include "toolchain/mcap/cycle_messages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/mcap/message_definitions.h"
#include "toolchain/mcap/ros_messages.h"
#include "toolchain/scene_compiler/mesh/box.h"
#include "toolchain/scene_compiler/mesh/mass_properties.h"
#include "toolchain/scene_compiler/mesh/mesh_edges.h"

namespace godobject::mcap {
namespace {

using command::ExitCode;
using command::Failure;
using figures::ReplayRow;
using figures::TelemetryRow;
using scene_compiler::TriangleMesh;

// The frames of the messages.
constexpr std::string_view kUpright = "upright";  // z points up
constexpr std::string_view kWorld = "W";
constexpr std::string_view kDevice = "device";
constexpr std::string_view kDeviceCentre = "device_centre";
constexpr std::string_view kGodObject = "god_object";

// In the order of a file's channels.
constexpr std::array<TopicInfo, 9> kTopics = {{
    {Topic::kTfStatic, "/tf_static", "tf2_msgs", "TFMessage", true},
    {Topic::kTf, "/tf", "tf2_msgs", "TFMessage"},
    {Topic::kBodies, "/bodies", "visualization_msgs", "MarkerArray", true},
    {Topic::kForceArrow, "/force_arrow", "visualization_msgs", "MarkerArray"},
    {Topic::kWrench, "/wrench", "geometry_msgs", "WrenchStamped"},
    {Topic::kCycle, "/cycle", "godobject_msgs", "Cycle"},
    {Topic::kSolverTimes, "/solver_times", "godobject_msgs", "SolverTimes"},
    {Topic::kJointStates, "/joint_states", "sensor_msgs", "JointState"},
    {Topic::kController, "/controller", "godobject_msgs", "Controller"},
}};

template <class Chosen>
std::vector<TopicInfo> topics_that(const Chosen& chosen) {
  std::vector<TopicInfo> topics;
  std::copy_if(kTopics.begin(), kTopics.end(), std::back_inserter(topics),
               [&](const TopicInfo& info) { return chosen(info.topic); });
  return topics;
}

/// Returns the pose of W in the frame whose z axis points up.
Pose upright_pose(int up_axis) {
  Pose H_UW;
  constexpr double kRight = 0.5 * std::numbers::pi;
  if (up_axis == 0) H_UW.rotation = exp_rotation(Vector3(0.0, -kRight, 0.0));
  if (up_axis == 1) H_UW.rotation = exp_rotation(Vector3(kRight, 0.0, 0.0));
  return H_UW;
}

/// Returns a marker with the triangles of a mesh.
Marker body_marker(std::string_view frame, std::string_view name, const TriangleMesh& mesh,
                   const Eigen::Vector4f& color) {
  if (mesh.triangles.size() > kMaxTriangles) {
    throw Failure(ExitCode::kBadData,
                  fmt::format("{}: has {} triangles, a record shows at most {}; write a scene file with a decimated "
                              "mesh for the record",
                              name, mesh.triangles.size(), kMaxTriangles));
  }
  Marker marker{.frame = frame, .name = name, .color = color, .points = {}};
  marker.points.reserve(3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) marker.points.push_back(mesh.vertices[corner]);
  }
  return marker;
}

}  // namespace

std::string TopicInfo::schema_name() const { return fmt::format("{}/msg/{}", package, type); }

std::string TopicInfo::schema() const { return message_definition(fmt::format("{}/{}", package, type)); }

std::vector<TopicInfo> replay_topics() {
  return topics_that([](Topic topic) { return topic != Topic::kJointStates && topic != Topic::kController; });
}

std::vector<TopicInfo> controller_topics() {
  return topics_that([](Topic topic) { return topic != Topic::kSolverTimes; });
}

std::uint64_t nanoseconds(double t) { return static_cast<std::uint64_t>(std::llround(1e9 * t)); }

CycleMessages::CycleMessages(const viewer::SceneBodies& bodies, int up_axis, double force)
    : bodies_(bodies),
      up_axis_(up_axis),
      p_M_(scene_compiler::centre_of_mass(bodies.moving, scene_compiler::MeshEdges(bodies.moving).closed())),
      arrow_length_(scene_compiler::Box::around(bodies.moving.vertices).diagonal()),
      force_(force) {}

TopicMessage CycleMessages::upright(std::uint64_t time_ns) const {
  const std::array frames{FrameTransform{kUpright, kWorld, upright_pose(up_axis_)}};
  return {Topic::kTfStatic, transform_message(time_ns, frames)};
}

TopicMessage CycleMessages::bodies(std::uint64_t time_ns) const {
  const std::array markers{
      body_marker(kWorld, "still body", bodies_.still, Eigen::Vector4f(0.7f, 0.7f, 0.7f, 1.0f)),
      body_marker(kGodObject, "god object", bodies_.moving, Eigen::Vector4f(0.2f, 0.4f, 0.9f, 1.0f)),
      body_marker(kDevice, "device pose", bodies_.moving, Eigen::Vector4f(0.9f, 0.2f, 0.2f, 0.35f))};
  return {Topic::kBodies, marker_message(time_ns, markers)};
}

std::vector<TopicMessage> CycleMessages::cycle(std::uint64_t time_ns, const ReplayRow& row, const Pose& H_WD) const {
  const std::array frames{FrameTransform{kWorld, kDevice, H_WD}, FrameTransform{kWorld, kGodObject, row.H_WS},
                          FrameTransform{kWorld, kDeviceCentre, Pose{Quaternion::Identity(), H_WD * p_M_}}};
  return {{Topic::kTf, transform_message(time_ns, frames)},
          {Topic::kWrench, wrench_message(time_ns, kDeviceCentre, row.wrench)},
          {Topic::kForceArrow, force_arrow(time_ns, row.wrench.force)},
          {Topic::kCycle, outcome(time_ns, row, H_WD)}};
}

std::string CycleMessages::force_arrow(std::uint64_t time_ns, const Vector3& force) const {
  std::array marker{Marker{.frame = kDeviceCentre,
                           .name = "force",
                           .type = Marker::Type::kArrow,
                           .action = force.isZero() ? Marker::Action::kRemove : Marker::Action::kShow,
                           .scale = arrow_length_ * Vector3(0.02, 0.05, 0.08),
                           .color = Eigen::Vector4f(0.9f, 0.1f, 0.3f, 1.0f),
                           .points = {}}};
  if (!force.isZero()) marker[0].points = {Vector3::Zero(), arrow_length_ / force_ * force};
  return marker_message(time_ns, marker);
}

std::string CycleMessages::outcome(std::uint64_t time_ns, const ReplayRow& row, const Pose& H_WD) const {
  CdrWriter cdr;
  append_header(cdr, time_ns, kWorld);
  cdr.string(row.status);
  cdr.float64(row.depth);
  cdr.float64((H_WD * p_M_ - row.H_WS * p_M_).norm());
  cdr.uint32(static_cast<std::uint32_t>(std::clamp(row.contacts, 0.0, 1e9)));
  return cdr.bytes();
}

TopicMessage CycleMessages::solver_times(std::uint64_t time_ns, const ReplayRow& row) {
  CdrWriter cdr;
  append_header(cdr, time_ns, "");
  cdr.float64(1e-9 * row.step1_ns);
  cdr.float64(1e-9 * row.solve_ns);
  return {Topic::kSolverTimes, cdr.bytes()};
}

std::vector<TopicMessage> CycleMessages::controller(std::uint64_t time_ns, const TelemetryRow& row) {
  CdrWriter cdr;
  append_header(cdr, time_ns, "");
  cdr.string(row.mode);
  cdr.int32(row.fault);
  cdr.float64(row.share);
  cdr.float64(row.late);
  cdr.float64(row.compute);
  cdr.float64(row.absorbed);
  return {{Topic::kJointStates, joint_message(time_ns, row.position, row.velocity, row.torque)},
          {Topic::kController, cdr.bytes()}};
}

}  // namespace godobject::mcap
