// The search with its front, compared with brute force: it finds the same points, whatever it has stored.

#include "core/pipeline/contact/search/near_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
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
      direction, field, shell, H, way, cut, cut, {}, work,
      [&near](const SampleBatch&, const auto& index, std::uint64_t found) {
        for_each_bit(found, [&](std::uint32_t k) { near.push_back(index[k]); });
      },
      [](const PointBatch&, const auto&, std::uint64_t) { FAIL() << "all are to be looked up exactly"; },
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

/// Far away all points, bounded ones too, return to the front, which is known to be free.
template <class Direction>
void expect_all_free_far_away(NearSearch& search, const Direction& direction, const Voxelmap& field,
                              const Pointshell& shell, Odometer& odometer, const BoundingSphere& sphere) {
  Pose away;
  away.translation.x() = 10.0;
  odometer.move_to(away, sphere);
  WorkMeter work;
  search.find(
      direction, field, shell, Direction::pose(away, {0.01, 0.0, 0.0}), odometer.travelled(), field.assured_clearance(),
      0.5 * field.assured_clearance(), {}, work,
      [](const SampleBatch&, const auto&, std::uint64_t) { FAIL() << "near, though far away"; },
      [](const PointBatch&, const auto&, std::uint64_t) { FAIL() << "near, though far away"; }, [](double) {});
  EXPECT_TRUE(search.is_free(odometer.travelled(), field.assured_clearance()));
}

/// A search with an exact radius visits each near point once: those that are nearer exactly, outer ones with a ball
/// about them that meets no surface. Searches with and without an exact radius take turns.
template <class Direction>
void expect_near_points_or_bounds(const SceneView& scene, const Direction& direction, const BoundingSphere& sphere,
                                  unsigned seed, double extent) {
  const Voxelmap& field = scene.voxelmap;
  const Pointshell& shell = scene.pointshell;
  const double longest = field.assured_clearance();
  std::vector<std::uint32_t> memory(NearSearch::memory(shell));
  NearSearch search;
  search.start(memory, shell, field.lipschitz(), longest);
  Odometer odometer;
  Walk walk(seed, extent);
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::size_t exact_ones = 0;
  std::size_t bounded_ones = 0;
  for (int step = 0; step < 3000; ++step) {
    const Pose& H_WS = walk.next();
    odometer.move_to(H_WS, sphere);
    const Pose H = Direction::pose(H_WS, {0.01, 0.0, 0.0});
    const double radius = longest * walk.share();
    if (step % 5 == 0) {
      ASSERT_EQ(found(search, direction, field, shell, H, odometer.travelled(), radius),
                near_by_brute_force(field, shell, H, radius));
      continue;
    }
    const double exact_radius = radius * walk.share();
    std::vector<std::uint32_t> near;
    std::vector<std::uint32_t> bounded;
    WorkMeter work;
    search.find(
        direction, field, shell, H, odometer.travelled(), radius, exact_radius, {}, work,
        [&](const SampleBatch& batch, const auto& index, std::uint64_t chosen) {
          for_each_bit(chosen, [&](std::uint32_t k) {
            EXPECT_EQ(batch.clearance[k], field.sample(H * shell.point(index[k])).clearance);
            near.push_back(index[k]);
          });
        },
        [&](const PointBatch& batch, const auto& index, std::uint64_t chosen) {
          EXPECT_TRUE(near.empty()) << "bounded points come first";
          for_each_bit(chosen, [&](std::uint32_t k) {
            bounded.push_back(index[k]);
            const Vector3 p(static_cast<double>(batch.x[k]), static_cast<double>(batch.y[k]),
                            static_cast<double>(batch.z[k]));
            EXPECT_EQ(p, shell.point(index[k]));
            const auto bound = static_cast<double>(batch.clearance[k]);
            EXPECT_GE(bound, (1.0 - 1e-6) * exact_radius);
            EXPECT_LE(bound, (1.0 + 1e-6) * radius);
            const Vector3 aside = Vector3(normal(random), normal(random), normal(random)).normalized();
            EXPECT_GT(field.sample(H * p + 0.9999 * bound * aside).distance, 0.0) << "a surface in the ball";
          });
        },
        [](double) { FAIL() << "the search omitted a point without a budget"; });
    ASSERT_TRUE(std::is_sorted(near.begin(), near.end()) && std::is_sorted(bounded.begin(), bounded.end())) << step;
    std::vector<std::uint32_t> visited;
    std::merge(near.begin(), near.end(), bounded.begin(), bounded.end(), std::back_inserter(visited));
    ASSERT_EQ(std::adjacent_find(visited.begin(), visited.end()), visited.end()) << "visited twice, " << step;
    for (const std::uint32_t i : near_by_brute_force(field, shell, H, radius)) {
      if (std::binary_search(visited.begin(), visited.end(), i)) continue;
      PointBatch alone;  // on the face of a brick the bound may exceed the clearance
      alone.x[0] = shell.x[i];
      alone.y[0] = shell.y[i];
      alone.z[0] = shell.z[i];
      alone.count = 1;
      field.clearances(H, alone);
      ASSERT_GE(static_cast<double>(alone.clearance[0]), (1.0 - 1e-6) * radius) << step << ", point " << i;
    }
    for (const std::uint32_t i : near_by_brute_force(field, shell, H, exact_radius / field.lipschitz())) {
      ASSERT_TRUE(std::binary_search(near.begin(), near.end(), i)) << step << ", point " << i;
    }
    for (const std::uint32_t i : near) {
      ASSERT_LT(field.sample(H * shell.point(i)).clearance, radius) << step << ", point " << i;
    }
    exact_ones += near.size();
    bounded_ones += bounded.size();
  }
  EXPECT_GT(exact_ones, 500u);
  EXPECT_GT(bounded_ones, 500u);
  expect_all_free_far_away(search, direction, field, shell, odometer, sphere);
}

