#pragma once

#include <limits>
#include <span>

#include <Eigen/Core>

namespace godobject::scene_compiler {

/// Axis-aligned box. A new one is empty: low = +infinity, high = -infinity.
struct Box {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d high = Eigen::Vector3d::Constant(-std::numeric_limits<double>::infinity());

  /// The smallest box that contains the points.
  static Box around(std::span<const Eigen::Vector3d> points) noexcept {
    Box box;
    for (const Eigen::Vector3d& point : points) box.add(point);
    return box;
  }

  void add(const Eigen::Vector3d& point) noexcept {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  void add(const Box& other) noexcept {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
  }
  bool contains(const Eigen::Vector3d& p) const noexcept {
    return (p.array() >= low.array()).all() && (p.array() <= high.array()).all();
  }
  /// Returns the square of the distance from p; 0 inside.
  double squared_distance(const Eigen::Vector3d& p) const noexcept {
    return (low - p).cwiseMax(p - high).cwiseMax(0.0).squaredNorm();
  }
  double diagonal() const noexcept { return (high - low).norm(); }
  double longest() const noexcept { return (high - low).maxCoeff(); }  ///< edge

  /// Smallest and largest distance between a place of this box and one of the other.
  double nearest(const Box& other) const noexcept {
    return (low - other.high).cwiseMax(other.low - high).cwiseMax(0.0).norm();
  }
  double farthest(const Box& other) const noexcept { return (other.high - low).cwiseMax(high - other.low).norm(); }
};

}  // namespace godobject::scene_compiler
