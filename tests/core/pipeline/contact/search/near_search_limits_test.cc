// The claims of a search about the future, the choice within a budget, and the number of look-ups.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "core/pipeline/contact/contact_cycle.h"
#include "core/pipeline/contact/search/near_search.h"
#include "core/pipeline/contact/search/point_budget.h"
#include "tests/support/analytic_worlds.h"
#include "tests/support/counted_field.h"
#include "tests/support/random.h"
#include "tests/support/small_scenes.h"

namespace godobject::test::near_search_limits_test {
namespace {

constexpr double kVoxel = 0.002;
constexpr double kLongestMotion = 0.003;
constexpr double kFieldRounding = 1e-5 * kVoxel;  // that the search allows for

using CountedField = Counted<AnalyticField>;

/// A ball of 20 mm radius with 500 points and their tree.
const Pointshell& ball_shell() {
  static const SceneImage image = ball_over_plate();
  static const Pointshell shell = open_scene(image).pointshell;
  return shell;
}
const BoundingSphere kBallSphere{Vector3::Zero(), 0.02 * (1.0 + 1e-6)};

/// A search of one shell, with its memory.
template <class Field, class Direction>
struct Searcher {
  const Field& field;
  const Pointshell& shell;
  Direction direction;
  std::vector<std::uint32_t> memory;
  NearSearch search;
  std::vector<std::uint32_t> near;
  std::vector<std::uint32_t> bounded;
  std::vector<double> left_out;
  WorkMeter work;
  double exact_share = 1.0;  ///< exact radius over the search radius

