#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "toolchain/parallel/parallel.h"
#include "toolchain/scene_compiler/mesh/outer_surface.h"
#include "toolchain/scene_compiler/mesh/surface_sample.h"
#include "toolchain/scene_compiler/points/point_tree.h"

namespace godobject::scene_compiler {

/// An outer surface as a cloud of places. It tells how the surface falls away below the tangent plane of any place.
/// Places are coarse (a third of the search radius) all over, fine where the surface falls soon, and always at sharp
/// vertices and edges.
class Relief {
 public:
  struct Resolution {
    double search_radius;  ///< radius around a place within which falls are looked up [m]
    double fall;           ///< smallest fall that matters [m]
    double fine;  ///< spacing on edges, and where the surface falls by that much within three coarse spacings [m]
  };

  /// Deterministic. Another `seed` gives other places. Cost: some 10 us for each place.
  Relief(const OuterSurface& outer, const Resolution& resolution, std::uint32_t seed,
         const parallel::Progress& progress);

  std::span<const SurfaceSample> places() const { return places_; }

  /// The number of evenly spread places, which come first.
  std::size_t evenly_spread() const { return evenly_spread_; }

  /// Returns the spacing of places where the surface falls soon [m]: the requested one, or a larger one if that takes
  /// too many places.
  double fine() const { return fine_; }

  /// A fall below the plane of the triangle at a place, on the place's side of the body.
  struct Fall {
    double depth;  ///< more than this below the plane [m]
    double seen;   ///< but hardly deeper than this: deeper surface is not looked up [m]
  };

  /// True if the surface falls like this at most `radius` from the plane's normal at the place [m].
  bool falls(std::size_t place, double radius, const Fall& fall) const;

  /// Returns the depth of `point` below that plane, negative above it [m].
  double depth_below(std::size_t place, const Eigen::Vector3d& point) const {
    return (point - places_[place].point).dot(inward_[place]);
  }

  /// Returns the largest radius, at most `limit`, within which the surface does not fall like this [m].
  double level_radius(std::size_t place, const Fall& fall, double limit) const;

  double area() const { return area_; }  ///< of the outer surface [m^2]

 private:
  /// False if nothing in the box is more than `depth` below the plane and at most `radius` from its normal [m].
  bool may_fall(std::size_t place, const Eigen::Vector3d& low, const Eigen::Vector3d& high, double depth,
                double radius) const;

  PointTree add(const OuterSurface& outer, std::span<const SurfaceSample> samples);
  std::vector<SurfaceSample> fine_places(const OuterSurface& outer, const Resolution& resolution, std::uint32_t seed,
                                         const parallel::Progress& progress);

  std::vector<SurfaceSample> places_;
  std::vector<Eigen::Vector3d> inward_;  ///< by place: normal of its triangle
  double fine_below_;                    ///< [m]
  double fine_;                          ///< [m]
  std::size_t evenly_spread_ = 0;
  PointTree coarse_;  ///< the coarse places and the sharp ones
  PointTree all_;
  double area_ = 0.0;
};

}  // namespace godobject::scene_compiler
