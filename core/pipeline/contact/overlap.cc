#include "core/pipeline/contact/overlap.h"

#include <Eigen/Cholesky>

namespace godobject::detail {

Motion Overlap::way_out(const Motion& wanted) const noexcept {
  const double weight = 1e-3 * squares_.trace();
  if (!(weight > 0.0)) return wanted;
  Vector6 to_device;
  to_device << wanted.translation, lengths_.metric.gyration * wanted.rotation;
  const Vector6 y = (squares_ + weight * Matrix6::Identity()).ldlt().solve(sums_ + weight * to_device);
  return {y.head<3>(), y.tail<3>() / lengths_.metric.gyration};
}

}  // namespace godobject::detail
