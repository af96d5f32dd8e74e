// Small linear systems: known solutions and singular systems, in units of very different size.

#include "core/pipeline/contact/qp/small_system.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "tests/support/random.h"

namespace godobject::test::small_system_test {
namespace {

constexpr int kSize = 5;

/// Returns random equations with a known solution. The unknown `column` has the unit 1 / `scale`.
SmallSystem<kSize> equations(Random& random, int column, double scale, std::array<double, kSize>& solution) {
  SmallSystem<kSize> system;
  system.size = kSize;
  for (double& x : solution) x = random.between(-1.0, 1.0);
  for (int i = 0; i < kSize; ++i) {
    system.rhs[i] = 0.0;
    for (int j = 0; j < kSize; ++j) {
      const double element = random.between(-1.0, 1.0) + (i == j ? 3.0 : 0.0);
      system.matrix[i][j] = element * (j == column ? scale : 1.0);
      system.rhs[i] += element * solution[static_cast<std::size_t>(j)];
    }
  }
  solution[static_cast<std::size_t>(column)] /= scale;
  return system;
}

TEST(SmallSystem, FindsTheSolutionInAnyUnits) {
  Random random(41);
  for (const double scale : {1e-20, 1e-9, 1.0, 1e9, 1e20}) {
    for (int problem = 0; problem < 100; ++problem) {
      std::array<double, kSize> solution;
      SmallSystem<kSize> system = equations(random, problem % kSize, scale, solution);
      ASSERT_TRUE(system.solve()) << scale;
      for (int i = 0; i < kSize; ++i) {
        const double x = solution[static_cast<std::size_t>(i)];
        const double unit = i == problem % kSize ? 1.0 / scale : 1.0;
        EXPECT_NEAR(system.rhs[i], x, 1e-13 * unit) << scale;
      }
    }
  }
}

TEST(SmallSystem, SaysThatColumnsDependInAnyUnits) {
  Random random(42);
  for (const double scale : {1e-20, 1e-9, 1.0, 1e9, 1e20}) {
    for (int problem = 0; problem < 100; ++problem) {
      std::array<double, kSize> solution;
      const int column = problem % kSize;
      SmallSystem<kSize> system = equations(random, column, scale, solution);
      for (auto& row : system.matrix) row[column] = scale * row[(column + 1) % kSize];
      EXPECT_FALSE(system.solve()) << scale << ", problem " << problem;
    }
  }
}

/// A column is compared with its largest element, in whichever row that stands. By hand: of the rows (1e6, 1) and
/// (1, 1e-6 (1 + e)) the elimination leaves 1e-6 e of the second column, whose largest element is 1.
TEST(SmallSystem, ComparesAColumnWithItsLargestElement) {
  for (int large = 0; large < kSize; ++large) {
    for (int small = 0; small < kSize; ++small) {
      if (large == small) continue;
      for (const double e : {1e-6, 1e-10}) {
        SmallSystem<kSize> system;
        system.size = kSize;
        int other = 2;  // columns of the other rows, which are those of the identity
        for (int i = 0; i < kSize; ++i) {
          system.rhs[i] = 1.0;
          for (double& element : system.matrix[i]) element = 0.0;
          if (i != large && i != small) system.matrix[i][other++] = 1.0;
        }
        system.matrix[large][0] = 1e6;
        system.matrix[large][1] = 1.0;
        system.matrix[small][0] = 1.0;
        system.matrix[small][1] = 1e-6 * (1.0 + e);
        EXPECT_EQ(system.solve(), 1e-6 * e > 1e-14) << large << ' ' << small << ' ' << e;
      }
    }
  }
}

/// Without an exchange of rows the elimination would divide by zero, or by a pivot of rounding size.
TEST(SmallSystem, ExchangesRowsWhereAPivotIsSmall) {
  Random random(43);
  EXPECT_EQ(SmallSystem<kSize>{}.size, 0);
  int order[kSize] = {0, 1, 2, 3, 4};
  int permutations = 0;
  do {
    for (const double small : {0.0, 1e-17, -1e-13}) {
      SmallSystem<kSize> system;
      system.size = kSize;
      double x[kSize];
      for (double& value : x) value = random.between(-1.0, 1.0);
      for (int i = 0; i < kSize; ++i) {
        system.rhs[i] = 0.0;
        for (int j = 0; j < kSize; ++j) {
          system.matrix[i][j] = j == order[i] ? (i % 2 == 0 ? -2.0 : 2.0) : small * random.between(0.5, 1.0);
          system.rhs[i] += system.matrix[i][j] * x[j];
        }
      }
      ASSERT_TRUE(system.solve());
      for (int i = 0; i < kSize; ++i) EXPECT_NEAR(system.rhs[i], x[i], 1e-14);
    }
    ++permutations;
  } while (std::next_permutation(std::begin(order), std::end(order)));
  EXPECT_EQ(permutations, 120);
}

/// Of a larger array only the first rows and columns count.
TEST(SmallSystem, SolvesSystemsOfEachSize) {
  Random random(44);
  for (int size = 0; size <= kSize; ++size) {
    for (int trial = 0; trial < 100; ++trial) {
      SmallSystem<kSize> system;
      system.size = size;
      double x[kSize] = {};
      for (int i = 0; i < kSize; ++i) {
        system.rhs[i] = 1e300;
        for (int j = 0; j < kSize; ++j) system.matrix[i][j] = 1e300;
      }
      for (int i = 0; i < size; ++i) x[i] = random.between(-1.0, 1.0);
      for (int i = 0; i < size; ++i) {
        system.rhs[i] = 0.0;
        for (int j = 0; j < size; ++j) {
          system.matrix[i][j] = random.between(-1.0, 1.0) + (i == (j + 1) % size ? -3.0 : 0.0);
          system.rhs[i] += system.matrix[i][j] * x[j];
        }
      }
      ASSERT_TRUE(system.solve()) << size;
      for (int i = 0; i < size; ++i) EXPECT_NEAR(system.rhs[i], x[i], 1e-12) << size;
    }
  }
}

TEST(SmallSystem, RefusesAColumnOfZeros) {
  for (int column = 0; column < 3; ++column) {
    SmallSystem<kSize> system;
    system.size = 3;
    for (int i = 0; i < 3; ++i) {
      system.rhs[i] = 1.0;
      for (int j = 0; j < 3; ++j) system.matrix[i][j] = j == column ? 0.0 : (i == j ? 2.0 : 0.5);
    }
    EXPECT_FALSE(system.solve()) << column;
  }
}

}  // namespace
}  // namespace godobject::test::small_system_test
