// The search with its front, compared with brute force: it finds the same points, whatever it has stored.

#include "core/pipeline/contact/search/near_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "core/pipeline/contact/contact_cycle.h"
#include "tests/support/analytic_worlds.h"
#include "tests/support/counted_field.h"
#include "tests/support/small_scenes.h"

namespace godobject::test::near_search_test {
namespace {

template <class Direction, class Field>
std::vector<std::uint32_t> found(NearSearch& search, const Direction& direction, const Field& field,
                                 const Pointshell& shell, const Pose& H, double way, double cut) {
  std::vector<std::uint32_t> near;
  WorkMeter work;
  search.find(
      direction, field, shell, H, way, cut, {}, work,
      [&near](const SampleBatch&, const auto& index, std::uint64_t found) {
        for_each_bit(found, [&](std::uint32_t k) { near.push_back(index[k]); });
      },
      [](double) { FAIL() << "the search omitted a point without a budget"; });
  return near;
}

template <class Field>
std::vector<std::uint32_t> near_by_brute_force(const Field& field, const Pointshell& shell, const Pose& H, double cut) {
  std::vector<std::uint32_t> near;
  const Matrix3 R = H.rotation.toRotationMatrix();
  for (std::uint32_t i = 0; i < shell.size; ++i) {
    if (field.sample(R * shell.point(i) + H.translation).clearance < cut) near.push_back(i);
  }
  return near;
}

/// Random poses about the origin: speeds from a micrometre to a centimetre a step, any rotation, and jumps.
class Walk {
 public:
  Walk(unsigned seed, double extent) : random_(seed), extent_(extent) {}

  const Pose& next() {
    if (step_++ % 40 == 0) {
      velocity_ = std::pow(10.0, -6.0 + 4.0 * uniform_(random_)) * vector().normalized();
      spin_ = velocity_.norm() / extent_ * 2.0 * uniform_(random_) * vector().normalized();
      if (uniform_(random_) < 0.1) {
        H_.translation = extent_ * vector();
        H_.rotation = exp_rotation(3.0 * vector());
      }
      if (H_.translation.norm() > 3.0 * extent_) velocity_ = -velocity_.norm() * H_.translation.normalized();
    }
    H_.translation += velocity_;
    H_.rotation = (H_.rotation * exp_rotation(spin_)).normalized();
    return H_;
  }
  double share() { return uniform_(random_); }

 private:
  Vector3 vector() { return {normal_(random_), normal_(random_), normal_(random_)}; }

