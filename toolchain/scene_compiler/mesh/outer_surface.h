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

/// The outer boundary of a body, to be sampled: the pieces of its surface that part inside from outside, without what
/// is buried in another component.
class OuterSurface {
 public:
  struct Spread {
    std::vector<SurfaceSample> samples;
    double area = 0.0;  ///< of the outer surface [m^2], estimated from the part of the draws that lay on it
  };

  /// Reads `surface` later on: it must stay alive.
  explicit OuterSurface(const SolidSurface& surface);

  const SolidSurface& surface() const { return surface_; }
  const BodyMesh& body() const { return body_; }
  double area() const { return patches_.area(); }  ///< of the whole surface, buried parts included [m^2]

  /// About `wanted` samples or more, random and stratified by area; another `seed` gives others. `progress` gets 0 ..
  /// 1; may be empty. Cost: a winding number a draw. Throws std::runtime_error if (nearly) nothing of the mesh is outer
  /// surface.
  Spread spread(std::uint32_t wanted, std::uint32_t seed, const parallel::Progress& progress) const;

  /// `count` draws of the whole surface, buried parts included, for who needs to know only of some whether they are
  /// outer.
  std::vector<SurfaceSample> draw_all(std::uint32_t count, std::uint32_t seed) const;

  /// Draws about `spacing` [m] apart, one in each cell of a grid on every piece of the surface, buried parts included,
  /// where `near(centre, radius)` is true for the ball around a cell or around cells that hold it.
  std::vector<SurfaceSample> draw_near(double spacing, std::uint32_t seed,
                                       const std::function<bool(const Eigen::Vector3d&, double)>& near) const;

  /// Whether each sample parts inside from outside: 1 or 0.
  std::vector<std::uint8_t> are_outer(std::span<const SurfaceSample> samples) const;

  /// The sharp vertices, and points on the sharp edges at most `step` [m] apart, but not (much) more than `most` of
  /// either: too many are thinned out evenly.
  std::vector<SurfaceSample> sharp_samples(double step, std::uint32_t most) const;

 private:
  /// A place off the surface whose side is known.
  struct Known {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    double reach = -1.0;  ///< of straight ways to places of the same side [m]
    bool outer = false;
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
  double step_;  // off the surface, to see what is on its sides [m]
};

}  // namespace godobject::scene_compiler
