#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "core/scene/field.h"

/// Still bodies given by formulae, which show the solvers without the errors of voxels.
namespace godobject::analytic {

/// Returns the exact signed distance to an axis-aligned box about the origin [m].
inline double box_distance(const Vector3& p, const Vector3& half_edges) {
  const Vector3 q = p.cwiseAbs() - half_edges;
  return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0);
}

/// A DistanceField from an exact signed distance function `Shape::distance(p)`, with its gradient by
/// `Shape::gradient(p)`. One type for all shapes, so that the solvers are compiled once for all of them. Layers are
/// those of voxels centred at the multiples of the voxel size.
class AnalyticField {
 public:
  template <class Shape>
  AnalyticField(Shape shape, double voxel_size)
      : shape_(std::make_shared<Of<Shape>>(std::move(shape))), voxel_size_(voxel_size) {}

  FieldSample sample(const Vector3& p) const noexcept {
    const double distance = shape_->distance(p);
    return {distance, shape_->gradient(p), true, std::max(0.0, distance)};
  }
  void clearances(const Pose& H, PointBatch& batch) const noexcept { sample_clearances(*this, H, batch); }
  void samples(const Pose& H, SampleBatch& batch) const noexcept { sample_each(*this, H, batch); }
  std::uint64_t free_chords(const Pose&, const Pose&, SampleBatch&) const noexcept { return 0; }
  LayerSample layer(const Vector3& p) const noexcept {
    const Vector3 center = voxel_size_ * (p / voxel_size_).array().round().matrix();
    return {static_cast<int>(std::floor(0.5 - shape_->distance(center) / voxel_size_)), center - p};
  }
  double lower_bound(const Vector3& center, double radius) const noexcept {
    const double bound = shape_->distance(center) - radius;
    return bound >= 0.0 ? bound : -std::numeric_limits<double>::infinity();
  }
  double lipschitz() const noexcept { return 1.0; }
  double assured_clearance() const noexcept { return band(); }
  double voxel_size() const noexcept { return voxel_size_; }
  double band() const noexcept { return 1e3; }

 private:
  struct AnyShape {
    virtual ~AnyShape() = default;
    virtual double distance(const Vector3& p) const noexcept = 0;
    virtual Vector3 gradient(const Vector3& p) const noexcept = 0;
  };
  template <class Shape>
  struct Of final : AnyShape {
    explicit Of(Shape its) : shape(std::move(its)) {}
    double distance(const Vector3& p) const noexcept override { return shape.distance(p); }
    Vector3 gradient(const Vector3& p) const noexcept override { return shape.gradient(p); }
    Shape shape;
  };

  std::shared_ptr<const AnyShape> shape_;
  double voxel_size_;
};

/// Solid where n.p < offset; n is a unit vector.
struct HalfSpace {
  Vector3 n = Vector3::UnitZ();
  double offset = 0.0;
  double distance(const Vector3& p) const noexcept { return n.dot(p) - offset; }
  Vector3 gradient(const Vector3&) const noexcept { return n; }
};

/// A solid ball.
struct Ball {
  Vector3 center = Vector3::Zero();
  double radius = 0.1;
  double distance(const Vector3& p) const noexcept { return (p - center).norm() - radius; }
  Vector3 gradient(const Vector3& p) const noexcept { return (p - center).normalized(); }
};

}  // namespace godobject::analytic
