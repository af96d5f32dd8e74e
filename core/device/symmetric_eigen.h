#pragma once

#include <cmath>

#include <Eigen/Core>

namespace godobject {

/// Eigenvalues, in any order, and eigenvectors, as columns, of a small symmetric matrix.
template <int kSize>
struct SymmetricEigen {
  Eigen::Matrix<double, kSize, 1> values;
  Eigen::Matrix<double, kSize, kSize> vectors;
};

/// Eigenvalues and eigenvectors by Jacobi's cyclic method (Golub and Van Loan, *Matrix Computations*, 8.5), in at most
/// 12 sweeps; six are usual. False if that was not enough, which only a matrix that is not finite brings about. Eigen's
/// own solver links heap functions, although it does not use them at this size. Cost: 2 to 4 us for six rows. Real-time
/// safe.
template <int kSize>
bool symmetric_eigen(Eigen::Matrix<double, kSize, kSize> matrix, SymmetricEigen<kSize>& result) noexcept {
  constexpr int kMaxSweeps = 12;
  constexpr double kNegligible = 1e-32;  // relative to the squared norm; about the square of a double's rounding, 1e-16
  result.vectors.setIdentity();
  const double size = matrix.squaredNorm();
  for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
    double off_diagonal = 0.0;
    for (int p = 0; p < kSize; ++p) {
      for (int q = p + 1; q < kSize; ++q) off_diagonal += matrix(p, q) * matrix(p, q);
    }
    if (off_diagonal <= kNegligible * size) {
      result.values = matrix.diagonal();
      return true;
    }
    for (int p = 0; p < kSize; ++p) {
      for (int q = p + 1; q < kSize; ++q) {
        const double element = matrix(p, q);
        if (element * element <= 1e-3 * kNegligible * size) continue;
        // the smaller of the two rotations that bring the element to zero
        const double half_difference = 0.5 * (matrix(q, q) - matrix(p, p));
        const double root = std::sqrt(half_difference * half_difference + element * element);
        const double tangent = element / (half_difference + (half_difference < 0.0 ? -root : root));
        const double cosine = 1.0 / std::sqrt(1.0 + tangent * tangent);
        const double sine = tangent * cosine;
        const auto turn = [&](auto&& a, auto&& b) {
          const Eigen::Matrix<double, kSize, 1> before = a;
          a = cosine * before - sine * b;
          b = sine * before + cosine * b;
        };
        turn(matrix.col(p), matrix.col(q));
        turn(matrix.row(p).transpose(), matrix.row(q).transpose());
        turn(result.vectors.col(p), result.vectors.col(q));
      }
    }
  }
  return false;
}

}  // namespace godobject
