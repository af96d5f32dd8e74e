#pragma once

#include <cstdint>
#include <vector>

#include "toolchain/parallel/parallel.h"
#include "toolchain/scene_compiler/mesh/outer_surface.h"
#include "toolchain/scene_compiler/mesh/surface_sample.h"
#include "toolchain/scene_compiler/points/between_points.h"
#include "toolchain/scene_compiler/points/moving_body.h"

namespace godobject::scene_compiler {

/// The moving body gets no more than this many points for each that was asked for.
inline constexpr std::uint32_t kMostPointsForOne = 4;
inline constexpr std::uint32_t kMostFeatures = 1u << 15;

/// What makes contact in both directions see all that is deeper than a wanted bound.
struct BothDirections {
  std::vector<SurfaceSample> features;  ///< points of the still body, in W
  double area = 0.0;                    ///< of the still body's outer surface [m^2]
  std::uint32_t added_points = 0;       ///< of the moving body, beyond those asked for
  BetweenPoints between;                ///< what was reached
};

/// Adds points to `sampling` where the moving surface is sharp or bends, and chooses features of the still one, until
/// between_points.h bounds what no point sees by `wanted` [m], or the most points are spent: `between` says what was
/// reached. Deterministic. `progress` gets 0 .. 1; may be empty.
BothDirections see_both_directions(const OuterSurface& still, const OuterSurface& moving, double wanted,
                                   MovingSampling& sampling, const parallel::Progress& progress);

}  // namespace godobject::scene_compiler
