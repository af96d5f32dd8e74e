// Small linear systems: known solutions and singular systems, in units of very different size.

#include "core/pipeline/contact/qp/small_system.h"

#include <gtest/gtest.h>

#include <array>

#include "tests/support/random.h"

namespace godobject::test {
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

}  // namespace
}  // namespace godobject::test
