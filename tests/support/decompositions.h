#pragma once

#include <Eigen/Core>

namespace godobject::test {

// Decompositions of matrices of any size. The compiler takes seconds for each one, so they are compiled once for all
// tests.

/// A = U diag(values) V^T, with the smaller of A's sizes as the number of values, largest first.
struct SingularValues {
  Eigen::MatrixXd U;
  Eigen::VectorXd values;
  Eigen::MatrixXd V;
};
SingularValues singular_values_of(const Eigen::MatrixXd& A);

/// Returns the eigenvalues of a square matrix, in no order.
Eigen::VectorXcd eigenvalues_of(const Eigen::MatrixXd& A);

/// Returns the eigenvalues of a symmetric matrix, smallest first.
Eigen::VectorXd eigenvalues_of_symmetric(const Eigen::MatrixXd& A);

/// Returns A^+: x = A^+ b has the least norm among those with the least |A x - b|.
Eigen::MatrixXd pseudo_inverse_of(const Eigen::MatrixXd& A);

/// Returns A^+ b.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

}  // namespace godobject::test