  Searcher(const Field& f, const Pointshell& s, const Direction& d, bool remembers) : field(f), shell(s), direction(d) {
    if (remembers) memory.resize(NearSearch::memory(s));
    search.start(memory, s, f.lipschitz(), kLongestMotion);
  }
  bool find(const Pose& H, double travelled, double radius, const PointBudget& budget = {}, bool goes_on = false) {
    if (!goes_on) {
      near.clear();
      bounded.clear();
    }
    left_out.clear();
    return search.find(
        direction, field, shell, H, travelled, radius, exact_share * radius, budget, work,
        [this](const SampleBatch&, const auto& index, std::uint64_t found) {
          for_each_bit(found, [&](std::uint32_t k) { near.push_back(index[k]); });
        },
        [this](const PointBatch&, const auto& index, std::uint64_t found) {
          for_each_bit(found, [&](std::uint32_t k) { bounded.push_back(index[k]); });
        },
        [this](double bound) { left_out.push_back(bound); }, goes_on);
  }
};

Pose height(double z) {
  Pose pose;
  pose.translation.z() = z;
  return pose;
}

// -- how far the body may go

/// One point at the height h over a plane is free until it has travelled h - L R, up to rounding.
TEST(NearSearch, KnowsHowFarAPointMayGo) {
  const SampledBody body({{Vector3::Zero()}, {-Vector3::UnitZ()}}, Vector3::Ones());
  const Pointshell shell = body.pointshell();
  for (const double slope : {1.0, 1.5}) {
    const CountedField field{AnalyticField(HalfSpace{}, kVoxel), slope};
    for (const bool remembers : {false, true}) {
      for (const double h : {0.0101, 0.0177, 0.05}) {
        for (const double travelled : {0.0, 0.25}) {
          Searcher<CountedField, detail::SampleDirection> at(field, shell, {}, remembers);
          at.find(height(h), travelled, kLongestMotion);
          ASSERT_TRUE(at.near.empty());
          for (const double clearance : {0.0, 0.001, kLongestMotion}) {
            const double limit = travelled + h - slope * clearance;
            EXPECT_FALSE(at.search.is_free(limit + 1e-9, clearance)) << h;
            EXPECT_TRUE(at.search.is_free(limit - 1e-9 - 2.0 * kFieldRounding - 1e-6 * h, clearance)) << h;
          }
        }
      }
    }
  }
}

/// A near point makes nothing certain.
TEST(NearSearch, ProvesNothingBesideANearPoint) {
  const Pointshell& shell = ball_shell();
  const CountedField field{AnalyticField(HalfSpace{}, kVoxel)};
  for (const bool remembers : {false, true}) {
    Searcher<CountedField, detail::SampleDirection> at(field, shell, {}, remembers);
    at.find(height(0.0205), 0.0, 0.001);
    ASSERT_FALSE(at.near.empty());
    EXPECT_FALSE(at.search.is_free(0.0, 0.001));
    EXPECT_FALSE(at.search.is_free(0.0, 0.0));
  }
}

/// Without a shell no point is ever near, whatever shell the search had before.
TEST(NearSearch, ForgetsTheShellThatItHadBefore) {
  const CountedField field{AnalyticField(HalfSpace{}, kVoxel)};
  for (const bool remembers : {false, true}) {
    Searcher<CountedField, detail::SampleDirection> at(field, ball_shell(), {}, remembers);
    at.find(height(0.0205), 0.0, 0.001);
    ASSERT_FALSE(at.search.is_free(0.0, 0.0));
    at.search.start_without_shell();
    EXPECT_TRUE(at.search.is_free(0.0, 0.0));
    EXPECT_TRUE(at.search.is_free(1e6, kLongestMotion));
  }
}

/// The points rest and the field turns about a far centre: a point at ten radii of the sphere is displaced by ten times
/// the odometer's difference.
TEST(NearSearch, CountsTheLeverOfAPointThatTheFieldPasses) {
  const SampledBody body({{Vector3::Zero()}, {-Vector3::UnitZ()}}, Vector3::Ones());
  const Pointshell shell = body.pointshell();
  const CountedField field{AnalyticField(HalfSpace{}, kVoxel)};
  detail::FeatureDirection direction;
  direction.sphere = {Vector3(0.01, 0.0, 0.0), 0.02};
  for (const bool remembers : {false, true}) {
    for (const double h : {0.01, 0.04}) {
      Searcher<CountedField, detail::FeatureDirection> at(field, shell, direction, remembers);
      Pose H = height(h);
      H.translation.x() = 0.21;
      at.find(H, 0.0, 1e-6);
      const double lever = std::hypot(0.2, h) + h;  // wherever the point is while it is free
      const double free = h / (lever / 0.02);
      EXPECT_FALSE(at.search.is_free(free + 1e-9, 0.0));
      EXPECT_TRUE(at.search.is_free(free - 1e-9 - 1e-6, 0.0));
    }
  }
}

/// A search without memory takes a node for free only if all its points are.
TEST(NearSearch, KnowsWithoutMemoryTheNearestOfAllPoints) {
  Random random(5);
  const Pointshell& shell = ball_shell();
  const CountedField field{AnalyticField(HalfSpace{}, kVoxel)};
  for (int trial = 0; trial < 100; ++trial) {
    Searcher<CountedField, detail::SampleDirection> at(field, shell, {}, false);
    Pose H = height(random.between(0.0235, 0.06));
    H.rotation = exp_rotation(random.in_cube(2.0));
    const double radius = random.between(0.0, kLongestMotion);
    at.find(H, 0.0, radius);
    ASSERT_TRUE(at.near.empty());
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < shell.size; ++i) least = std::min(least, (H * shell.point(i)).z());
    EXPECT_FALSE(at.search.is_free(least, 0.0)) << "the nearest point touches";
    EXPECT_TRUE(at.search.is_free(0.0, radius));
  }
}

/// A search without near points looks up early what is due soon. So a point that stays where it is, a millimetre beyond
/// a quarter of the longest motion, needs no search until the body has travelled that quarter.
TEST(NearSearch, LooksAQuarterOfTheLongestMotionAhead) {
  const SampledBody body({{Vector3::Zero()}, {-Vector3::UnitZ()}}, Vector3::Ones());
  const Pointshell shell = body.pointshell();
  const CountedField field{AnalyticField(HalfSpace{}, kVoxel)};
  constexpr double kRadius = 0.001;
  constexpr double kAhead = 0.25 * kLongestMotion;
  for (const bool remembers : {false, true}) {
    Searcher<CountedField, detail::SampleDirection> at(field, shell, {}, remembers);
    for (int i = 0; i < 200; ++i) {
      const double travelled = 1e-4 * i;  // along the plane
      at.find(height(kRadius + kAhead + 0.001), travelled, kRadius);
      ASSERT_TRUE(at.near.empty());
      ASSERT_TRUE(at.search.is_free(travelled + kAhead - 1e-6, kRadius)) << i;
    }
  }
}

/// Whatever a search claims to be free is so: before each search of a walk, its claim is compared with all points.
template <class Shape>
void expect_true_claims(const Shape& shape, bool remembers, unsigned seed) {
  Random random(seed);
  const Pointshell& shell = ball_shell();
  const AnalyticField field(shape, kVoxel);
  Searcher<AnalyticField, detail::SampleDirection> at(field, shell, {}, remembers);
  Odometer odometer;
  Pose H = height(0.024);
  int free = 0, near = 0;
  Vector3 velocity = Vector3::Zero(), spin = Vector3::Zero();
  for (int step = 0; step < 1500; ++step) {
    if (step % 20 == 0) {
      velocity = std::pow(10.0, random.between(-6.0, -2.5)) * random.direction();
      spin = 20.0 * velocity.norm() * random.direction();
      if (H.translation.norm() > 0.04) velocity = -velocity.norm() * H.translation.normalized();
    }
    H.translation += velocity;
    H.rotation = (H.rotation * exp_rotation(spin)).normalized();
    odometer.move_to(H, kBallSphere);
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < shell.size; ++i) least = std::min(least, shape.distance(H * shell.point(i)));
    for (const double clearance : {0.0, random.between(0.0, kLongestMotion), kLongestMotion}) {
      if (!at.search.is_free(odometer.travelled(), clearance)) continue;
      ++free;
      ASSERT_GE(std::max(0.0, least), clearance) << step;
    }
    near += least < kLongestMotion ? 1 : 0;
    if (random.integer(0, 2) != 0) at.find(H, odometer.travelled(), random.between(0.2, 1.0) * kLongestMotion);
  }
  EXPECT_GT(free, 100);
  EXPECT_GT(near, 100);
}

