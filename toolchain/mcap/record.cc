#include "toolchain/mcap/record.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/files/input_file.h"
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

// The frames of a record.
constexpr std::string_view kUpright = "upright";  // z points up
constexpr std::string_view kWorld = "W";
constexpr std::string_view kDevice = "device";
constexpr std::string_view kDeviceCentre = "device_centre";
constexpr std::string_view kGodObject = "god_object";

constexpr double kArrowPeriod = 0.01;  // a viewer draws no more arrows [s]

/// Returns a time [s] of a recording in nanoseconds.
std::uint64_t nanoseconds(double t) { return static_cast<std::uint64_t>(std::llround(1e9 * t)); }

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

double largest_force(const figures::ReplayLog& cycles) {
  double largest = 0.0;
  for (const ReplayRow& row : cycles) largest = std::max(largest, row.wrench.force.norm());
  return largest;
}

/// Writes the messages of a recording, one topic after the other in each cycle.
class RecordWriter {
 public:
  RecordWriter(const Recording& recording, McapWriter& writer)
      : recording_(recording),
        writer_(writer),
        device_(figures::device_poses(recording.cycles)),
        p_M_(scene_compiler::centre_of_mass(recording.bodies.moving,
                                            scene_compiler::MeshEdges(recording.bodies.moving).closed())),
        arrow_length_(scene_compiler::Box::around(recording.bodies.moving.vertices).diagonal()),
        largest_force_(largest_force(recording.cycles)) {}

  void write() {
    add_topics();
    const std::uint64_t begin_ns = nanoseconds(recording_.cycles.front().t);
    const std::array upright{FrameTransform{kUpright, kWorld, upright_pose(recording_.up_axis)}};
    writer_.write(tf_static_, begin_ns, transform_message(begin_ns, upright));
    for (std::size_t i = 0; i < recording_.cycles.size(); ++i) {
      write_motion(i);
      if (i == 0) write_bodies(begin_ns);
      write_cycle(i);
      if (!recording_.controller.empty()) write_controller(recording_.controller[i]);
    }
    writer_.finish();
  }

 private:
  void add_topics() {
    const auto schema = [&](const char* package, const char* type) {
      return writer_.add_schema(fmt::format("{}/msg/{}", package, type),
                                message_definition(fmt::format("{}/{}", package, type)));
    };
    const auto transforms = schema("tf2_msgs", "TFMessage");
    const auto markers = schema("visualization_msgs", "MarkerArray");
    tf_static_ = writer_.add_channel("/tf_static", transforms, true);
    tf_ = writer_.add_channel("/tf", transforms, false);
    bodies_ = writer_.add_channel("/bodies", markers, true);
    arrow_ = writer_.add_channel("/force_arrow", markers, false);
    wrench_ = writer_.add_channel("/wrench", schema("geometry_msgs", "WrenchStamped"), false);
    cycle_ = writer_.add_channel("/cycle", schema("godobject_msgs", "Cycle"), false);
    if (recording_.controller.empty()) {
      solver_times_ = writer_.add_channel("/solver_times", schema("godobject_msgs", "SolverTimes"), false);
    } else {
      joints_ = writer_.add_channel("/joint_states", schema("sensor_msgs", "JointState"), false);
      controller_ = writer_.add_channel("/controller", schema("godobject_msgs", "Controller"), false);
    }
  }

  void write_bodies(std::uint64_t time_ns) {
    const TriangleMesh& moving = recording_.bodies.moving;
    const std::array markers{
        body_marker(kWorld, "still body", recording_.bodies.still, Eigen::Vector4f(0.7f, 0.7f, 0.7f, 1.0f)),
        body_marker(kGodObject, "god object", moving, Eigen::Vector4f(0.2f, 0.4f, 0.9f, 1.0f)),
        body_marker(kDevice, "device pose", moving, Eigen::Vector4f(0.9f, 0.2f, 0.2f, 0.35f))};
    writer_.write(bodies_, time_ns, marker_message(time_ns, markers));
  }

