#include "toolchain/page/page_data.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "tests/page/page_reader.h"
#include "tests/page/page_scene.h"
#include "toolchain/command_line/failure.h"

namespace godobject::page {
namespace {

using command::ExitCode;
using command::Failure;

std::string refusal(const PageScene& scene) {
  try {
    page_data(scene);
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.exit_code(), ExitCode::kBadData);
    return failure.what();
  }
  return "";
}

TEST(PageData, HoldsTheMeshesWithinTheirQuantisation) {
  const PageScene scene = sliding_scene(3);
  const PageReader reader(page_data(scene));
  for (const auto& [key, mesh] : {std::pair("still", &scene.bodies.still), {"moving", &scene.bodies.moving}}) {
    const auto& body = reader.header().at(key);
    for (int axis = 0; axis < 3; ++axis) {
      const auto index = static_cast<std::size_t>(axis);
      const double low = body.at("low").at(index);
      const double high = body.at("high").at(index);
      const std::vector<double> offsets = reader.column(body.at("vertices").at(index));
      ASSERT_EQ(offsets.size(), mesh->vertices.size());
      for (std::size_t i = 0; i < offsets.size(); ++i)
        EXPECT_NEAR(low + offsets[i], mesh->vertices[i][axis], 0.5 * (high - low) / 65535 + 1e-12);
    }
    std::vector<double> corners;
    for (const auto& triangle : mesh->triangles) corners.insert(corners.end(), triangle.begin(), triangle.end());
    EXPECT_EQ(reader.column(body.at("triangles")), corners);
    EXPECT_TRUE(body.at("closed").get<bool>());
  }
  EXPECT_EQ(reader.header().at("still").at("name"), "plate");
}

TEST(PageData, HoldsThePosesAndNumbersOfEachCycle) {
  const PageScene scene = sliding_scene(50);
  const PageReader reader(page_data(scene));
  const auto& header = reader.header();
  const auto& replay = header.at("replays").at(0);
  const auto& log = scene.replays[0].log;
  EXPECT_EQ(header.at("cycles"), 50);
  EXPECT_EQ(header.at("bucket"), 1);
  for (std::size_t i = 0; i < log.size(); ++i) {
    const auto at = [&](const nlohmann::json& entry) { return reader.column(entry).at(i); };
    const Quaternion& q = log[i].H_WS.rotation;
    EXPECT_NEAR(at(header.at("t")), log[i].t, 1e-6);
    EXPECT_NEAR(at(header.at("device").at(0)), log[i].H_WD.translation.x(), 1e-7);
    EXPECT_NEAR(at(header.at("device").at(2)), 0.028, 1e-7);
    EXPECT_NEAR(at(replay.at("pose").at(2)), 0.03, 1e-7);
    EXPECT_NEAR(at(replay.at("pose").at(3)), q.w(), 1e-6);
    EXPECT_NEAR(at(replay.at("pose").at(6)), q.z(), 1e-6);
    EXPECT_NEAR(at(replay.at("force").at(0)), log[i].wrench.force.x(), 1e-4);
    EXPECT_NEAR(at(replay.at("torque").at(1)), 0.01, 1e-6);
    const auto& plots = replay.at("plots");
    EXPECT_NEAR(at(plots.at("force").at("values")), log[i].wrench.force.norm(), 1e-4);
    EXPECT_NEAR(at(plots.at("torque").at("values")), 0.01, 1e-6);
    EXPECT_NEAR(at(plots.at("depth").at("values")), -1e-5, 1e-8);
    EXPECT_NEAR(at(plots.at("stretch").at("values")), 2e-3, 1e-8);
    EXPECT_EQ(at(plots.at("contacts").at("values")), 4.0);
    EXPECT_NEAR(at(plots.at("time").at("values")), 2.5e-6, 1e-8);
    EXPECT_FALSE(plots.at("force").contains("extremes"));
    const auto status = static_cast<std::size_t>(at(replay.at("status")));
    EXPECT_EQ(header.at("statuses").at(status), log[i].status);
  }
}

TEST(PageData, MeasuresTheStretchAtTheCentreOfMass) {
  PageScene scene = sliding_scene(2);
  for (Vector3& vertex : scene.bodies.moving.vertices) vertex.x() += 0.1;  // the frame lies outside of the body
  scene.replays[0].log[1].H_WD = {exp_rotation(Vector3(0, 0, 0.02)), Vector3::Zero()};
  scene.replays[0].log[1].H_WS = Pose{};
  const PageReader reader(page_data(scene));
  const auto& stretch = reader.header().at("replays").at(0).at("plots").at("stretch").at("values");
  EXPECT_NEAR(reader.column(stretch).at(1), 2 * 0.1 * std::sin(0.01), 1e-7);  // a chord
  EXPECT_NEAR(reader.header().at("moving").at("centre").at(0), 0.1, 1e-9);
}

TEST(PageData, KeepsTheExtremesOfALongReplay) {
  PageScene scene = sliding_scene(60000);
  auto& log = scene.replays[0].log;
  log[40001].depth = 0.0012;  // a cycle that is no sample
  log[40002].wrench.force = Vector3(0, 0, 77.0);
  log[50001].contacts = 19.0;
  log[50002].solve_ns = 9e6;
  const PageReader reader(page_data(scene));
  const auto& header = reader.header();
  EXPECT_EQ(header.at("bucket"), 3);
  EXPECT_EQ(reader.column(header.at("t")).size(), 20000u);
  EXPECT_NEAR(reader.column(header.at("t")).at(7), log[21].t, 1e-6);
  const auto largest = [&](const char* name, const char* kind) {
    const auto numbers = reader.column(header.at("replays").at(0).at("plots").at(name).at(kind));
    return *std::max_element(numbers.begin(), numbers.end());
  };
  EXPECT_NEAR(largest("depth", "extremes"), 0.0012, 1e-8);
  EXPECT_NEAR(largest("force", "extremes"), 77.0, 1e-4);
  EXPECT_EQ(largest("contacts", "extremes"), 19.0);
  EXPECT_NEAR(largest("time", "extremes"), 9.002e-3, 1e-8);
  EXPECT_LT(largest("depth", "values"), 0.0);
}

TEST(PageData, RepeatsThePoseBeforeARowThatIsNoPose) {
  PageScene scene = sliding_scene(3);
  auto& row = scene.replays[0].log[1];
  row.status = "bad_input";
  row.H_WD.translation.x() = std::numeric_limits<double>::quiet_NaN();
  const PageReader reader(page_data(scene));
  const auto x = reader.column(reader.header().at("device").at(0));
  EXPECT_EQ(x[1], x[0]);
  EXPECT_EQ(reader.header().at("statuses").at(1), "bad_input");
}

TEST(PageData, HoldsTheWorkspaceOfAScene) {
  PageScene scene = sliding_scene(3);
  EXPECT_FALSE(PageReader(page_data(scene)).header().contains("workspace"));
  scene.workspace = format::Workspace{{-1, -2, -3}, {1, 2, 3}};
  const PageReader reader(page_data(scene));
  EXPECT_EQ(reader.header().at("workspace").at("low").at(2), -3.0);
  EXPECT_EQ(reader.header().at("workspace").at("high").at(0), 1.0);
}

TEST(PageData, TellsOpenBodiesFromClosedOnes) {
  PageScene scene = sliding_scene(3);
  scene.bodies.still.triangles.pop_back();
  EXPECT_FALSE(PageReader(page_data(scene)).header().at("still").at("closed").get<bool>());
}

TEST(PageData, PutsTheCameraWhereItShowsTheTouchingBodies) {
  const PageReader reader(page_data(sliding_scene(1000)));
  const auto& camera = reader.header().at("camera");
  const auto vector = [](const nlohmann::json& v) { return Vector3(v.at(0), v.at(1), v.at(2)); };
  const Vector3 target = vector(camera.at("target"));
  const Vector3 eye = vector(camera.at("eye"));
  EXPECT_LT((target - Vector3(0.05, 0, 0.03)).norm(), 0.03);  // the middle of the way of 0.1 m
  const double radius = (eye - target).norm() * std::sin(camera.at("half_view").get<double>());
  EXPECT_GT(radius, 0.05);  // the way
  EXPECT_LT(radius, 0.15);  // not the plate
  EXPECT_GT(eye.z(), target.z());
}

TEST(PageData, RefusesReplaysOfDifferentMotions) {
  PageScene scene = sliding_scene(5);
  scene.replays.push_back({"paper", sliding_log(4)});
  EXPECT_NE(refusal(scene).find("contact and paper: are not replays of the same motion: 5 and 4 cycles"),
            std::string::npos);
  scene.replays[1].log = sliding_log(5);
  EXPECT_EQ(refusal(scene), "");
  scene.replays[1].log[3].H_WD.translation.y() = 1e-3;
  EXPECT_NE(refusal(scene).find("the device poses at 0.003 s differ"), std::string::npos);
  scene.replays[1].log = sliding_log(5);
  scene.replays[1].log[4].t = 0.0045;
  EXPECT_NE(refusal(scene).find("the times of row 5 are 0.004 and 0.0045 s"), std::string::npos);
}

TEST(PageData, RefusesABodyThatMakesThePageTooLarge) {
  PageScene scene = sliding_scene(3);
  const auto triangle = scene.bodies.still.triangles.front();
  scene.bodies.still.triangles.assign(kMaxTriangles + 1, triangle);
  EXPECT_NE(refusal(scene).find("plate: has 500001 triangles, a page shows at most 500000"), std::string::npos);
}

TEST(PageData, StoresTheCommonMotionOfReplaysOnce) {
  PageScene scene = sliding_scene(2000);
  const std::size_t one = page_data(scene).size();
  scene.replays.push_back({"paper", scene.replays[0].log});
  EXPECT_LT(page_data(scene).size(), one + 3000);  // only the second entry of the header
}

}  // namespace
}  // namespace godobject::page
