#include "core/pipeline/contact/qp/coupling_space.h"

#include <Eigen/Cholesky>

namespace godobject::detail {

void CouplingSpace::set_metric(const Matrix6& H) noexcept {
  whiten_ = Eigen::LLT<Matrix6>(H).matrixL().solve(Matrix6::Identity());
  whitened_ = true;
}

}  // namespace godobject::detail
