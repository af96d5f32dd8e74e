#pragma once

#include <cmath>
#include <cstddef>
#include <utility>

namespace godobject {

/// A few linear equations, solved in place by Gauss' elimination with row pivoting.
template <std::size_t kMost>
struct SmallSystem {
  int size = 0;
  double matrix[kMost][kMost];
  double rhs[kMost];  // then the solution

  /// False if singular.
  bool solve() noexcept {
    constexpr double kSingular = 1e-14;
    for (int k = 0; k < size; ++k) {
      int pivot = k;
      for (int i = k + 1; i < size; ++i) {
        if (std::fabs(matrix[i][k]) > std::fabs(matrix[pivot][k])) pivot = i;
      }
      if (!(std::fabs(matrix[pivot][k]) > kSingular)) return false;
      if (pivot != k) {
        for (int j = k; j < size; ++j) std::swap(matrix[k][j], matrix[pivot][j]);
        std::swap(rhs[k], rhs[pivot]);
      }
      const double inverse = 1.0 / matrix[k][k];
      for (int i = k + 1; i < size; ++i) {
        const double factor = matrix[i][k] * inverse;
        for (int j = k + 1; j < size; ++j) matrix[i][j] -= factor * matrix[k][j];
        rhs[i] -= factor * rhs[k];
      }
    }
    for (int k = size - 1; k >= 0; --k) {
      for (int j = k + 1; j < size; ++j) rhs[k] -= matrix[k][j] * rhs[j];
      rhs[k] /= matrix[k][k];
    }
    return true;
  }
};

}  // namespace godobject
