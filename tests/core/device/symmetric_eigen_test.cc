#include "core/device/symmetric_eigen.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/decompositions.h"
#include "tests/support/random.h"

namespace godobject {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

void expect_right(const Matrix6& matrix) {
  SymmetricEigen<6> found;
  ASSERT_TRUE(symmetric_eigen<6>(matrix, found));
  const double size = matrix.norm();
  ASSERT_LT((found.vectors.transpose() * found.vectors - Matrix6::Identity()).norm(), 1e-14);
  ASSERT_LE((found.vectors * found.values.asDiagonal() * found.vectors.transpose() - matrix).norm(), 1e-14 * size);
  Vector6 values = found.values;
  std::sort(values.data(), values.data() + 6);
  ASSERT_LE((values - test::eigenvalues_of_symmetric(matrix)).norm(), 1e-14 * size);
}

TEST(SymmetricEigen, AgreesWithEigen) {
  test::Random random(1);
  for (int i = 0; i < 20000; ++i) {
    SCOPED_TRACE(i);
    // ranks from 1 to 7, sizes over twelve decades
    Eigen::Matrix<double, 6, 7> J = Eigen::Matrix<double, 6, 7>::Zero();
    for (int k = 0; k <= i % 7; ++k) J.col(k) << random.in_cube(1.0), random.in_cube(1.0);
    J *= std::pow(10.0, random.between(-6.0, 6.0));
    if (i % 5 == 0) J.row(3).setZero();
    if (i % 11 == 0) J.row(2) = J.row(1);
    if (i % 13 == 0) J.row(2) *= 1e-8;
    expect_right(J * J.transpose());
    if (HasFatalFailure()) return;
  }
}

TEST(SymmetricEigen, SolvesWhatIsAlreadySolvedOrAllAlike) {
  expect_right(Matrix6::Zero());
  expect_right(Matrix6::Identity());
  expect_right(Matrix6::Ones());
  expect_right(Vector6(1.0, 1.0, 2.0, 2.0, 0.0, -3.0).asDiagonal());
}

TEST(SymmetricEigen, SaysSoWhenItIsNotFinite) {
  Matrix6 matrix = Matrix6::Ones();
  matrix(1, 2) = matrix(2, 1) = std::numeric_limits<double>::quiet_NaN();
  SymmetricEigen<6> found;
  EXPECT_FALSE(symmetric_eigen<6>(matrix, found));
}

}  // namespace
}  // namespace godobject
