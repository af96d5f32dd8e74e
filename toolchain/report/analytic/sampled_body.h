#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/pipeline/cycle/parameters.h"
#include "core/scene/pointshell.h"

namespace godobject::analytic {

/// Sample points with a sphere tree of one leaf; owns the data of its Pointshell.
class SampledBody {
 public:
  /// `normals`: unit, pointing into the body, one per point. `principal_inertia`: J_B / m [m^2].
  SampledBody(const std::vector<Vector3>& points, const std::vector<Vector3>& normals, const Vector3& principal_inertia,
              double voxel_size)
      : count_(points.size()) {
    for (const auto* vectors : {&points, &normals}) {
      for (int axis = 0; axis < 3; ++axis) {
        for (const Vector3& v : *vectors) values_.push_back(static_cast<float>(v[axis]));
      }
    }
    float radius = 0.0f;
    for (const Vector3& p : points) radius = std::max(radius, static_cast<float>(p.norm() * (1.0 + 1e-6)));
    node_ = {{0.0f, 0.0f, 0.0f}, radius, 1, 0, static_cast<std::uint32_t>(count_), 0, 1};
    mass = MassModel::make(principal_inertia, static_cast<double>(radius),
                           std::max(static_cast<double>(radius), voxel_size));
  }

  Pointshell pointshell() const {
    const float* v = values_.data();
    return {count_, v, v + count_, v + 2 * count_, v + 3 * count_, v + 4 * count_, v + 5 * count_, {&node_, 1}};
  }

  MassModel mass;

 private:
  std::size_t count_;
  std::vector<float> values_;
  format::Node node_{};
};

}  // namespace godobject::analytic
