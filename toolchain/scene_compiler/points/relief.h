#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "toolchain/parallel/parallel.h"
#include "toolchain/scene_compiler/mesh/outer_surface.h"
#include "toolchain/scene_compiler/mesh/surface_sample.h"
#include "toolchain/scene_compiler/points/point_tree.h"

namespace godobject::scene_compiler {

/// An outer surface as a cloud of places, to see how it falls away below the plane through any of them: coarse all
/// over (a quarter of the reach), fine where the surface does so soon, sharp vertices and edges always.
class Relief {
 public:
  struct Resolution {
    double reach;  ///< how far around a place the fall is asked for [m]
    double fall;   ///< smallest fall that matters [m]
    double fine;   ///< spacing where the surface falls by that much within three coarse spacings, and of edges [m]
  };

  /// Deterministic; another `seed` gives other places. Cost: some 10 us a place.
  Relief(const OuterSurface& outer, const Resolution& resolution, std::uint32_t seed,
         const parallel::Progress& progress);

  std::span<const SurfaceSample> places() const { return places_; }

  std::size_t evenly_spread() const { return evenly_spread_; }  ///< of the places: the first ones

  /// Between places where the surface falls soon [m]: what was asked for, or more where that takes too many.
  double fine() const { return fine_; }

  /// A fall below the plane of the triangle at a place, on the place's side of the body.
  struct Fall {
    double depth;  ///< more than this below the plane [m]
    double seen;   ///< but hardly deeper than this: what lies there needs no look [m]
  };

  /// Whether the surface falls so not further than `radius` from the plane's normal at the place [m].
  bool falls(std::size_t place, double radius, const Fall& fall) const;

  /// How far `point` lies below that plane, negative above it [m].
  double depth_below(std::size_t place, const Eigen::Vector3d& point) const {
    return (point - places_[place].point).dot(inward_[place]);
  }

  /// The largest radius, at most `limit`, within which it does not [m].
  double level_radius(std::size_t place, const Fall& fall, double limit) const;

  double area() const { return area_; }  ///< of the outer surface [m^2]

 private:
  /// Depth below the plane that nothing in the box exceeds.
  double lowest(std::size_t place, const Eigen::Vector3d& low, const Eigen::Vector3d& high) const;

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
