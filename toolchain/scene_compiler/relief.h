#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "toolchain/scene_compiler/outer_surface.h"
#include "toolchain/scene_compiler/parallel.h"
#include "toolchain/scene_compiler/point_tree.h"
#include "toolchain/scene_compiler/surface_sample.h"

namespace godobject::scene_compiler {

/// An outer surface as a cloud of places, to see how it falls away below the plane through any of them: coarse all
/// over (a fifth of the reach), fine where the surface does so soon, sharp vertices and edges always.
class Relief {
 public:
  struct Resolution {
    double reach;  ///< how far around a place the fall is asked for [m]
    double fall;   ///< smallest fall that matters [m]
    double fine;   ///< spacing where the surface falls by that much within three coarse spacings, and of edges [m]
  };

  /// Deterministic; another `seed` gives other places. Cost: some 10 us a place.
  Relief(const OuterSurface& outer, const Resolution& resolution, std::uint32_t seed, const Progress& progress);

  std::span<const SurfaceSample> places() const { return places_; }

  /// How far the surface lies below the plane of its triangle at a place at most, not further than `radius` from the
  /// plane's normal there and on the place's side of the body; no more than the radius [m].
  double fall(std::size_t place, double radius) const;

  /// How far `point` lies below that plane, negative above it [m].
  double depth_below(std::size_t place, const Eigen::Vector3d& point) const {
    return (point - places_[place].point).dot(inward_[place]);
  }

  /// The largest radius, at most `limit`, over which the fall is no more than `fall` [m].
  double level_radius(std::size_t place, double fall, double limit) const;

  double area() const { return area_; }  ///< of the outer surface [m^2]

 private:
  /// The cloud to look at for a fall over `radius`.
  const PointTree& tree(double radius) const { return radius < fine_below_ ? all_ : coarse_; }

  /// Depth below the plane that nothing in the box exceeds.
  double lowest(std::size_t place, const Eigen::Vector3d& low, const Eigen::Vector3d& high) const;

  PointTree add(const OuterSurface& outer, std::span<const SurfaceSample> samples);
  std::vector<SurfaceSample> fine_places(const OuterSurface& outer, const Resolution& resolution, std::uint32_t seed,
                                         const Progress& progress) const;

  std::vector<SurfaceSample> places_;
  std::vector<Eigen::Vector3d> inward_;  ///< by place: normal of its triangle
  double fine_below_;                    ///< [m]
  PointTree coarse_;                     ///< the coarse places and the sharp ones
  PointTree all_;
  double area_ = 0.0;
};

}  // namespace godobject::scene_compiler