TEST(NearSearch, ClaimsNothingFreeThatIsNot) {
  for (const bool remembers : {false, true}) {
    for (const unsigned seed : {1u, 2u, 3u}) {
      expect_true_claims(HalfSpace{}, remembers, seed);
      expect_true_claims(Ball{{0.0, 0.0, -0.01}, 0.01}, remembers, seed);
    }
  }
}

/// A search that the budget of work ends goes on while the body stays, and then visits all near points.
void expect_it_goes_on(double travelled_before) {
  const Pointshell& shell = ball_shell();
  const CountedField field{AnalyticField(HalfSpace{}, kVoxel)};
  Searcher<CountedField, detail::SampleDirection> at(field, shell, {}, true);
  Random random(31);
  Odometer odometer;
  Pose H = height(0.03);
  int stops = 0;
  for (int step = 0; step < 200; ++step) {
    H.translation.z() = random.between(0.015, 0.035);
    H.rotation = (H.rotation * exp_rotation(random.in_cube(0.3))).normalized();
    odometer.move_to(H, kBallSphere);
    double radius = random.between(0.2, 1.0) * kLongestMotion;
    // enough for one look-up of each near point, which every call makes again
    const std::uint64_t least = 2 * shell.size * (cost_of(godobject::Work::kPoint) + cost_of(godobject::Work::kScan));
    for (int call = 0;; ++call) {
      ASSERT_LT(call, 1000);
      odometer.move_to(H, kBallSphere);
      at.work.start(call == 0 ? static_cast<std::uint64_t>(random.between(1.0, 2e4)) : least);
      if (at.find(H, travelled_before + odometer.travelled(), radius)) break;
      EXPECT_TRUE(at.work.is_spent());
      EXPECT_FALSE(at.search.is_free(travelled_before + odometer.travelled(), 0.0)) << "nothing is known yet";
      ++stops;
      if (random.integer(0, 3) == 0) H.translation.z() = random.between(0.015, 0.035);  // it does not stay
      radius = random.between(0.2, 1.0) * kLongestMotion;
    }
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = 0; i < shell.size; ++i) {
      if (field.sample(H * shell.point(i)).clearance < radius) expected.push_back(i);
    }
    ASSERT_EQ(at.near, expected) << step << ", " << travelled_before << " m travelled before";
  }
  EXPECT_GT(stops, 50);
}

