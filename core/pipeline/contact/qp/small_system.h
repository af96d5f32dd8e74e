#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace godobject {

/// A small system of linear equations, solved in place by Gaussian elimination with row pivoting. Cost: about size^3 /
/// 3 multiplications. Real-time safe.
template <std::size_t kMost>
struct SmallSystem {
  int size = 0;
  double matrix[kMost][kMost];
  double rhs[kMost];  ///< after `solve` the solution

  /// Solves the system. False: it is singular, and the solution is undefined. A column counts as dependent if all but
  /// 1e-14 of its largest element depends on the columns before it, so the units of the unknowns do not matter.
  bool solve() noexcept {
    constexpr double kSingular = 1e-14;
    double largest[kMost];
    for (int j = 0; j < size; ++j) largest[j] = std::fabs(matrix[0][j]);
    for (int i = 1; i < size; ++i) {
      for (int j = 0; j < size; ++j) largest[j] = std::max(largest[j], std::fabs(matrix[i][j]));
    }
    for (int k = 0; k < size; ++k) {
      int pivot = k;
      for (int i = k + 1; i < size; ++i) {
        if (std::fabs(matrix[i][k]) > std::fabs(matrix[pivot][k])) pivot = i;
      }
      if (!(std::fabs(matrix[pivot][k]) > kSingular * largest[k])) return false;
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
