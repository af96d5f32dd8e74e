#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/scene/format.h"

namespace godobject::scene_compiler {

/// Returns the squared distance of a point from a facet [m^2]; or, where that is above `most`, another number above it.
double squared_distance_within(const format::Facet& facet, const Eigen::Vector3d& p, double most);

/// Finds the facets that may be the nearest ones of some point in a ball: those that are at most two radii farther from
/// its centre than the nearest one (as NearTriangles). Keeps its memory from one search to the next.
class NearFacets {
 public:
  /// Refers to the facets.
  explicit NearFacets(std::span<const format::Facet> facets) : facets_(facets) {}

  /// Sets `near` to those of the facets with these numbers, of which there is at least one, in the same order. `center`
  /// and `radius` of the ball [m]. Cost: a comparison of planes for each facet, and a distance for each that these do
  /// not leave out.
  void find(std::span<const std::uint32_t> numbers, const Eigen::Vector3d& center, double radius,
            std::vector<std::uint32_t>& near);

 private:
  std::span<const format::Facet> facets_;
  std::vector<double> least_;    // bounds of the squared distances from the centre [m^2]
  std::vector<double> squared_;  // these distances; below zero: not known
};

}  // namespace godobject::scene_compiler
