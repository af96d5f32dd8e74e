// The projection on half spaces in six dimensions, checked by its optimality conditions.

#include "core/pipeline/contact/qp/dual_active_set.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

namespace godobject::test::dual_active_set_test {
namespace {

struct NoTag {};
using Set = DualActiveSet<NoTag>;

Set::Inequality half_space(const Vector6& gradient, double rhs) { return {gradient, rhs, 0.0, {}}; }

class NormalDraws {
 public:
  explicit NormalDraws(unsigned seed) : engine_(seed) {}
  double normal() { return normal_(engine_); }
  Vector6 vector() {
    return Vector6::NullaryExpr([this] { return normal(); });
  }

 private:
  std::mt19937 engine_;
  std::normal_distribution<double> normal_;
};

/// Adds the most violated half space until all are met. Returns false if they contradict each other.
bool meet_all(const std::vector<Set::Inequality>& half_spaces, Set& set, int& additions) {
  for (additions = 0; additions < 1000; ++additions) {
    double worst = 1e-12;
    const Set::Inequality* entering = nullptr;
    for (const Set::Inequality& h : half_spaces) {
      const double violation = h.rhs - h.gradient.dot(set.z());
      if (violation > worst) {
        worst = violation;
        entering = &h;
      }
    }
    if (entering == nullptr) return true;
    if (!set.add(*entering)) return false;
  }
  ADD_FAILURE() << "the active set did not end within 1000 additions";
  return false;
}

void expect_optimal(const Vector6& target, const Set& set, double tolerance) {
  ASSERT_LE(set.size(), 6);
  Vector6 sum = target;
  double size = 1.0;  // size of the terms that cancel where half spaces nearly contradict each other
  for (int i = 0; i < set.size(); ++i) {
    EXPECT_GE(set[i].multiplier, 0.0);
    sum += set[i].multiplier * set[i].gradient;
    size += set[i].multiplier * set[i].gradient.norm();
  }
  for (int i = 0; i < set.size(); ++i) {
    EXPECT_NEAR(set[i].gradient.dot(set.z()), set[i].rhs, tolerance * size);
  }
  EXPECT_LT((sum - set.z()).norm(), tolerance * size);
}

TEST(DualActiveSet, LandsOnTheFaceTheEdgeAndTheCornerOfACube) {
  for (int faces = 0; faces <= 6; ++faces) {
    Set set;
    set.start(Vector6::Constant(-2.0));
    Vector6 expected = Vector6::Constant(-2.0);
    for (int i = 0; i < faces; ++i) {
      ASSERT_TRUE(set.add(half_space(Vector6::Unit(i), 1.0)));
      expected[i] = 1.0;
    }
    EXPECT_EQ(set.size(), faces);
    EXPECT_LT((set.z() - expected).norm(), 1e-15);
    for (int i = 0; i < faces; ++i) EXPECT_DOUBLE_EQ(set[i].multiplier, 3.0);
  }
}

TEST(DualActiveSet, DropsAFaceThatASteeperOneMakesIdle) {
  Set set;
  set.start(Vector6::Zero());
  ASSERT_TRUE(set.add(half_space(Vector6::Unit(0), 1.0)));
  // x + y >= 10: the nearest point (5, 5) also satisfies x >= 1
  ASSERT_TRUE(set.add(half_space(Vector6::Unit(0) + Vector6::Unit(1), 10.0)));
  ASSERT_EQ(set.size(), 1);
  EXPECT_NEAR(set[0].multiplier, 5.0, 1e-14);
  EXPECT_NEAR(set.z()[0], 5.0, 1e-14);
  EXPECT_NEAR(set.z()[1], 5.0, 1e-14);
}

TEST(DualActiveSet, ReplacesAParallelFaceByTheOneFartherOut) {
  Set set;
  set.start(Vector6::Zero());
  ASSERT_TRUE(set.add(half_space(Vector6::Unit(2), 1.0)));
  ASSERT_TRUE(set.add(half_space(Vector6::Unit(2), 2.0)));
  ASSERT_EQ(set.size(), 1);
  EXPECT_NEAR(set.z()[2], 2.0, 1e-15);
  EXPECT_NEAR(set[0].rhs, 2.0, 0.0);
}

TEST(DualActiveSet, RefusesWhatContradictsAndStaysAsItWas) {
  Set set;
  set.start(Vector6::Zero());
  ASSERT_TRUE(set.add(half_space(Vector6::Unit(0), 1.0)));
  ASSERT_TRUE(set.add(half_space(Vector6::Unit(1), 2.0)));
  const Vector6 before = set.z();
  EXPECT_FALSE(set.add(half_space(-Vector6::Unit(0), 0.0)));
  EXPECT_EQ(set.size(), 2);
  EXPECT_EQ(set.z(), before);
  expect_optimal(Vector6::Zero(), set, 1e-15);
  // seven half spaces around a simplex whose inside is empty
  Set simplex;
  simplex.start(Vector6::Zero());
  for (int i = 0; i < 6; ++i) ASSERT_TRUE(simplex.add(half_space(Vector6::Unit(i), 1.0)));
  EXPECT_FALSE(simplex.add(half_space(-Vector6::Ones(), 0.0)));
  EXPECT_EQ(simplex.size(), 6);
  expect_optimal(Vector6::Zero(), simplex, 1e-12);
}

TEST(DualActiveSet, IsOptimalOnRandomPolyhedra) {
  NormalDraws random(1);
  int most = 0, contradictions = 0;
  for (int problem = 0; problem < 5000; ++problem) {
    const Vector6 inside = random.vector();
    const bool feasible = problem % 4 != 0;
    std::vector<Set::Inequality> half_spaces;
    const int count = 1 + problem % 200;
    for (int i = 0; i < count; ++i) {
      const Vector6 gradient = random.vector();
      const double slack = std::fabs(random.normal()) * (i % 3 == 0 ? 0.0 : 1.0);
      half_spaces.push_back(half_space(gradient, feasible ? gradient.dot(inside) - slack : random.normal()));
    }
    const Vector6 target = 10.0 * random.vector();
    Set set;
    set.start(target);
    int additions = 0;
    const bool met = meet_all(half_spaces, set, additions);
    most = std::max(most, additions);
    ASSERT_TRUE(met || !feasible) << "problem " << problem;
    contradictions += met ? 0 : 1;
    expect_optimal(target, set, 1e-10);
    if (HasFailure()) FAIL() << "problem " << problem;
  }
  std::printf("most additions %d, contradictions %d of 1250\n", most, contradictions);
  EXPECT_LE(most, 100);
}

TEST(DualActiveSet, ResolveEndsAtTheSamePointWhateverWasGuessed) {
  NormalDraws random(2);
  for (int problem = 0; problem < 2000; ++problem) {
    const Vector6 inside = random.vector();
    std::vector<Set::Inequality> half_spaces;
    for (int i = 0; i < 30; ++i) {
      const Vector6 gradient = random.vector();
      half_spaces.push_back(half_space(gradient, gradient.dot(inside) - std::fabs(random.normal())));
    }
    const Vector6 target = 5.0 * random.vector();
    Set cold, warm;
    cold.start(target);
    int additions = 0;
    ASSERT_TRUE(meet_all(half_spaces, cold, additions));
    warm.start(target);
    for (int i = 0; i < 6; ++i) warm.guess(half_spaces[static_cast<std::size_t>((problem + 5 * i) % (20 + i))]);
    EXPECT_FALSE(warm.size() == 6 && warm.guess(half_spaces[0]));
    warm.resolve();
    expect_optimal(target, warm, 1e-10);
    ASSERT_TRUE(meet_all(half_spaces, warm, additions));
    EXPECT_LT((warm.z() - cold.z()).norm(), 1e-8) << "problem " << problem;
  }
}

TEST(DualActiveSet, KeepsNoTwoInequalitiesThatDependOnEachOther) {
  Set set;
  set.start(Vector6::Zero());
  for (int i = 0; i < 6; ++i) ASSERT_TRUE(set.guess(half_space(Vector6::Unit(0), 1.0)));
  set.resolve();
  EXPECT_EQ(set.size(), 1);
  EXPECT_EQ(set.z(), Vector6::Unit(0));
}

/// A gradient within a millionth of the span of the others counts as dependent. By hand: x >= 1 and, with the sine s of
/// the angle, s y >= sqrt(1 - s^2) x meet at y = 1 / tan(angle).
TEST(DualActiveSet, TellsAnAngleOfAMillionthFromNone) {
  for (const double sine : {1e-3, 1.2e-6, 0.8e-6, 0.0}) {
    Set set;
    set.start(Vector6::Zero());
    ASSERT_TRUE(set.add(half_space(Vector6::Unit(0), 1.0)));
    const double cosine = std::sqrt(1.0 - sine * sine);
    const bool depends = sine < 1e-6;
    EXPECT_EQ(set.add(half_space(-cosine * Vector6::Unit(0) + sine * Vector6::Unit(1), 0.0)), !depends) << sine;
    EXPECT_EQ(set.size(), depends ? 1 : 2) << sine;
    const double expected = depends ? 0.0 : cosine / sine;
    EXPECT_NEAR(set.z()[0], 1.0, 1e-9) << sine;
    EXPECT_NEAR(set.z()[1], expected, 1e-9 * expected) << sine;
  }
}

/// Guesses that depend on others leave, wherever they stand; those behind them stay. By hand: z_i >= i + 1 for the
/// first three coordinates, from the origin.
TEST(DualActiveSet, KeepsTheGuessesBehindADependentOne) {
  const auto bound = [](int axis) { return half_space(Vector6::Unit(axis), axis + 1.0); };
  const std::vector<std::vector<int>> orders = {{0, 0, 1, 2}, {0, 1, 1, 2}, {0, 1, 0, 2, 1}, {0, 0, 1, 1, 2, 2}};
  for (const std::vector<int>& order : orders) {
    Set set;
    set.start(Vector6::Zero());
    for (const int axis : order) ASSERT_TRUE(set.guess(bound(axis)));
    set.resolve();
    ASSERT_EQ(set.size(), 3);
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(set[i].gradient, Vector6(Vector6::Unit(i)));
      EXPECT_NEAR(set[i].multiplier, i + 1.0, 1e-14);
      EXPECT_NEAR(set.z()[i], i + 1.0, 1e-14);
    }
    EXPECT_EQ(set.z().tail<3>().norm(), 0.0);
  }
}

/// A member leaves before the inequality is refused: it returns, and the others have their multipliers again.
TEST(DualActiveSet, RestoresTheMembersThatLeftBeforeARefusal) {
  Set set;
  set.start(Vector6::Zero());
  ASSERT_TRUE(set.add(half_space(Vector6::Unit(0), 1.0)));
  ASSERT_TRUE(set.add(half_space(Vector6::Unit(1), 2.0)));
  ASSERT_TRUE(set.add(half_space(Vector6::Unit(2), 3.0)));
  const Vector6 z = set.z();
  EXPECT_FALSE(set.add(half_space(-Vector6::Unit(0) + 1e-7 * Vector6::Unit(1), 0.0)));
  ASSERT_EQ(set.size(), 3);
  EXPECT_LT((set.z() - z).norm(), 1e-15);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(set[i].gradient, Vector6::Unit(i));
    EXPECT_EQ(set[i].rhs, i + 1.0);
    EXPECT_NEAR(set[i].multiplier, i + 1.0, 1e-14);
  }
  ASSERT_TRUE(set.add(half_space(Vector6::Unit(3), 4.0))) << "and the set goes on";
  EXPECT_NEAR(set.z()[3], 4.0, 1e-15);
}