TEST(NearSearch, GoesOnWhereTheBudgetEndedIt) {
  expect_it_goes_on(0.0);
  for (const double before : {1.0, 1e3, 1e6}) expect_it_goes_on(before);
}

/// With an exact radius, a search that the budget ends visits each point once over its calls, too.
TEST(NearSearch, VisitsNoPointTwiceWhereItGoesOn) {
  const Pointshell& shell = ball_shell();
  const CountedField field{AnalyticField(HalfSpace{}, kVoxel)};
  Searcher<CountedField, detail::SampleDirection> at(field, shell, {}, true);
  Random random(37);
  Odometer odometer;
  Pose H = height(0.03);
  int stops = 0;
  int split = 0;
  for (int step = 0; step < 300; ++step) {
    H.translation.z() = random.between(0.015, 0.025);
    H.rotation = (H.rotation * exp_rotation(random.in_cube(0.3))).normalized();
    odometer.move_to(H, kBallSphere);
    const double radius = random.between(0.2, 1.0) * kLongestMotion;
    at.exact_share = random.between(0.1, 1.0);
    bool goes_on = false;
    for (int call = 0;; ++call) {
      ASSERT_LT(call, 1000);
      const auto units = static_cast<std::uint64_t>(random.between(1.0, 1e4));
      const std::size_t before = goes_on ? at.bounded.size() : 0;
      at.work.start(units);
      const bool ends = at.find(H, odometer.travelled(), radius, {}, goes_on);
      const std::size_t bounded = at.bounded.size() - before;
      EXPECT_GE(at.work.spent(), cost_of(godobject::Work::kBounded) * bounded);
      EXPECT_LE(cost_of(godobject::Work::kBounded) * bounded, units + cost_of(godobject::Work::kBounded) * 64);
      if (ends) break;
      goes_on = at.search.may_go_on();
      ++stops;
    }
    std::vector<std::uint32_t> visited = at.near;
    visited.insert(visited.end(), at.bounded.begin(), at.bounded.end());
    std::sort(visited.begin(), visited.end());
    ASSERT_EQ(std::adjacent_find(visited.begin(), visited.end()), visited.end()) << "visited twice, " << step;
    for (std::uint32_t i = 0; i < shell.size; ++i) {
      if (field.sample(H * shell.point(i)).clearance >= radius) continue;
      ASSERT_TRUE(std::binary_search(visited.begin(), visited.end(), i)) << step << ", point " << i;
    }
    split += at.near.empty() || at.bounded.empty() ? 0 : 1;
  }
  EXPECT_GT(stops, 100);
  EXPECT_GT(split, 50);
}

/// A point whose clearance exceeds the search radius by less than a rounding is not found again at the same pose:
/// calls with room for one look-up come to an end. So it is for a point that moves faster than the body.
template <class Direction>
void expect_an_end_at_the_edge(const Direction& direction, double lever, double most) {
  const SampledBody body({{Vector3::Zero()}, {-Vector3::UnitZ()}}, Vector3::Ones());
  const Pointshell shell = body.pointshell();
  const CountedField field{AnalyticField(HalfSpace{}, kVoxel)};
  const double radius = 0.5 * kLongestMotion;
  int far = 0;
  for (int k = 0; k < 1000; ++k) {
    Searcher<CountedField, Direction> at(field, shell, direction, true);
    Pose H = height(radius * (1.0 + most * k / 1000.0) + kFieldRounding);
    H.translation.x() = lever;
    for (int call = 0;; ++call) {
      ASSERT_LT(call, 10) << k;
      at.work.start(1);
      if (at.find(H, 0.0, radius, {}, call > 0)) break;
    }
    ASSERT_TRUE(at.near.empty());
    far += at.search.is_free(0.0, radius) ? 1 : 0;
  }
  EXPECT_GT(far, 200) << "some points return to the front";
  EXPECT_LT(far, 800) << "and some are too near for it";
}

