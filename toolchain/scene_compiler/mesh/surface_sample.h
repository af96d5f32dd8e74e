#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace godobject::scene_compiler {

/// A point on the surface of a body.
struct SurfaceSample {
  /// What it stands on; where samples crowd the sharper place wins.
  enum class Place : std::uint8_t { kFace = 0, kEdge = 1, kVertex = 2 };

  Eigen::Vector3d point;
  Eigen::Vector3d inward;  ///< unit normal, into the body
  Place place = Place::kFace;
  bool on_shell = false;  ///< half a thickness off the triangles of a sheet; otherwise on a triangle of a solid
};

inline std::vector<Eigen::Vector3d> points_of(std::span<const SurfaceSample> samples) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(samples.size());
  for (const SurfaceSample& sample : samples) points.push_back(sample.point);
  return points;
}

/// Whether samples stand for the same side of the body. Where it is thinner than their distance those of the other side
/// are near, but feel other contacts: they neither crowd each other nor stand in for each other.
inline bool same_side(const SurfaceSample& a, const SurfaceSample& b) { return a.inward.dot(b.inward) > -0.5; }

}  // namespace godobject::scene_compiler
