// The motion without friction against an independent solver of least-distance problems: random, degenerate, redundant
// and infeasible rows.

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "core/pipeline/contact/qp/dual_active_set.h"
#include "core/pipeline/contact/qp/least_constraint.h"
#include "tests/support/random.h"
#include "toolchain/watch/least_distance.h"

namespace godobject::test::least_constraint_oracle_test {
namespace {

using watch::HalfPlane;
using watch::least_distance;
using watch::LeastDistance;

struct NoTag {};
using Set = DualActiveSet<NoTag>;
using Wide = Eigen::Matrix<long double, 6, 1>;

/// Returns gradients of few integers: many are parallel, dependent, or meet in one point.
Vector6 integer_gradient(Random& random) {
  Vector6 c;
  do {
    for (int i = 0; i < 6; ++i) c[i] = random.integer(0, 2) == 0 ? random.integer(-1, 1) : 0.0;
  } while (c.isZero(0.0));
  return c;
}

/// Checks feasibility of the active half spaces, multipliers, complementarity and stationarity in 80 bits.
void expect_optimal(const Vector6& target, const Set& set, const std::vector<HalfPlane>& all, long double tolerance) {
  Wide sum = target.cast<long double>();
  for (int i = 0; i < set.size(); ++i) {
    EXPECT_GE(set[i].multiplier, 0.0);
    sum += static_cast<long double>(set[i].multiplier) * set[i].gradient.cast<long double>();
    const long double gap =
        set[i].gradient.cast<long double>().dot(set.z().cast<long double>()) - static_cast<long double>(set[i].rhs);
    EXPECT_LE(std::fabs(gap), tolerance) << "an active half space is met exactly";
  }
  EXPECT_LE((sum - set.z().cast<long double>()).norm(), tolerance) << "the multipliers give the point";
  for (const HalfPlane& row : all) {
    EXPECT_GE(row.normal.cast<long double>().dot(set.z().cast<long double>()),
              static_cast<long double>(row.bound) - tolerance);
  }
}

/// Every half space is added once, then again while one is violated. The set refuses one only if it contradicts the
/// others, and then stays as it was.
TEST(DualActiveSet, FindsWhatAnIndependentSolverFindsOnDegeneratePolyhedra) {
  Random random(61);
  int infeasible = 0, refused = 0;
  for (int problem = 0; problem < 3000; ++problem) {
    std::vector<HalfPlane> rows;
    const int count = random.integer(1, 14);
    for (int i = 0; i < count; ++i) {
      const double scale = problem % 5 == 0 ? std::pow(10.0, random.integer(-3, 3)) : 1.0;
      rows.push_back({scale * integer_gradient(random), scale * random.integer(-2, 1)});
    }
    Vector6 target;
    for (int i = 0; i < 6; ++i) target[i] = random.integer(-3, 3);
    std::vector<HalfPlane> moved = rows;  // about the target
    for (HalfPlane& row : moved) row.bound -= row.normal.dot(target);
    const LeastDistance slow = least_distance(moved);
    Set set;
    set.start(target);
    bool feasible = true;
    for (int additions = 0; feasible; ++additions) {
      ASSERT_LT(additions, 100) << problem;
      const HalfPlane* worst = nullptr;
      double most = 1e-9;
      for (const HalfPlane& row : rows) {
        const double violation = (row.bound - row.normal.dot(set.z())) / row.normal.norm();
        if (violation <= most) continue;
        most = violation;
        worst = &row;
      }
      if (worst == nullptr) break;
      const Set before = set;
      feasible = set.add({worst->normal, worst->bound, 0.0, {}});
      if (feasible) continue;
      ++refused;
      EXPECT_LT((set.z() - before.z()).norm(), 1e-12);
      int at = 0;  // a half space without load may leave by rounding
      for (int i = 0; i < before.size(); ++i) {
        if (at < set.size() && set[at].gradient == before[i].gradient && set[at].rhs == before[i].rhs) {
          EXPECT_NEAR(set[at++].multiplier, before[i].multiplier, 1e-10 * (1.0 + before[i].multiplier));
        } else {
          EXPECT_LT(before[i].multiplier, 1e-12);
        }
      }
      EXPECT_EQ(at, set.size());
    }
    ASSERT_EQ(feasible, slow.feasible) << problem;
    infeasible += feasible ? 0 : 1;
    expect_optimal(target, set, feasible ? rows : std::vector<HalfPlane>{}, 1e-10L);
    if (feasible) {
      EXPECT_LT((set.z() - target - slow.x).norm(), 1e-8) << problem;
    }
    if (HasFailure()) FAIL() << "problem " << problem;
  }
  EXPECT_GT(infeasible, 100);
  EXPECT_GT(refused, 100);
}

/// A guess may contain half spaces that depend on each other, that pull, or that are not violated.
TEST(DualActiveSet, ProjectsOnTheIndependentGuessesThatPush) {
  Random random(62);
  for (int problem = 0; problem < 3000; ++problem) {
    Vector6 target;
    for (int i = 0; i < 6; ++i) target[i] = random.integer(-3, 3);
    Set set;
    set.start(target);
    std::vector<HalfPlane> guessed;
    for (int i = random.integer(1, 6); i > 0; --i) {
      guessed.push_back({integer_gradient(random), static_cast<double>(random.integer(-2, 2))});
      ASSERT_TRUE(set.guess({guessed.back().normal, guessed.back().bound, 0.0, {}}));
    }
    if (random.integer(0, 1) == 0) {
      const auto out = static_cast<std::size_t>(random.integer(0, static_cast<int>(guessed.size()) - 1));
      set.erase(static_cast<int>(out));
      guessed.erase(guessed.begin() + static_cast<std::ptrdiff_t>(out));
    }
    ASSERT_EQ(set.size(), static_cast<int>(guessed.size()));
    for (int i = 0; i < set.size(); ++i) {
      ASSERT_EQ(set[i].gradient, guessed[static_cast<std::size_t>(i)].normal);
      ASSERT_EQ(set[i].rhs, guessed[static_cast<std::size_t>(i)].bound);
    }
    set.resolve();
    expect_optimal(target, set, {}, 1e-12L);
    // of a set of independent half spaces without a pull none leaves
    Set again = set;
    again.resolve();
    ASSERT_EQ(again.size(), set.size());
    for (int i = 0; i < set.size(); ++i) EXPECT_EQ(again[i].gradient, set[i].gradient);
    if (HasFailure()) FAIL() << "problem " << problem;
  }
}

// -- the whole problem

const CouplingMetric kMetric;

std::vector<HalfPlane> half_planes(const ContactRows& rows, const Motion& wanted, const CouplingMetric& metric) {
  Vector6 target;
  target << wanted.translation, metric.gyration * wanted.rotation;
  std::vector<HalfPlane> planes(rows.count);
  for (std::uint32_t i = 0; i < rows.count; ++i) {
    const Vector3 n = rows.normal(i);
    planes[i].normal << n, rows.point(i).cross(n) / metric.gyration;
    planes[i].bound = static_cast<double>(rows.required_gain[i]) - planes[i].normal.dot(target);
  }
  return planes;
}

TEST(LeastConstraint, FindsWhatAnIndependentSolverFindsOnDegenerateRows) {
  Random random(63);
  int infeasible = 0;
  for (int problem = 0; problem < 2000; ++problem) {
    auto rows = std::make_unique<ContactRows>();
    const int count = random.integer(1, 20);
    for (int i = 0; i < count; ++i) {
      // faces, edges and corners of a box: many normals and points are equal
      Vector3 normal(random.integer(-1, 1), random.integer(-1, 1), random.integer(-1, 1));
      if (normal.isZero(0.0)) normal = Vector3::UnitZ();
      const Vector3 point = 0.03 * Vector3(random.integer(-1, 1), random.integer(-1, 1), random.integer(-1, 1));
      rows->push(static_cast<std::uint32_t>(i), normal.normalized(), point,
                 problem % 2 == 0 ? -1e-3 * random.integer(0, 2) : 1e-4 * random.integer(-9, 1));
    }
    const Motion wanted = random.motion(0.01, 0.2);
    const LeastDistance slow = least_distance(half_planes(*rows, wanted, kMetric));
    ConstrainedStep step;
    WorkMeter work;
    least_constraint(*rows, wanted, kMetric, nullptr, Motion{}, work, step);
    ASSERT_EQ(step.infeasible, !slow.feasible) << problem;
    infeasible += step.infeasible ? 1 : 0;
    const LeastDistance expected = step.infeasible ? least_distance(half_planes(*rows, wanted, kMetric)) : slow;
    ASSERT_TRUE(expected.feasible) << "without required gaps rest is feasible";
    Vector6 x;
    x << step.motion.translation - wanted.translation, kMetric.gyration * (step.motion.rotation - wanted.rotation);
    // a required gain may be missed by the tolerance
    EXPECT_NEAR(x.norm(), expected.x.norm(), 1e-6) << problem;
    EXPECT_LT((x - expected.x).norm(), 2e-4) << problem;
    EXPECT_EQ(step.follows, step.force_count == 0);
    EXPECT_EQ(step.contact_count, step.force_count);
    if (HasFailure()) FAIL() << "problem " << problem;
  }
  EXPECT_GT(infeasible, 20);
}

}  // namespace
}  // namespace godobject::test::least_constraint_oracle_test