TEST(NearSearch, IsNotHeldUpByAPointAtTheEdgeOfItsRadius) {
  expect_an_end_at_the_edge(detail::SampleDirection{}, 0.0, 4e-5);
  detail::FeatureDirection direction;
  direction.sphere = {Vector3::Zero(), 0.02};
  expect_an_end_at_the_edge(direction, 0.03, 2.0);
}

/// Many points whose clearance is above the search radius, but not by as much as they may move: the search comes to an
/// end with any budget.
TEST(NearSearch, IsNotHeldUpByPointsThatMoveFasterThanTheBody) {
  const SampledBody body = ball_body(0.02, 2000);
  const Pointshell shell = body.pointshell();
  const CountedField field{AnalyticField(Ball{Vector3::Zero(), 0.0185}, kVoxel)};
  detail::FeatureDirection direction;
  direction.sphere = {Vector3::Zero(), 0.0185};
  for (const std::uint64_t budget : {1u, 200u, 1000u, 5000u}) {
    Searcher<CountedField, detail::FeatureDirection> at(field, shell, direction, true);
    for (int call = 0;; ++call) {
      ASSERT_LT(call, 3000) << budget;
      at.work.start(budget);
      if (at.find(Pose{}, 0.0, 0.0014, {}, call > 0)) break;
    }
  }
}

/// A search that goes on at the same pose visits each near point once, in all calls together.
TEST(NearSearch, VisitsTheRestOfThePointsWhenItGoesOn) {
  const Pointshell& shell = ball_shell();
  const CountedField field{AnalyticField(Ball{Vector3::Zero(), 0.0185}, kVoxel)};  // within the points
  Searcher<CountedField, detail::SampleDirection> at(field, shell, {}, true);
  Random random(33);
  Odometer odometer;
  Pose H;
  int within_points = 0;
  for (int step = 0; step < 300; ++step) {
    H.translation = random.in_cube(5e-4);
    H.rotation = (H.rotation * exp_rotation(random.in_cube(0.3))).normalized();
    odometer.move_to(H, kBallSphere);
    const double radius = random.between(0.2, 1.0) * kLongestMotion;
    bool has_all = false;
    for (int call = 0; !has_all; ++call) {
      ASSERT_LT(call, 1000);
      // every third step with room for one look-up, which must do
      at.work.start(step % 3 == 0 ? 1 : static_cast<std::uint64_t>(random.between(1000.0, 2e4)));
      const std::size_t before = at.near.size();
      has_all = at.find(H, odometer.travelled(), radius, {}, call > 0);
      EXPECT_TRUE(has_all || at.search.may_go_on());
      within_points += !has_all && call > 0 && at.near.size() > before ? 1 : 0;
      if (call == 0 && !has_all && random.integer(0, 9) == 0) {  // another pose: the next call begins again
        at.search.start_over();
        H.translation.z() += 1e-4;
        odometer.move_to(H, kBallSphere);
        call = -1;
      }
    }
    std::vector<std::uint32_t> expected;
    for (std::uint32_t i = 0; i < shell.size; ++i) {
      if (field.sample(H * shell.point(i)).clearance < radius) expected.push_back(i);
    }
    ASSERT_EQ(at.near, expected) << step;
  }
  EXPECT_GT(within_points, 100);
}