  void write_motion(std::size_t i) {
    const ReplayRow& row = recording_.cycles[i];
    const std::uint64_t time_ns = nanoseconds(row.t);
    const std::array frames{FrameTransform{kWorld, kDevice, device_[i]}, FrameTransform{kWorld, kGodObject, row.H_WS},
                            FrameTransform{kWorld, kDeviceCentre, Pose{Quaternion::Identity(), device_[i] * p_M_}}};
    writer_.write(tf_, time_ns, transform_message(time_ns, frames));
    writer_.write(wrench_, time_ns, wrench_message(time_ns, kDeviceCentre, row.wrench));
    if (i > 0 && row.t < next_arrow_) return;
    next_arrow_ = row.t + kArrowPeriod;
    const std::array arrow{force_arrow(row.wrench.force)};
    writer_.write(arrow_, time_ns, marker_message(time_ns, arrow));
  }

  /// Returns the arrow of a force [N]. The largest force of the recording is as long as the moving body.
  Marker force_arrow(const Vector3& force) const {
    Marker marker{.frame = kDeviceCentre,
                  .name = "force",
                  .type = Marker::Type::kArrow,
                  .action = force.isZero() ? Marker::Action::kRemove : Marker::Action::kShow,
                  .scale = arrow_length_ * Vector3(0.02, 0.05, 0.08),
                  .color = Eigen::Vector4f(0.9f, 0.1f, 0.3f, 1.0f),
                  .points = {}};
    if (!force.isZero()) marker.points = {Vector3::Zero(), arrow_length_ / largest_force_ * force};
    return marker;
  }

  void write_cycle(std::size_t i) {
    const ReplayRow& row = recording_.cycles[i];
    const std::uint64_t time_ns = nanoseconds(row.t);
    CdrWriter cycle;
    append_header(cycle, time_ns, kWorld);
    cycle.string(row.status);
    cycle.float64(row.depth);
    cycle.float64((device_[i] * p_M_ - row.H_WS * p_M_).norm());
    cycle.uint32(static_cast<std::uint32_t>(std::clamp(row.contacts, 0.0, 1e9)));
    writer_.write(cycle_, time_ns, cycle.bytes());
    if (!solver_times_) return;
    CdrWriter times;
    append_header(times, time_ns, "");
    times.float64(1e-9 * row.step1_ns);
    times.float64(1e-9 * row.solve_ns);
    writer_.write(*solver_times_, time_ns, times.bytes());
  }

  void write_controller(const TelemetryRow& row) {
    const std::uint64_t time_ns = nanoseconds(row.cycle.t);
    writer_.write(joints_, time_ns, joint_message(time_ns, row.position, row.velocity, row.torque));
    CdrWriter cdr;
    append_header(cdr, time_ns, "");
    cdr.string(row.mode);
    cdr.int32(row.fault);
    cdr.float64(row.share);
    cdr.float64(row.late);
    cdr.float64(row.compute);
    cdr.float64(row.absorbed);
    writer_.write(controller_, time_ns, cdr.bytes());
  }

  const Recording& recording_;
  McapWriter& writer_;
  const std::vector<Pose> device_;
  const Vector3 p_M_;          ///< the moving body's centre of mass [m]
  const double arrow_length_;  ///< of the largest force [m]
  const double largest_force_;
  double next_arrow_ = 0.0;  ///< [s]
  McapWriter::Id tf_static_ = 0, tf_ = 0, bodies_ = 0, arrow_ = 0, wrench_ = 0, cycle_ = 0, joints_ = 0,
                 controller_ = 0;
  std::optional<McapWriter::Id> solver_times_;  ///< of a replay
};

}  // namespace

void read_cycles(const std::filesystem::path& file, Recording& recording) {
  files::require_regular_input(file, "make it with godobject-replay or godobject-controller, or check the path");
  if (figures::is_telemetry(file)) {
    recording.controller = figures::read_telemetry_log(file);
    for (const TelemetryRow& row : recording.controller) recording.cycles.push_back(row.cycle);
  } else {
    recording.cycles = figures::read_replay_log(file);
  }
  for (const double t : {recording.cycles.front().t, recording.cycles.back().t}) {
    if (t >= 0.0 && t < std::numeric_limits<std::int32_t>::max()) continue;
    throw Failure(ExitCode::kBadData,
                  fmt::format("{}: a record holds times from 0 to 2^31 s, and there is one of {} s; add a constant to "
                              "the times of the path, and replay it again",
                              file.string(), t));
  }
}

void write_record(const Recording& recording, McapWriter& writer) { RecordWriter(recording, writer).write(); }

}  // namespace godobject::mcap
