#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "toolchain/parallel/parallel.h"
#include "toolchain/scene_compiler/mesh/body_mesh.h"
#include "toolchain/scene_compiler/mesh/sharp_features.h"
#include "toolchain/scene_compiler/mesh/surface_patches.h"
#include "toolchain/scene_compiler/mesh/surface_sample.h"

namespace godobject::scene_compiler {

/// The outer boundary of a body, as a source of samples: the pieces of its surface that separate inside from outside.
/// Surface inside another component is buried and does not count.
class OuterSurface {
 public:
  struct Spread {
    std::vector<SurfaceSample> samples;
    double area = 0.0;  ///< of the outer surface [m^2], estimated from the share of the draws on it
  };

  /// Stores a reference: `surface` must outlive this object.
  explicit OuterSurface(const SolidSurface& surface);

  const SolidSurface& surface() const { return surface_; }
  const BodyMesh& body() const { return body_; }
  double area() const { return patches_.area(); }  ///< of the whole surface, buried parts included [m^2]

  /// Returns `wanted` random samples or some more, stratified by area. Another `seed` gives other samples. `progress`
  /// gets 0 .. 1 and may be empty. Cost: one winding number for each draw. Throws std::runtime_error if the mesh has
  /// (nearly) no outer surface.
  Spread spread(std::uint32_t wanted, std::uint32_t seed, const parallel::Progress& progress) const;

  /// Returns `count` draws of the whole surface, buried parts included. The caller may test a few of them with
  /// are_outer().
  std::vector<SurfaceSample> draw_all(std::uint32_t count, std::uint32_t seed) const;

  /// Returns draws about `spacing` [m] apart, one in each cell of a grid on every piece of the surface, buried parts
  /// included. Only cells with near(centre, radius) get one. `near` is asked about balls around cells and around groups
  /// of cells.
  std::vector<SurfaceSample> draw_near(double spacing, std::uint32_t seed,
                                       const std::function<bool(const Eigen::Vector3d&, double)>& near) const;

  /// Returns 1 for each sample that separates inside from outside, else 0.
  std::vector<std::uint8_t> are_outer(std::span<const SurfaceSample> samples) const;

  /// Returns the sharp vertices, and points on the sharp edges at most `step` [m] apart. If there were (much) more than
  /// `most` of either, they are thinned out evenly.
  std::vector<SurfaceSample> sharp_samples(double step, std::uint32_t most) const;

 private:
  /// A place off the surface with its side.
  struct Known {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    double free_path = -1.0;  ///< length of straight paths that stay on the same side [m]
    bool outer = false;
    int winding = 0;  ///< winding number at the point, if the solids have no open boundary
  };
  /// A part of a piece of the surface.
  struct Cell {
    std::size_t piece;
    double u, v, size_u, size_v;  ///< in the unit square
  };
  struct CellDraws {
    double spacing;
    std::uint64_t seed;
    const std::function<bool(const Eigen::Vector3d&, double)>& near;
  };
  struct Draws {
    std::uint64_t count;
    std::uint64_t seed;
  };

  std::vector<SurfaceSample> draw(const Draws& draws, std::uint64_t begin, std::uint64_t end) const;
  void draw_outer(const Draws& draws, const parallel::Progress& progress, std::vector<SurfaceSample>& samples) const;
  void append_outer(const std::vector<SurfaceSample>& candidates, std::vector<SurfaceSample>& samples) const;
  void draw_cell(const Cell& cell, const CellDraws& draws, std::vector<SurfaceSample>& samples) const;
  bool is_outer(const SurfaceSample& sample, Known& known) const;
  SurfaceSample sharp_sample(const Eigen::Vector3d& at, const Eigen::Vector3d& outward, bool in_shell,
                             SurfaceSample::Place place) const;

  const SolidSurface& surface_;
  BodyMesh body_;
  SurfacePatches patches_;
  SharpFeatures sharp_;
  double step_;  // distance from the surface at which its sides are looked up [m]
};

}  // namespace godobject::scene_compiler