TEST(NearSearch, BoundsThePointsBeyondTheExactRadius) {
  const SceneImage plate = ball_over_plate();
  const SceneImage hole = ball_over_hole();
  for (const SceneImage* image : {&plate, &hole}) {
    const SceneView scene = open_scene(*image);
    const MassModel mass = Parameters::make(scene).mass;
    for (const unsigned seed : {1u, 2u, 3u}) {
      expect_near_points_or_bounds(scene, detail::SampleDirection{}, mass.sphere, seed, mass.radius);
    }
  }
  const SceneView scene = open_scene(plate);
  Parameters q;
  q.voxel_size = scene.voxelmap.voxel_size();
  q.mass.sphere = {Vector3(0.004, -0.003, 0.002), 0.02};
  const ContactLengths lengths = ContactLengths::make(q);
  const detail::FeatureDirection direction(lengths, scene.voxelmap.surface_radius(lengths.sphere.center));
  expect_near_points_or_bounds(scene, direction, lengths.sphere, 4, 0.05);
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
          detail::SampleDirection{}, scene.voxelmap, scene.pointshell, H, odometer.travelled(), cut, walk.share() * cut,
          PointBudget{3, 1e-4}, work, [](const SampleBatch&, const auto&, std::uint64_t) {},
          [](const PointBatch&, const auto&, std::uint64_t) {}, [&](double) { ++short_of_it; });
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
    std::vector<std::uint32_t> bounded;
    std::vector<std::uint32_t> near;
    double least_left_out = std::numeric_limits<double>::infinity();
    search.find(
        detail::SampleDirection{}, field, shell, H, odometer.travelled(), cut, uniform(random) * cut, budget, work,
        [&](const SampleBatch&, const auto& index, std::uint64_t found) {
          for_each_bit(found, [&](std::uint32_t k) { near.push_back(index[k]); });
        },
        [&](const PointBatch&, const auto& index, std::uint64_t found) {
          for_each_bit(found, [&](std::uint32_t k) { bounded.push_back(index[k]); });
        },
        [&](double bound) {
          ++short_of_it;
          EXPECT_GT(bound, budget.always);
          least_left_out = std::min(least_left_out, bound);
        });
    ASSERT_TRUE(std::is_sorted(near.begin(), near.end()));
    EXPECT_TRUE(bounded.empty() || least_left_out == std::numeric_limits<double>::infinity()) << "one choice at a time";
    near.insert(near.end(), bounded.begin(), bounded.end());
    std::sort(near.begin(), near.end());
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