  std::mt19937 random_;
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> uniform_;
  double extent_;
  Pose H_;
  Vector3 velocity_ = Vector3::Zero(), spin_ = Vector3::Zero();
  int step_ = 0;
};

void expect_the_points_of_brute_force(const SceneView& scene, unsigned seed) {
  constexpr int kSteps = 3000;
  const MassModel mass = Parameters::make(scene).mass;
  const double longest = scene.voxelmap.assured_clearance();
  const detail::SampleDirection direction;
  std::vector<std::uint32_t> memory(NearSearch::memory(scene.pointshell));
  NearSearch remembers, forgets;
  remembers.start(memory, scene.pointshell, scene.voxelmap.lipschitz(), longest);
  forgets.start({}, scene.pointshell, scene.voxelmap.lipschitz(), longest);
  Odometer odometer;
  Walk walk(seed, mass.radius);
  std::size_t near = 0;
  for (int step = 0; step < kSteps; ++step) {
    const Pose& H = walk.next();
    odometer.move_to(H, mass.sphere);
    const double cut = longest * (step % 7 == 0 ? 1.0 : walk.share());
    const auto expected = near_by_brute_force(scene.voxelmap, scene.pointshell, H, cut);
    ASSERT_EQ(found(remembers, direction, scene.voxelmap, scene.pointshell, H, odometer.travelled(), cut), expected)
        << step;
    ASSERT_EQ(found(forgets, direction, scene.voxelmap, scene.pointshell, H, odometer.travelled(), cut), expected)
        << step;
    near += expected.size();
  }
  EXPECT_GT(near, static_cast<std::size_t>(kSteps)) << "the walk meets too few near points";
}

TEST(NearSearch, FindsThePointsOfBruteForceOverAPlate) {
  const SceneImage image = ball_over_plate();
  for (const unsigned seed : {1u, 2u, 3u}) expect_the_points_of_brute_force(open_scene(image), seed);
}

TEST(NearSearch, FindsThePointsOfBruteForceInAHole) {
  const SceneImage image = ball_over_hole();
  for (const unsigned seed : {1u, 2u, 3u}) expect_the_points_of_brute_force(open_scene(image), seed);
}

/// The points stand still; the field moves and turns. Points far from its origin move farther than the odometer says.
TEST(NearSearch, FindsThePointsOfBruteForceInTheOtherDirection) {
  const SceneImage image = ball_over_plate();
  const SceneView scene = open_scene(image);
  Parameters q;
  q.voxel_size = scene.voxelmap.voxel_size();
  q.mass.sphere = {Vector3(0.004, -0.003, 0.002), 0.02};  // a body much smaller than the region of the points
  const ContactLengths lengths = ContactLengths::make(q);
  const detail::FeatureDirection direction(lengths, scene.voxelmap.surface_radius(lengths.sphere.center));
  const double longest = scene.voxelmap.assured_clearance();
  std::vector<std::uint32_t> memory(NearSearch::memory(scene.pointshell));
  NearSearch search;
  search.start(memory, scene.pointshell, scene.voxelmap.lipschitz(), longest);
  Odometer odometer;
  Walk walk(5, 0.1);
  std::size_t near = 0;
  for (int step = 0; step < 6000; ++step) {
    const Pose& H_WS = walk.next();
    odometer.move_to(H_WS, lengths.sphere);
    const Pose H = detail::FeatureDirection::pose(H_WS, {0.05, 0.0, 0.0});
    const double cut = longest * walk.share();
    const auto expected = near_by_brute_force(scene.voxelmap, scene.pointshell, H, cut);
    ASSERT_EQ(found(search, direction, scene.voxelmap, scene.pointshell, H, odometer.travelled(), cut), expected)
        << step;
    near += expected.size();
  }
  EXPECT_GT(near, 1000u) << "the walk meets too few near points";
}

/// Points that a budget made the search omit are found once there is no budget.
TEST(NearSearch, FindsThePointsOfBruteForceAfterABudgetToo) {
  const SceneImage image = ball_over_plate();
  const SceneView scene = open_scene(image);
  const MassModel mass = Parameters::make(scene).mass;
  const double longest = scene.voxelmap.assured_clearance();
  std::vector<std::uint32_t> memory(NearSearch::memory(scene.pointshell));
  NearSearch search;
  search.start(memory, scene.pointshell, scene.voxelmap.lipschitz(), longest);
  Odometer odometer;
  Walk walk(11, mass.radius);
  std::size_t near = 0;
  int short_of_it = 0;
  WorkMeter work;
  for (int step = 0; step < 6000; ++step) {
    const Pose& H = walk.next();
    odometer.move_to(H, mass.sphere);
    const double cut = longest * walk.share();
    if (walk.share() < 0.5) {
      search.find(
          detail::SampleDirection{}, scene.voxelmap, scene.pointshell, H, odometer.travelled(), cut,
          PointBudget{3, 1e-4}, work, [](const SampleBatch&, const auto&, std::uint64_t) {},
          [&](double) { ++short_of_it; });
      continue;
    }
    const auto expected = near_by_brute_force(scene.voxelmap, scene.pointshell, H, cut);
    ASSERT_EQ(found(search, detail::SampleDirection{}, scene.voxelmap, scene.pointshell, H, odometer.travelled(), cut),
              expected)
        << step;
    near += expected.size();
  }
  EXPECT_GT(near, 3000u) << "the walk meets too few near points";
  EXPECT_GT(short_of_it, 1000) << "the budget was rarely exceeded";
}

/// Points that the search omits are at least as far away as the bound that it reports. It finds all nearer points. Only
/// touching points may exceed the budget.
TEST(NearSearch, KeepsItsBudgetNearestFirst) {
  const SceneImage image = ball_over_plate();
  const SceneView scene = open_scene(image);
  const Counted<Voxelmap> field{scene.voxelmap};
  const Pointshell& shell = scene.pointshell;
  const double longest = field.assured_clearance();
  std::vector<std::uint32_t> memory(NearSearch::memory(shell));
  NearSearch search;
  search.start(memory, shell, field.lipschitz(), longest);
  Odometer odometer;
  const PointBudget budget{7, 2e-4};
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform;
  int short_of_it = 0;
  WorkMeter work;
  Pose H;
  H.translation.z() = 0.01 + 0.02 + 0.002;
  for (int step = 0; step < 3000; ++step) {
    H.translation += 2e-4 * Vector3(uniform(random) - 0.5, uniform(random) - 0.5, uniform(random) - 0.5);
    H.translation.z() = std::clamp(H.translation.z(), 0.01 + 0.02 - 0.001, 0.01 + 0.02 + 0.004);
    H.rotation = (H.rotation * exp_rotation(0.02 * Vector3(uniform(random), 0.0, -uniform(random)))).normalized();
    odometer.move_to(H, {Vector3::Zero(), scene.body.radius});
    const double cut = longest * (0.3 + 0.7 * uniform(random));
    const Matrix3 R = H.rotation.toRotationMatrix();
    const auto clearance = [&](std::uint32_t i) {
      return scene.voxelmap.sample(R * shell.point(i) + H.translation).clearance;
    };
    std::vector<std::uint32_t> near;
    double least_left_out = std::numeric_limits<double>::infinity();
    search.find(
        detail::SampleDirection{}, field, shell, H, odometer.travelled(), cut, budget, work,
        [&](const SampleBatch&, const auto& index, std::uint64_t found) {
          for_each_bit(found, [&](std::uint32_t k) { near.push_back(index[k]); });
        },
        [&](double bound) {
          ++short_of_it;
          EXPECT_GT(bound, budget.always);
          least_left_out = std::min(least_left_out, bound);
        });
    ASSERT_TRUE(std::is_sorted(near.begin(), near.end()));
    const auto touches = [&](std::uint32_t i) { return clearance(i) <= 4.0 * budget.always; };
    ASSERT_LE(near.size(), budget.points + static_cast<std::size_t>(std::count_if(near.begin(), near.end(), touches)));
    for (const std::uint32_t i : near_by_brute_force(scene.voxelmap, shell, H, cut)) {
      if (std::binary_search(near.begin(), near.end(), i)) continue;
      ASSERT_GE(clearance(i), least_left_out) << "point " << i << " in step " << step;
    }
  }
  EXPECT_GT(short_of_it, 1000) << "the budget was rarely exceeded";
}

TEST(NearSearch, LooksAtNothingWhileNothingMoves) {
  const SceneImage image = ball_over_plate();
  const SceneView scene = open_scene(image);
  const Counted<Voxelmap> field{scene.voxelmap};
  std::vector<std::uint32_t> memory(NearSearch::memory(scene.pointshell));
  NearSearch search;
  const double longest = field.assured_clearance();
  search.start(memory, scene.pointshell, scene.voxelmap.lipschitz(), longest);
  Pose H;
  H.translation.z() = 0.01 + 0.02 + 1.5 * field.lipschitz() * longest;  // just beyond the search radius
  const detail::SampleDirection direction;
  EXPECT_TRUE(found(search, direction, field, scene.pointshell, H, 0.0, longest).empty());
  const int first = field.looks();
  EXPECT_GT(first, 0);
  for (int i = 0; i < 10; ++i) {
    EXPECT_TRUE(found(search, direction, field, scene.pointshell, H, 0.0, 0.25 * longest).empty());
  }
  EXPECT_EQ(field.looks(), first);
}

TEST(NearSearch, KnowsForHowLongNothingComesNear) {
  const AnalyticField field(HalfSpace{}, 0.002);
  const SampledBody body = ball_body();
  constexpr double kLongest = 0.003;
  std::vector<std::uint32_t> memory(NearSearch::memory(body.pointshell()));
  NearSearch search;
  search.start(memory, body.pointshell(), field.lipschitz(), kLongest);
  Pose H;
  H.translation.z() = 0.02 + 0.05;
  EXPECT_FALSE(search.is_free(0.0, kLongest)) << "no search has run yet";
  EXPECT_TRUE(found(search, detail::SampleDirection{}, field, body.pointshell(), H, 0.0, kLongest).empty());
  EXPECT_TRUE(search.is_free(0.046, kLongest));
  EXPECT_FALSE(search.is_free(0.048, kLongest)) << "the limit is 50 mm less kLongest";
}

TEST(Odometer, IsNeverBehindAnyPoint) {
  const BoundingSphere sphere{Vector3(0.03, -0.05, 0.02), 0.1};
  Odometer odometer;
  Walk walk(9, 0.1);
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::vector<Vector3> points(50);
  for (Vector3& p : points) {
    p = sphere.center + sphere.radius * Vector3(normal(random), normal(random), normal(random)).normalized();
  }
  Pose last = walk.next();
  odometer.move_to(last, sphere);
  EXPECT_EQ(odometer.travelled(), 0.0);
  for (int step = 0; step < 2000; ++step) {
    const double before = odometer.travelled();
    const Pose H = walk.next();
    odometer.move_to(H, sphere);
    double farthest = 0.0;
    for (const Vector3& p : points) farthest = std::max(farthest, (H * p - last * p).norm());
    ASSERT_GE(odometer.travelled() - before, farthest) << step;
    last = H;
  }
}

}  // namespace
}  // namespace godobject::test::near_search_test