/// With a choice among the points, or without memory, a search begins again.
TEST(NearSearch, GoesOnOnlyInOrderAndWithMemory) {
  const Pointshell& shell = ball_shell();
  const CountedField field{AnalyticField(HalfSpace{}, kVoxel)};
  for (const bool remembers : {false, true}) {
    Searcher<CountedField, detail::SampleDirection> at(field, shell, {}, remembers);
    at.work.start(100);
    EXPECT_FALSE(at.find(height(0.0201), 0.0, 0.5 * kLongestMotion));
    EXPECT_EQ(at.search.may_go_on(), remembers);
  }
  const CountedField within{AnalyticField(Ball{Vector3::Zero(), 0.0185}, kVoxel)};
  Searcher<CountedField, detail::SampleDirection> few(within, shell, {}, true);
  ASSERT_TRUE(few.find(Pose{}, 0.0, kLongestMotion));
  int stops = 0;
  for (std::uint64_t budget = 1;; budget += 100) {
    few.work.start(budget);
    if (few.find(Pose{}, 0.0, kLongestMotion, {100, 0.0})) break;
    stops += few.search.may_go_on() ? 0 : 1;
  }
  EXPECT_GT(stops, 0) << "in the middle of the choice";
}

// -- how many look-ups

/// The look-ups of a search over a walk.
struct Work {
  int bounds = 0;
  int exact = 0;
};

template <class Motion>
Work work_of(int steps, const Motion& pose_at) {
  const Pointshell& shell = ball_shell();
  const CountedField field{AnalyticField(HalfSpace{}, kVoxel)};
  Searcher<CountedField, detail::SampleDirection> at(field, shell, {}, true);
  Odometer odometer;
  for (int step = 0; step < steps; ++step) {
    const Pose H = pose_at(step);
    odometer.move_to(H, kBallSphere);
    at.find(H, odometer.travelled(), 0.001);
  }
  return {field.bounds, field.exact};
}

/// The look-ups may not exceed those measured by more than two percent. A search from the root each cycle would take
/// 500 exact look-ups a cycle.
void expect_work(const char* name, const Work& work, int bounds, int exact) {
  std::printf("[ measured ] %s: %d bounds, %d exact\n", name, work.bounds, work.exact);
  EXPECT_LE(work.bounds, bounds * 1.02) << name;
  EXPECT_LE(work.exact, exact * 1.02) << name;
}

TEST(NearSearch, LooksUpFewItemsInSlowMotion) {
  expect_work("approach", work_of(1000, [](int i) { return height(0.07 - 5e-5 * i); }), 231, 120);
  expect_work("retreat", work_of(1000, [](int i) { return height(0.02 + 5e-5 * i); }), 715, 146);
  expect_work("sliding",
              work_of(1000,
                      [](int i) {
                        Pose H = height(0.0201);
                        H.translation.x() = 1e-4 * i;
                        return H;
                      }),
              7186, 11000);
  expect_work("rolling",
              work_of(1000,
                      [](int i) {
                        Pose H = height(0.0201);
                        H.translation.x() = 4e-5 * i;
                        H.rotation = exp_rotation({0.0, 2e-3 * i, 0.0});
                        return H;
                      }),
              5910, 11423);
  expect_work("swinging", work_of(1000, [](int i) { return height(0.03 + 0.01 * std::cos(0.05 * i)); }), 4496, 1289);
  expect_work("in free space",
              work_of(1000,
                      [](int i) {
                        Pose H = height(0.5 + 0.01 * std::cos(0.05 * i));
                        H.rotation = exp_rotation({0.0, 2e-3 * i, 0.0});
                        return H;
                      }),
              1, 0);
  expect_work("at rest", work_of(1000, [](int) { return height(0.0201); }), 1159, 11000);
}

