#pragma once

#include <cstdint>
#include <functional>
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

  /// The surface near some places that lie near each other, for several questions about falls.
  class Vicinity;

  using Run = std::span<const std::uint32_t>;  ///< places that lie near each other, most with similar normals

  /// Calls work(run) for runs of all places, in parallel, each place once.
  void for_each_run(const std::function<void(const Run&)>& work) const { for_each_run(all_, work); }

  /// Returns the depth of `point` below that plane, negative above it [m].
  double depth_below(std::size_t place, const Eigen::Vector3d& point) const {
    return (point - places_[place].point).dot(inward_[place]);
  }

  /// Returns the largest radius, at most `limit`, within which the surface does not fall like this [m].
  double level_radius(std::size_t place, const Fall& fall, double limit) const;

  double area() const { return area_; }  ///< of the outer surface [m^2]

 private:
  /// False if nothing in the box is more than `depth` below the plane and at most `radius` from its normal [m].
  bool may_fall(std::size_t place, const PointTree::Bounds& box, double depth, double radius) const;

  void for_each_run(const PointTree& tree, const std::function<void(const Run&)>& work) const;

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

/// The parts of both clouds that may show a fall at any of some places. Parts that show none at all of the places are
/// found once, not again at each place.
class Relief::Vicinity {
 public:
  /// For questions about these places and this fall, at most `radius` aside [m].
  Vicinity(const Relief& relief, const Run& places, double radius, const Fall& fall);

  /// Equals Relief::falls. Not for use by several threads.
  bool falls(std::size_t place, double radius);

 private:
  /// A place that may show a fall.
  struct Candidate {
    Eigen::Vector3d point;
    std::uint32_t place;
  };

  /// Candidates that lie near each other, in a box.
  struct Part {
    PointTree::Bounds box;
    std::uint32_t begin, end;  ///< candidates
  };

  struct Cloud {
    std::vector<Part> parts;
    std::vector<Candidate> candidates;
  };

  /// Bounds over the places that are asked about.
  struct Bounds {
    Eigen::Vector3d center;
    double radius;           ///< largest distance of a place from the centre [m]
    Eigen::Vector3d inward;  ///< mean of the triangles' normals
    double turned;           ///< largest difference of a normal from it [1]
    double above;            ///< largest depth of the centre below the plane of a place [m]
    Eigen::Vector3d side;    ///< mean of SurfaceSample::inward
    double side_turned;      ///< largest difference from it [1]
  };

  Bounds bounds_of(const Run& places) const;
  Cloud near(const PointTree& tree, const Bounds& places, double radius) const;
  void add(const PointTree& tree, const PointTree::Run& run, const Bounds& places, double radius, Cloud& cloud) const;
  bool falls_in(Cloud& cloud, std::size_t place, double radius) const;
  bool shows_fall(std::size_t place, const Candidate& candidate, double radius, double furthest) const;

  const Relief& relief_;
  const Fall fall_;
  Cloud coarse_;
  Cloud all_;
};

}  // namespace godobject::scene_compiler
