#include "toolchain/mcap/record.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "tests/mcap/mcap_reader.h"
#include "tests/mcap/written_file.h"
#include "tests/viewer/boxes.h"
#include "toolchain/command_line/failure.h"
#include "toolchain/mcap/cycle_messages.h"
#include "toolchain/replay/replay.h"

namespace godobject::mcap {
namespace {

using command::ExitCode;
using command::Failure;
using figures::ReplayRow;
using figures::TelemetryRow;

/// A box whose centre of mass is at (0.01, 0.02, 0.03) m, over a plate.
Recording box_recording() {
  Recording recording;
  recording.bodies = {viewer::box(Vector3(0.2, 0.2, 0.01)), viewer::box(Vector3(0.03, 0.03, 0.03))};
  for (Vector3& vertex : recording.bodies.moving.vertices) vertex += Vector3(0.01, 0.02, 0.03);
  return recording;
}

Vector3 random_vector(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Vector3(normal(random), normal(random), normal(random));
}

Pose random_pose(std::mt19937& random) { return {exp_rotation(random_vector(random)), random_vector(random)}; }

/// Returns cycles of 1 ms with random numbers in every column.
figures::ReplayLog random_cycles(std::size_t count) {
  std::mt19937 random(11);
  figures::ReplayLog cycles;
  for (std::size_t i = 0; i < count; ++i) {
    ReplayRow row;
    row.t = 0.25 + 1e-3 * static_cast<double>(i);
    row.H_WD = random_pose(random);
    row.H_WS = random_pose(random);
    row.wrench = {random_vector(random), random_vector(random)};
    row.depth = random_vector(random).x();
    row.contacts = static_cast<double>(i % 7);
    row.step1_ns = 1000.0;
    row.solve_ns = 500.0;
    row.status = i % 2 == 0 ? "contact" : "free";
    cycles.push_back(row);
  }
  return cycles;
}

std::string record_bytes(const Recording& recording) {
  return written_file([&](McapWriter& writer) { write_record(recording, writer); });
}

/// Reads the begin of a message with a header, and checks its time [s] and its frame.
void expect_header(CdrReader& reader, double t, const std::string& frame) {
  const double sec = reader.number<std::int32_t>();
  EXPECT_NEAR(sec + 1e-9 * reader.number<std::uint32_t>(), t, 1e-9);
  EXPECT_EQ(reader.text(), frame);
}

void expect_vector(CdrReader& reader, const Vector3& expected) {
  for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(reader.real(), expected[axis]);
}

void expect_pose(CdrReader& reader, const Pose& expected) {
  expect_vector(reader, expected.translation);
  for (const double component : {expected.rotation.x(), expected.rotation.y(), expected.rotation.z()})
    EXPECT_EQ(reader.real(), component);
  EXPECT_EQ(reader.real(), expected.rotation.w());
}

TEST(Record, HoldsThePosesAndTheWrenchOfEachCycle) {
  Recording recording = box_recording();
  recording.cycles = random_cycles(500);
  const std::string bytes = record_bytes(recording);
  const McapReader file(bytes);
  const auto tf = file.on("/tf"), wrench = file.on("/wrench");
  ASSERT_EQ(tf.size(), 500u);
  ASSERT_EQ(wrench.size(), 500u);
  for (std::size_t i = 0; i < 500; ++i) {
    const ReplayRow& row = recording.cycles[i];
    EXPECT_EQ(tf[i]->log_ns, 250'000'000 + 1'000'000 * i);
    CdrReader frames(tf[i]->data);
    ASSERT_EQ(frames.number<std::uint32_t>(), 3u);
    expect_header(frames, row.t, "W");
    EXPECT_EQ(frames.text(), "device");
    expect_pose(frames, row.H_WD);
    expect_header(frames, row.t, "W");
    EXPECT_EQ(frames.text(), "god_object");
    expect_pose(frames, row.H_WS);
    expect_header(frames, row.t, "W");
    EXPECT_EQ(frames.text(), "device_centre");
    const Vector3 centre = row.H_WD * Vector3(0.01, 0.02, 0.03);
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(frames.real(), centre[axis], 1e-12);
    for (const double identity : {0.0, 0.0, 0.0, 1.0}) EXPECT_EQ(frames.real(), identity);
    EXPECT_TRUE(frames.at_end());
    CdrReader force(wrench[i]->data);
    expect_header(force, row.t, "device_centre");
    expect_vector(force, row.wrench.force);
    expect_vector(force, row.wrench.torque);
    EXPECT_TRUE(force.at_end());
  }
}

TEST(Record, HoldsTheOutcomeAndTheTimesOfEachCycle) {
  Recording recording = box_recording();
  recording.cycles = random_cycles(3);
  const std::string bytes = record_bytes(recording);
  const McapReader file(bytes);
  const auto cycles = file.on("/cycle"), times = file.on("/solver_times");
  ASSERT_EQ(cycles.size(), 3u);
  ASSERT_EQ(times.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const ReplayRow& row = recording.cycles[i];
    CdrReader cycle(cycles[i]->data);
    expect_header(cycle, row.t, "W");
    EXPECT_EQ(cycle.text(), row.status);
    EXPECT_EQ(cycle.real(), row.depth);
    const Vector3 p_M(0.01, 0.02, 0.03);
    EXPECT_NEAR(cycle.real(), (row.H_WD * p_M - row.H_WS * p_M).norm(), 1e-12);
    EXPECT_EQ(cycle.number<std::uint32_t>(), i);
    EXPECT_TRUE(cycle.at_end());
    CdrReader time(times[i]->data);
    expect_header(time, row.t, "");
    EXPECT_DOUBLE_EQ(time.real(), 1e-6);
    EXPECT_DOUBLE_EQ(time.real(), 0.5e-6);
    EXPECT_TRUE(time.at_end());
  }
  EXPECT_TRUE(file.on("/joint_states").empty());
}

/// A marker of a record.
struct ReadMarker {
  std::string frame, name;
  std::int32_t type = 0, action = 0;
  std::vector<Vector3> points;
};

Vector3 read_vector(CdrReader& reader) {
  const double x = reader.real(), y = reader.real();
  return Vector3(x, y, reader.real());
}

/// Returns the markers of a visualization_msgs/MarkerArray.
std::vector<ReadMarker> read_markers(const std::string& message) {
  CdrReader reader(message);
  std::vector<ReadMarker> markers(reader.number<std::uint32_t>());
  for (ReadMarker& marker : markers) {
    reader.number<std::uint32_t>();  // stamp
    reader.number<std::uint32_t>();
    marker.frame = reader.text();
    marker.name = reader.text();
    reader.number<std::uint32_t>();  // id
    marker.type = reader.number<std::int32_t>();
    marker.action = reader.number<std::int32_t>();
    expect_pose(reader, Pose{});
    read_vector(reader);  // scale
    for (int i = 0; i < 4; ++i) EXPECT_LE(std::abs(reader.single() - 0.5f), 0.5f) << "colour";
    EXPECT_EQ(reader.number<std::uint32_t>() + reader.number<std::uint32_t>(), 0u) << "lifetime";
    EXPECT_EQ(reader.number<std::uint8_t>(), 1) << "frame_locked";
    marker.points.resize(reader.number<std::uint32_t>());
    for (Vector3& point : marker.points) point = read_vector(reader);
    EXPECT_EQ(reader.number<std::uint32_t>(), 0u) << "colors";
    EXPECT_EQ(reader.text(), "") << "texture_resource";
    expect_header(reader, 0.0, "");
    EXPECT_EQ(reader.text(), "") << "texture.format";
    EXPECT_EQ(reader.number<std::uint32_t>() + reader.number<std::uint32_t>(), 0u) << "data, uv_coordinates";
    EXPECT_EQ(reader.text() + reader.text() + reader.text(), "") << "text, mesh_resource, filename";
    EXPECT_EQ(reader.number<std::uint32_t>(), 0u) << "mesh_file.data";
    EXPECT_EQ(reader.number<std::uint8_t>(), 0) << "mesh_use_embedded_materials";
  }
  EXPECT_TRUE(reader.at_end());
  return markers;
}

TEST(Record, HoldsTheBodiesInTheirFrames) {
  Recording recording = box_recording();
  recording.cycles = random_cycles(20);
  const std::string bytes = record_bytes(recording);
  const McapReader file(bytes);
  const auto bodies = file.on("/bodies");
  ASSERT_EQ(bodies.size(), 1u);
  EXPECT_EQ(bodies[0]->log_ns, 250'000'000u);
  const auto markers = read_markers(bodies[0]->data);
  ASSERT_EQ(markers.size(), 3u);
  EXPECT_EQ(markers[0].frame, "W");
  EXPECT_EQ(markers[1].frame, "god_object");
  EXPECT_EQ(markers[2].frame, "device");
  for (const ReadMarker& marker : markers) {
    EXPECT_EQ(marker.type, 11);
    EXPECT_EQ(marker.action, 0);
    ASSERT_EQ(marker.points.size(), 36u);
    const auto& mesh = marker.frame == "W" ? recording.bodies.still : recording.bodies.moving;
    for (std::size_t i = 0; i < 36; ++i)
      EXPECT_EQ(marker.points[i], mesh.vertices[mesh.triangles[i / 3][i % 3]]) << marker.name << ' ' << i;
  }
}

TEST(Record, DrawsTheForceAHundredTimesASecond) {
  Recording recording = box_recording();
  recording.cycles = random_cycles(100);
  for (ReplayRow& row : recording.cycles) row.wrench.force = Vector3(0.0, 0.0, 2.0);
  recording.cycles[0].wrench.force = Vector3::Zero();
  recording.cycles[55].wrench.force = Vector3(4.0, 0.0, 0.0);  // the largest
  const std::string bytes = record_bytes(recording);
  const McapReader file(bytes);
  const auto arrows = file.on("/force_arrow");
  ASSERT_NEAR(static_cast<double>(arrows.size()), 10.0, 1.0);
  const auto none = read_markers(arrows[0]->data);
  EXPECT_EQ(none.at(0).action, 2);
  const ReadMarker arrow = read_markers(arrows[1]->data).at(0);
  EXPECT_EQ(arrow.frame, "device_centre");
  EXPECT_EQ(arrow.type, 0);
  EXPECT_EQ(arrow.action, 0);
  ASSERT_EQ(arrow.points.size(), 2u);
  EXPECT_EQ(arrow.points[0], Vector3::Zero());
  const double half_diagonal = 0.5 * 0.06 * std::sqrt(3.0);  // for half the largest force
  EXPECT_LE((arrow.points[1] - Vector3(0.0, 0.0, half_diagonal)).norm(), 1e-12);
}

TEST(Record, SaysWhichAxisPointsUp) {
  for (int axis = 0; axis < 3; ++axis) {
    Recording recording = box_recording();
    recording.cycles = random_cycles(1);
    recording.up_axis = axis;
    const std::string bytes = record_bytes(recording);
    const McapReader file(bytes);
    const auto found = file.on("/tf_static");
    ASSERT_EQ(found.size(), 1u);
    CdrReader reader(found[0]->data);
    ASSERT_EQ(reader.number<std::uint32_t>(), 1u);
    expect_header(reader, 0.25, "upright");
    EXPECT_EQ(reader.text(), "W");
    EXPECT_EQ(read_vector(reader), Vector3::Zero());
    const Vector3 xyz = read_vector(reader);
    const Quaternion rotation(reader.real(), xyz.x(), xyz.y(), xyz.z());
    EXPECT_LE((rotation * Vector3::Unit(axis) - Vector3::UnitZ()).norm(), 1e-12) << axis;
  }
}

TEST(Record, RepeatsTheDevicePoseBeforeARowThatHasNone) {
  Recording recording = box_recording();
  recording.cycles = random_cycles(3);
  recording.cycles[1].H_WD.translation.x() = std::numeric_limits<double>::quiet_NaN();
  recording.cycles[1].status = "bad_input";
  const std::string bytes = record_bytes(recording);
  const McapReader file(bytes);
  CdrReader reader(file.on("/tf").at(1)->data);
  reader.number<std::uint32_t>();
  expect_header(reader, 0.251, "W");
  EXPECT_EQ(reader.text(), "device");
  expect_pose(reader, recording.cycles[0].H_WD);
}

/// The force of a telemetry is along the axes of the room; here a turn by 90 degrees about z leads from them to W.
TEST(Record, TurnsTheForceOfATelemetry) {
  const auto file = std::filesystem::path(testing::TempDir()) / ("mcap_turned_" + std::to_string(::getpid()) + ".csv");
  std::ofstream(file)
      << "t_s,mode,fault,share,outcome,contacts,depth_m,fx_N,fy_N,fz_N,tx_Nm,ty_Nm,tz_Nm,"
         "dpx_m,dpy_m,dpz_m,dqw,dqx,dqy,dqz,gpx_m,gpy_m,gpz_m,gqw,gqx,gqy,gqz,torque1_Nm,wqw,wqx,wqy,wqz\n"
         "0.001,running,0,1,contact,1,0,3,4,5,0,1,0,0,0,0,1,0,0,0,0,0,0,1,0,0,0,9,"
         "0.70710678118654757,0,0,0.70710678118654757\n";
  Recording recording;
  read_cycles(file, recording);
  std::filesystem::remove(file);
  ASSERT_EQ(recording.cycles.size(), 1u);
  EXPECT_TRUE(recording.cycles[0].wrench.force.isApprox(Vector3(-4, 3, 5), 1e-12));
  EXPECT_TRUE(recording.cycles[0].wrench.torque.isApprox(Vector3(-1, 0, 0), 1e-12));
}

TEST(Record, HoldsJointsAndControllerOfATelemetry) {
  Recording recording = box_recording();
  recording.cycles = random_cycles(2);
  for (const ReplayRow& row : recording.cycles) {
    TelemetryRow telemetry;
    telemetry.cycle = row;
    telemetry.mode = "running";
    telemetry.fault = 3;
    telemetry.share = 0.5;
    telemetry.position = {0.1, 0.2};
    telemetry.velocity = {0.3, 0.4};
    telemetry.torque = {5.0, 6.0};
    telemetry.late = 1e-6;
    telemetry.compute = 2e-5;
    telemetry.absorbed = -0.25;
    recording.controller.push_back(telemetry);
  }
  const std::string bytes = record_bytes(recording);
  const McapReader file(bytes);
  EXPECT_TRUE(file.on("/solver_times").empty());
  ASSERT_EQ(file.on("/joint_states").size(), 2u);
  CdrReader joints(file.on("/joint_states")[1]->data);
  expect_header(joints, 0.251, "");
  ASSERT_EQ(joints.number<std::uint32_t>(), 2u);
  EXPECT_EQ(joints.text(), "joint1");
  EXPECT_EQ(joints.text(), "joint2");
  for (const double first : {0.1, 0.3, 5.0}) {
    ASSERT_EQ(joints.number<std::uint32_t>(), 2u);
    EXPECT_EQ(joints.real(), first);
    joints.real();
  }
  ASSERT_EQ(file.on("/controller").size(), 2u);
  CdrReader controller(file.on("/controller")[1]->data);
  expect_header(controller, 0.251, "");
  EXPECT_EQ(controller.text(), "running");
  EXPECT_EQ(controller.number<std::int32_t>(), 3);
  for (const double number : {0.5, 1e-6, 2e-5, -0.25}) EXPECT_EQ(controller.real(), number);
  EXPECT_TRUE(controller.at_end());
}

void expect_refused(const std::function<void()>& work, const std::string& part) {
  try {
    work();
    FAIL() << "accepted: " << part;
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.exit_code(), ExitCode::kBadData);
    EXPECT_NE(std::string(failure.what()).find(part), std::string::npos) << failure.what();
  }
}

TEST(Record, RefusesTimesThatAHeaderCannotHold) {
  const auto file = std::filesystem::path(testing::TempDir()) / ("mcap_test_" + std::to_string(::getpid()) + ".csv");
  for (const std::string t : {"-0.001", "2147483648"}) {
    std::ofstream(file) << replay::kColumns << '\n' << t << ",0,0,0,1,0,0,0,0,0,0,1,0,0,0,0,0,0,0,0,0,0,0,1,0,0,free\n";
    Recording recording;
    expect_refused([&] { read_cycles(file, recording); }, "is one of " + t + " s");
  }
  std::filesystem::remove(file);
}

TEST(Record, RefusesABodyThatMakesTheRecordTooLarge) {
  Recording recording = box_recording();
  recording.cycles = random_cycles(1);
  recording.bodies.moving.triangles.resize(kMaxTriangles + 1, {0, 1, 2});
  expect_refused([&] { record_bytes(recording); }, "god object: has 200001 triangles");
}

TEST(Record, OfAMinuteOfAnArmIsAMegabyteASecond) {
  Recording recording = box_recording();
  recording.cycles = random_cycles(60'000);
  for (const ReplayRow& row : recording.cycles) {
    TelemetryRow telemetry;
    telemetry.cycle = row;
    telemetry.mode = "running";
    telemetry.position = telemetry.velocity = telemetry.torque = std::vector<double>(7, 0.5);
    recording.controller.push_back(telemetry);
  }
  const std::string bytes = record_bytes(recording);
  EXPECT_LT(bytes.size(), 66'000'000u);
  const McapReader file(bytes);
  EXPECT_EQ(file.on("/tf").size(), 60'000u);
  const std::size_t mean = bytes.size() / file.chunks;  // the last one is shorter, and indexes add 8 %
  EXPECT_NEAR(static_cast<double>(mean), static_cast<double>(McapWriter::kChunkSize), 0.1e6);
  RecordProperty("megabytes", static_cast<int>(bytes.size() / 1'000'000));
}

}  // namespace
}  // namespace godobject::mcap