/// Bounds of points that may be near serve the choice within a budget: they are looked up only if there is a choice.
TEST(NearSearch, ComparesBoundsOnlyBeyondItsBudget) {
  const CountedField field{AnalyticField(HalfSpace{}, kVoxel)};
  Searcher<CountedField, detail::SampleDirection> at(field, ball_shell(), {}, true);
  const auto work_at_rest = [&](std::uint32_t points) {
    field.bounds = field.exact = 0;
    at.find(height(0.0201), 0.0, 0.001, {points, 0.0});
    return Work{field.bounds, field.exact};
  };
  for (int i = 0; i < 3; ++i) work_at_rest(1000);
  const Work ample = work_at_rest(1000);
  const std::vector<std::uint32_t> near = at.near;
  ASSERT_GT(ample.exact, 5);
  const auto points = static_cast<std::uint32_t>(ample.exact);  // one for each point that may be near
  const Work enough = work_at_rest(points);
  EXPECT_EQ(enough.bounds, ample.bounds);
  EXPECT_EQ(enough.exact, ample.exact);
  EXPECT_EQ(at.near, near);
  EXPECT_TRUE(at.left_out.empty());
  const Work scarce = work_at_rest(points - 1);
  EXPECT_EQ(scarce.bounds, ample.bounds + ample.exact);
  EXPECT_LT(scarce.exact, ample.exact);
}

// -- the choice within a budget

/// Compares a choice with the definition: first all bounds up to `always`, then the smallest, as many as there are.
TEST(NearestFirst, TakesTheSmallestBoundsAndNoMoreThanTheBudget) {
  Random random(7);
  constexpr float kLongestBound = 0.002f;
  constexpr float kClass = kLongestBound / 256.0f;
  int partly = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const PointBudget budget{static_cast<std::uint32_t>(random.integer(0, 60)), random.integer(0, 2) == 0 ? 0.0 : 2e-4};
    std::vector<float> bounds(static_cast<std::size_t>(random.integer(0, 200)));
    const bool equal = random.integer(0, 3) == 0;
    for (float& bound : bounds) {
      bound = static_cast<float>(equal ? 1e-3 * random.integer(0, 2) : random.between(-1e-4, kLongestBound));
    }
    detail::NearestFirst nearest(budget, kLongestBound);
    for (const float bound : bounds) nearest.count(bound);
    nearest.spread();
    std::vector<bool> taken;
    for (const float bound : bounds) taken.push_back(nearest.takes(bound));
    std::uint32_t always = 0, others = 0, chosen = 0;
    float largest_taken = -1.0f, smallest_left = 1.0f;
    for (std::size_t i = 0; i < bounds.size(); ++i) {
      if (bounds[i] <= static_cast<float>(budget.always)) {
        ++always;
        EXPECT_TRUE(taken[i]);
        continue;
      }
      ++others;
      if (taken[i]) ++chosen;
      if (taken[i]) largest_taken = std::max(largest_taken, bounds[i]);
      if (!taken[i]) smallest_left = std::min(smallest_left, bounds[i]);
    }
    const std::uint32_t room = budget.points > always ? budget.points - always : 0;
    ASSERT_LE(chosen, room) << trial;
    // at least half of the room is used: every stride-th of the last class
    ASSERT_GE(2 * chosen, std::min(others, room)) << trial;
    if (others <= room) {
      ASSERT_EQ(chosen, others) << trial;
    }
    ASSERT_LE(largest_taken, smallest_left + 1.001f * kClass) << "nearest first, up to a class";
    partly += chosen > 0 && chosen < others ? 1 : 0;
  }
  EXPECT_GT(partly, 300);
}

/// Of equal bounds some are taken that are spread over the shell.
TEST(NearestFirst, SpreadsItsChoiceOfEqualBounds) {
  for (const std::uint32_t points : {1u, 3u, 10u, 33u, 99u}) {
    detail::NearestFirst nearest({points, 0.0}, 0.002f);
    for (int i = 0; i < 100; ++i) nearest.count(0.001f);
    nearest.spread();
    std::vector<int> taken;
    for (int i = 0; i < 100; ++i) {
      if (nearest.takes(0.001f)) taken.push_back(i);
    }
    const auto stride = static_cast<int>((100 + points - 1) / points);
    ASSERT_EQ(taken.size(), static_cast<std::size_t>((100 + stride - 1) / stride));
    for (std::size_t k = 0; k < taken.size(); ++k) EXPECT_EQ(taken[k], static_cast<int>(k) * stride);
  }
}