/// One inequality may make all six others idle: six exchanges, then the addition.
TEST(DualActiveSet, ReplacesAllSixByOne) {
  Set set;
  set.start(Vector6::Zero());
  for (int i = 0; i < 6; ++i) ASSERT_TRUE(set.add(half_space(Vector6::Unit(i), 1.0 + 0.1 * i)));
  ASSERT_TRUE(set.add(half_space(Vector6::Ones(), 60.0)));
  ASSERT_EQ(set.size(), 1);
  EXPECT_LT((set.z() - Vector6::Constant(10.0)).norm(), 1e-13);
  EXPECT_NEAR(set[0].multiplier, 10.0, 1e-13);
}

/// As equalities both guesses pull, by 2 and by 1. Without the stronger one the other pushes by 0.6; without the other
/// the stronger one pulls still, and none would be left.
TEST(DualActiveSet, RemovesTheStrongestPullFirst) {
  const Vector6 a = Vector6::Unit(0);
  const Vector6 b = -0.8 * Vector6::Unit(0) + 0.6 * Vector6::Unit(1);
  for (const bool a_first : {true, false}) {
    Set set;
    set.start(Vector6::Zero());
    const Set::Inequality stronger = half_space(a, -1.2), other = half_space(b, 0.6);
    ASSERT_TRUE(set.guess(a_first ? stronger : other));
    ASSERT_TRUE(set.guess(a_first ? other : stronger));
    set.resolve();
    ASSERT_EQ(set.size(), 1);
    EXPECT_EQ(set[0].gradient, b);
    EXPECT_NEAR(set[0].multiplier, 0.6, 1e-15);
    EXPECT_LT((set.z() - 0.6 * b).norm(), 1e-15);
  }
}

}  // namespace
}  // namespace godobject::test::dual_active_set_test
