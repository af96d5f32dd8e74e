// The small types of scenes: what they are before anything is set, and their codes.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "core/scene/field.h"
#include "core/scene/format.h"
#include "core/scene/pointshell.h"
#include "core/scene/workspace_box.h"
#include "godobject/report.h"
#include "godobject/scene.h"
#include "tests/support/random.h"
#include "tests/support/whole_image.h"

namespace godobject {
namespace {

using format::SectionId;
using test::ImageParts;

TEST(CycleReport, BeginsAsAFreeCycleWithoutForce) {
  const CycleReport report;
  EXPECT_EQ(report.H_WS, Pose());
  EXPECT_EQ(report.H_WS.rotation.coeffs(), Eigen::Vector4d(0.0, 0.0, 0.0, 1.0));
  EXPECT_EQ(report.H_WS.translation, Vector3::Zero());
  for (const Wrench& wrench : {report.force.spring_W, report.force.total_W}) {
    EXPECT_EQ(wrench.force, Vector3::Zero());
    EXPECT_EQ(wrench.torque, Vector3::Zero());
  }
  EXPECT_EQ(report.penetration, 0.0);
  EXPECT_EQ(report.contacts, 0u);
  EXPECT_EQ(report.dropped, 0u);
  EXPECT_EQ(report.substeps, 0u);
  EXPECT_FALSE(report.unconverged);
  EXPECT_FALSE(report.outside);
  EXPECT_EQ(report.outcome, Outcome::kFree);
  const StepTimes times;
  EXPECT_EQ(times.now_ns, nullptr);
  EXPECT_EQ(times.step1_ns, 0);
  EXPECT_EQ(times.solve_ns, 0);
  EXPECT_EQ(times.since_ns, 0);
}

TEST(SceneValues, BeginAsNothing) {
  const Motion motion;
  EXPECT_EQ(motion.translation, Vector3::Zero());
  EXPECT_EQ(motion.rotation, Vector3::Zero());
  const Gains gains;
  EXPECT_EQ(gains.stiffness, 0.0);
  EXPECT_EQ(gains.damping, 0.0);
  EXPECT_EQ(gains.rotational, 0.0);
  const SurfaceDistance distance;
  EXPECT_EQ(distance.distance, 0.0);
  EXPECT_EQ(distance.normal_W, Vector3::Zero());
  EXPECT_FALSE(distance.known);
  const FieldSample sample;
  EXPECT_EQ(sample.distance, 0.0);
  EXPECT_EQ(sample.gradient, Vector3::Zero());
  EXPECT_FALSE(sample.known);
  EXPECT_EQ(sample.clearance, 0.0);
  const LayerSample layer;
  EXPECT_EQ(layer.layer, 0);
  EXPECT_EQ(layer.to_center, Vector3::Zero());
  EXPECT_EQ(PointBatch{}.count, 0u);
  EXPECT_EQ(SampleBatch{}.count, 0u);
  const Pointshell shell;
  EXPECT_EQ(shell.size, 0u);
  for (const float* values : {shell.x, shell.y, shell.z, shell.normal_x, shell.normal_y, shell.normal_z}) {
    EXPECT_EQ(values, nullptr);
  }
  const BoundingSphere sphere;
  EXPECT_EQ(sphere.center, Vector3::Zero());
  EXPECT_EQ(sphere.radius, 1.0);
  const Voxelmap map;
  EXPECT_EQ(map.voxel_size(), 1.0);
  EXPECT_EQ(map.band(), 0.0);
  EXPECT_EQ(map.lipschitz(), 1.0);
  EXPECT_EQ(map.assured_clearance(), 0.0);
  EXPECT_FALSE(map.in_batches());
  EXPECT_EQ(map.surface_radius(Vector3(3.0, 0.0, -4.0)), 5.0);
  const FieldSample nowhere = map.sample(Vector3::Zero());  // a grid without cells: everything is outside
  EXPECT_FALSE(nowhere.known);
  EXPECT_EQ(nowhere.distance, 0.0);
  EXPECT_EQ(map.sample(Vector3(3.0, 0.0, -4.0)).clearance, 5.0);
}

TEST(WorkspaceBox, IsEverywhereUntilItIsLimited) {
  const WorkspaceBox box;
  EXPECT_FALSE(box.limited);
  EXPECT_TRUE(box.contains(Vector3(1e300, -1e300, 0.0)));
}

TEST(WorkspaceBox, MovesAPointToItsNearestFaces) {
  WorkspaceBox box;
  box.low = Vector3(-1.0, -2.0, -3.0);
  box.high = Vector3(1.0, 2.0, 4.0);
  EXPECT_EQ(box.nearest(Vector3(5.0, 0.5, -9.0)), Vector3(1.0, 0.5, -3.0));
  EXPECT_EQ(box.nearest(Vector3(-5.0, 7.0, 0.0)), Vector3(-1.0, 2.0, 0.0));
  EXPECT_EQ(box.nearest(Vector3(0.25, -2.5, 8.0)), Vector3(0.25, -2.0, 4.0));
  for (int axis = 0; axis < 3; ++axis) {
    for (const double end : {box.low[axis], box.high[axis]}) {
      Vector3 p(0.25, 0.5, 0.125);
      p[axis] = end;
      EXPECT_TRUE(box.contains(p)) << "the faces belong to the box";
      EXPECT_EQ(box.nearest(p), p);
      p[axis] = std::nextafter(end, 2.0 * end);
      EXPECT_FALSE(box.contains(p));
      EXPECT_EQ(box.nearest(p)[axis], end);
      p[axis] = std::numeric_limits<double>::quiet_NaN();
      EXPECT_TRUE(std::isnan(box.nearest(p)[axis]));
      EXPECT_FALSE(box.contains(p));
    }
  }
}

TEST(Pointshell, EnlargesANodesSphereByItsRounding) {
  format::Node node{};
  node.center[0] = 1.0f, node.center[1] = -2.0f, node.center[2] = 4.0f;
  node.radius = 0.5f;
  EXPECT_EQ(center_of(node), Vector3(1.0, -2.0, 4.0));
  EXPECT_NEAR(radius_of(node), 0.5 + 1e-6 + 14e-6, 1e-15);  // two millionths of the radius and of |1| + |-2| + |4|
  EXPECT_EQ(sphere_of(node).center, Vector3(1.0, -2.0, 4.0));
  EXPECT_EQ(sphere_of(node).radius, radius_of(node));
  format::Body body{};
  body.sphere_center[0] = 3.0, body.sphere_center[1] = 5.0, body.sphere_center[2] = 7.0, body.sphere_radius = 11.0;
  EXPECT_EQ(sphere_of(body).center, Vector3(3.0, 5.0, 7.0));
  EXPECT_EQ(sphere_of(body).radius, 11.0);
}

TEST(SceneFormat, CodesABoundThatIsNotSmaller) {
  EXPECT_EQ(format::encode_lipschitz(1.0f), 0);
  EXPECT_EQ(format::decode_lipschitz(0), 1.0f);
  EXPECT_EQ(format::decode_lipschitz(1), 1.0f + 1.0f / 4096.0f);
  EXPECT_EQ(format::decode_lipschitz(4096), 2.0f);
  EXPECT_EQ(format::decode_lipschitz(0xffff), 65528.0f);
  for (std::uint32_t code = 0; code < 0x10000; code += 7) {
    const float bound = format::decode_lipschitz(static_cast<std::uint16_t>(code));
    ASSERT_EQ(format::encode_lipschitz(bound), code);
    if (code > 0) {
      ASSERT_EQ(format::encode_lipschitz(std::nextafter(bound, 0.0f)), code) << "rounded up";
    }
    if (code < 0xffff) {
      ASSERT_EQ(format::encode_lipschitz(std::nextafter(bound, 1e9f)), code + 1) << "rounded up";
    }
  }
}

TEST(SceneFormat, CodesAFarClearanceThatIsNotLarger) {
  test::Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const auto clearance = static_cast<float>(std::exp(random.between(-20.0, 18.0)));
    for (const bool inside : {false, true}) {
      const std::uint32_t entry = format::index_entry::encode_far(inside, clearance);
      ASSERT_EQ(entry >> 30, inside ? 3u : 2u);
      const float decoded = format::index_entry::far_clearance(entry);
      ASSERT_LE(decoded, clearance);
      ASSERT_GE(decoded, clearance * (1.0f - 1.0f / 4e6f));
    }
  }
  EXPECT_EQ(format::index_entry::far_clearance(format::index_entry::encode_far(true, 0.75f)), 0.75f);
}

/// Worked out with Python's integers from the description: h = (h ^ word) * 0x9e3779b97f4a7c15, then h ^= h >> 32.
TEST(SceneFormat, SumsWordsAsDescribed) {
  std::array<std::byte, 16> bytes;
  for (std::size_t i = 0; i < 16; ++i) bytes[i] = static_cast<std::byte>(i + 1);
  EXPECT_EQ(format::checksum(bytes.data(), 0), 0xcbf29ce484222325u);
  EXPECT_EQ(format::checksum(bytes.data(), 8), 0x45415e97ba6c7963u);
  EXPECT_EQ(format::checksum(bytes.data(), 16), 0xe9c31aceecc4d57cu);
  EXPECT_EQ(format::checksum(bytes.data() + 8, 8, format::checksum(bytes.data(), 8)),
            format::checksum(bytes.data(), 16));
  for (std::size_t i = 0; i < 16; ++i) bytes[i] = static_cast<std::byte>(240 + i);
  EXPECT_EQ(format::checksum(bytes.data(), 16), 0x02b94dfe2e387bd7u);
}

/// An analytic field for the batches of DistanceField.
struct PlaneField {
  FieldSample sample(const Vector3& p) const noexcept { return {p.z(), Vector3::UnitZ(), p.z() < 1.0, 0.5 + p.x()}; }
};

TEST(DistanceField, LooksUpABatchPointByPoint) {
  const Pose H{exp_rotation(Vector3(0.3, -0.2, 0.7)), Vector3(0.25, -0.5, 1.0)};
  test::Random random(2);
  for (std::uint32_t count = 1; count <= 9; ++count) {
    PointBatch points;
    SampleBatch samples;
    points.count = samples.count = count;
    samples.known = random.integer(0, 1) == 0 ? 0 : ~std::uint64_t{0};
    for (std::uint32_t i = 0; i < SampleBatch::kCapacity; ++i) {
      const Vector3 p = random.in_cube(1.0);
      points.x[i] = samples.x[i] = static_cast<float>(p.x());
      points.y[i] = samples.y[i] = static_cast<float>(p.y());
      points.z[i] = samples.z[i] = static_cast<float>(p.z());
      points.clearance[i] = -7.0f;
      samples.distance[i] = samples.clearance[i] = samples.gradient_x[i] = -7.0;
    }
    sample_clearances(PlaneField(), H, points);
    sample_each(PlaneField(), H, samples);
    for (std::uint32_t i = 0; i < count; ++i) {
      const Vector3 p = H * Vector3(static_cast<double>(points.x[i]), static_cast<double>(points.y[i]),
                                    static_cast<double>(points.z[i]));
      const FieldSample expected = PlaneField().sample(p);
      EXPECT_NEAR(static_cast<double>(points.clearance[i]), expected.clearance * (1.0 - 1e-6), 1.3e-7);
      EXPECT_LT((stored_position(samples, i) - p).norm(), 1e-15);
      const FieldSample found = stored_sample(samples, i);
      EXPECT_NEAR(found.distance, expected.distance, 1e-15);
      EXPECT_NEAR(found.clearance, expected.clearance, 1e-15);
      EXPECT_EQ(found.gradient, Vector3::UnitZ());
      EXPECT_EQ(found.known, expected.known);
    }
    for (std::uint32_t i = count; i < SampleBatch::kCapacity; ++i) {
      const bool filled = i < (count + 3) / 4 * 4;  // up to the next multiple of four the results are finite
      EXPECT_EQ(points.clearance[i], -7.0f);
      EXPECT_EQ(samples.distance[i], filled ? 0.0 : -7.0) << i << " of " << count;
      EXPECT_EQ(samples.clearance[i], filled ? 0.0 : -7.0) << i << " of " << count;
      EXPECT_EQ(samples.gradient_x[i], filled ? 0.0 : -7.0) << i << " of " << count;
    }
  }
}

TEST(SceneObject, HoldsNothingBeforeItIsOpened) {
  const Scene scene;
  for (const Solver solver : {Solver::kPaper, Solver::kCorrected, Solver::kContact}) EXPECT_FALSE(scene.holds(solver));
  EXPECT_FALSE(scene.has_friction());
  EXPECT_EQ(scene.gains().stiffness, 0.0);
}

TEST(SceneObject, ShowsItsImageInEveryCopy) {
  ImageParts parts = test::whole_image();
  auto& settings = parts.item<format::Settings>(SectionId::kSettings);
  settings.friction = 1;
  settings.solvers = 0b110;
  settings.default_solver = 2;
  settings.stiffness = 11.0, settings.damping = 13.0, settings.coupling_rotation = 17.0;
  settings.period = 0.002;
  const test::SceneImage image = parts.assemble();
  Scene scene;
  ASSERT_EQ(Scene::open(image.bytes(), scene), Status::kOk);
  const Scene copy(scene);
  Scene assigned;
  EXPECT_EQ(&(assigned = scene), &assigned);
  const Scene of_view = Scene::of(scene.view());
  for (const Scene* shown : std::array<const Scene*, 4>{&scene, &copy, &assigned, &of_view}) {
    EXPECT_EQ(shown->default_solver(), Solver::kContact);
    EXPECT_FALSE(shown->holds(Solver::kPaper));
    EXPECT_TRUE(shown->holds(Solver::kCorrected));
    EXPECT_TRUE(shown->holds(Solver::kContact));
    EXPECT_TRUE(shown->has_friction());
    EXPECT_EQ(shown->voxel_size(), 0.01);
    EXPECT_EQ(shown->center_of_mass_M(), Vector3(0.1, 0.2, 0.3));
    EXPECT_EQ(shown->gains().stiffness, 11.0);
    EXPECT_EQ(shown->gains().damping, 13.0);
    EXPECT_EQ(shown->gains().rotational, 17.0);
    EXPECT_EQ(shown->period(), 0.002);
    EXPECT_EQ(shown->view().features_origin, Vector3(0.1, 0.2, 0.3));
    EXPECT_TRUE(shown->view().has_features());
    EXPECT_EQ(shown->view().features.normal_y, nullptr) << "feature points have no normals";
  }
  EXPECT_EQ(Scene::open(image.bytes().first(100), scene), Status::kImageTruncated);
  EXPECT_EQ(scene.gains().stiffness, 11.0) << "a refused image has changed the scene";
}

TEST(SceneObject, KnowsDistanceAndNormalOfABall) {
  const test::SceneImage image = test::build_scene_image([] {
    test::SceneDescription ball;
    ball.distance = [](const Vector3& p) { return test::ball_distance(p, 0.05); };
    ball.surface_min = Vector3::Constant(-0.05);
    ball.surface_max = Vector3::Constant(0.05);
    ball.voxel_size = 0.002;
    ball.points = {Vector3(0.01, 0.0, 0.0)};
    return ball;
  }());
  Scene scene;
  ASSERT_EQ(Scene::open(image.bytes(), scene), Status::kOk);
  test::Random random(3);
  for (int i = 0; i < 500; ++i) {
    const Vector3 direction = random.direction();
    const double distance = random.between(-0.006, 0.006);
    const SurfaceDistance found = scene.distance((0.05 + distance) * direction);
    ASSERT_TRUE(found.known);
    ASSERT_NEAR(found.distance, distance, 3e-5);  // a voxel's sagitta, 2 mm squared over 8 times 50 mm, and more
    ASSERT_NEAR(found.normal_W.norm(), 1.0, 1e-14);
    ASSERT_LT((found.normal_W - direction).norm(), 0.05);
  }
  for (const double radius : {0.0, 0.02, 0.08, 5.0}) {
    const SurfaceDistance found = scene.distance(radius * Vector3::UnitY());
    EXPECT_FALSE(found.known);
    EXPECT_EQ(found.distance, radius < 0.05 ? -0.008 : 0.008) << "the band of four voxels";
    EXPECT_EQ(found.normal_W, Vector3::Zero());
  }
}

/// A flat field has no normal and no nearest place.
TEST(SceneObject, HasNoNormalWhereTheFieldIsFlat) {
  ImageParts parts = test::whole_image();
  const std::size_t bricks = parts.count<format::Brick>(SectionId::kBricks);
  for (std::size_t i = 0; i < bricks; ++i) {
    auto& brick = parts.item<format::Brick>(SectionId::kBricks, i);
    std::fill(std::begin(brick.value), std::end(brick.value), std::int16_t{3});
  }
  parts.item<format::ExactBrick>(SectionId::kExactBricks) = {};
  const test::SceneImage image = parts.assemble();
  Scene scene;
  ASSERT_EQ(Scene::open(image.bytes(), scene), Status::kOk);
  const Vector3 p(0.021, 0.022, 0.023);
  EXPECT_TRUE(scene.distance(p).known);
  EXPECT_EQ(scene.distance(p).normal_W, Vector3::Zero());
}

TEST(SceneObject, TakesAPeriodWithinItsLimitsOnly) {
  const test::SceneImage image = test::whole_image().assemble();
  Scene scene;
  ASSERT_EQ(Scene::open(image.bytes(), scene), Status::kOk);
  for (const double fine : {1.25e-4, 1e-2, 3e-4}) {
    EXPECT_EQ(scene.set_period(fine), Status::kOk);
    EXPECT_EQ(scene.period(), fine);
  }
  for (const double bad : {std::nextafter(1.25e-4, 0.0), std::nextafter(1e-2, 1.0), 0.0, -1e-3,
                           std::numeric_limits<double>::infinity(), std::nan("")}) {
    EXPECT_EQ(scene.set_period(bad), Status::kOutOfRange) << bad;
    EXPECT_EQ(scene.period(), 3e-4);
  }
}

TEST(SceneObject, TakesGainsWithinTheirLimitsOnly) {
  const test::SceneImage image = test::whole_image().assemble();
  Scene scene;
  ASSERT_EQ(Scene::open(image.bytes(), scene), Status::kOk);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Gains lowest{1e-12, 0.0, 1e-18}, highest{1e9, 1e9, 1e9}, between{3.0, 5.0, 7.0};
  double Gains::*const members[] = {&Gains::stiffness, &Gains::damping, &Gains::rotational};
  for (const Gains& fine : {lowest, highest, between}) {
    EXPECT_EQ(scene.set_gains(fine), Status::kOk);
    for (const auto member : members) EXPECT_EQ(scene.gains().*member, fine.*member);
  }
  for (const auto member : members) {
    for (const double value :
         {std::nextafter(lowest.*member, -1.0), std::nextafter(1e9, 2e9), kInfinity, std::nan("")}) {
      Gains bad = between;
      bad.*member = value;
      EXPECT_EQ(scene.set_gains(bad), Status::kOutOfRange) << value;
      for (const auto same : members) EXPECT_EQ(scene.gains().*same, between.*same);
    }
  }
}

}  // namespace
}  // namespace godobject