TEST(NearestFirst, TakesTheFarthestClassToo) {
  detail::NearestFirst nearest({2, 0.0}, 0.002f);
  for (int i = 0; i < 2; ++i) nearest.count(0.002f);
  nearest.spread();
  EXPECT_TRUE(nearest.takes(0.002f));
  EXPECT_TRUE(nearest.takes(0.002f));
  detail::NearestFirst none({0, 0.0}, 0.002f);
  none.count(0.002f);
  none.spread();
  EXPECT_FALSE(none.takes(0.002f));
}

/// The search reports a bound for every point that may be near and was not looked up, and no other.
TEST(NearSearch, LeavesOutNoPointWithoutItsBound) {
  const Pointshell& shell = ball_shell();
  const CountedField field{AnalyticField(HalfSpace{}, kVoxel)};
  for (const std::uint32_t points : {0u, 1u, 5u, 40u, 1000u}) {
    for (const double always : {0.0, 1e-4, 5e-4}) {
      Searcher<CountedField, detail::SampleDirection> at(field, shell, {}, true);
      Odometer odometer;
      for (int step = 0; step < 50; ++step) {
        Pose H = height(0.0203 - 1e-5 * (step % 20));
        H.rotation = exp_rotation({0.01 * step, 0.0, 0.003 * step});
        odometer.move_to(H, kBallSphere);
        constexpr double kRadius = 0.002;
        field.exact = 0;
        at.find(H, odometer.travelled(), kRadius, {points, always});
        std::vector<double> expected;
        std::uint32_t touching = 0;
        for (std::uint32_t i = 0; i < shell.size; ++i) {
          const double clearance = std::max(0.0, (H * shell.point(i)).z());
          touching += clearance <= always * (1.0 + 1e-5) ? 1 : 0;
          if (clearance < kRadius && !std::binary_search(at.near.begin(), at.near.end(), i))
            expected.push_back(clearance);
        }
        // bounds are single precision and rounded down; a point at the limit of the radius may be in one list only
        std::sort(expected.begin(), expected.end());
        std::sort(at.left_out.begin(), at.left_out.end());
        ASSERT_LE(std::max(expected.size(), at.left_out.size()) - std::min(expected.size(), at.left_out.size()), 1u);
        for (std::size_t k = 0; k < std::min(expected.size(), at.left_out.size()); ++k) {
          ASSERT_NEAR(at.left_out[k], expected[k], 2e-6 * expected[k]) << step;
          ASSERT_LE(at.left_out[k], expected[k]) << "a lower bound";
          ASSERT_GT(at.left_out[k], always);
        }
        ASSERT_LE(at.near.size(), std::max(points, touching));
        ASSERT_LE(field.exact, static_cast<int>(std::max(points, touching)));
      }
    }
  }
}

// -- the odometer

TEST(Odometer, AddsTheFarthestDisplacementsOfTheSphere) {
  const BoundingSphere sphere{Vector3(0.03, -0.05, 0.02), 0.1};
  Odometer odometer;
  Random random(8);
  Pose last;
  double sum = 0.0;
  for (int i = 0; i < 100; ++i) {
    Pose H;
    H.translation = random.in_cube(1.0);
    H.rotation = exp_rotation(random.in_cube(1.0));
    odometer.move_to(H, sphere);
    if (i > 0) sum += farthest_way(sphere, last, H);
    ASSERT_NEAR(odometer.travelled(), sum, 1e-12 * sum);
    last = H;
  }
  odometer.move_to(last, sphere);
  EXPECT_NEAR(odometer.travelled(), sum, 1e-8 * sum);
  odometer.reset();
  EXPECT_EQ(odometer.travelled(), 0.0);
  odometer.move_to(Pose{}, sphere);
  EXPECT_EQ(odometer.travelled(), 0.0) << "the first pose is where it starts";
}

}  // namespace
}  // namespace godobject::test::near_search_limits_test
