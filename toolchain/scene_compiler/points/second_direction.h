#pragma once

#include <cstdint>
#include <vector>

#include "toolchain/parallel/parallel.h"
#include "toolchain/scene_compiler/mesh/outer_surface.h"
#include "toolchain/scene_compiler/mesh/surface_sample.h"
#include "toolchain/scene_compiler/points/between_points.h"
#include "toolchain/scene_compiler/points/moving_body.h"

namespace godobject::scene_compiler {

/// Limits: points of the moving body for each requested one, and features of the still body. Chosen: they bound the
/// time of a cycle and the memory of the search.
inline constexpr std::uint32_t kMostPointsForOne = 4;
inline constexpr std::uint32_t kMostFeatures = 1u << 15;

/// Points for contact in both directions, with which the bodies overlap by no more than a wanted bound between points.
struct BothDirections {
  std::vector<SurfaceSample> features;  ///< of the still body, in W
  double area = 0.0;                    ///< of the still body's outer surface [m^2]
  std::uint32_t added_points = 0;       ///< of the moving body, beyond those requested
  BetweenPoints between;                ///< the bound that holds
};

/// Adds points to `sampling` where the moving surface is sharp or bends, and chooses features of the still one, until
/// between_points.h proves the bound `wanted` [m] or a limit is met. `between` tells the bound that holds and why the
/// search ended. Deterministic. `progress` gets 0 .. 1 and may be empty.
BothDirections see_both_directions(const OuterSurface& still, const OuterSurface& moving, double wanted,
                                   MovingSampling& sampling, const parallel::Progress& progress);

}  // namespace godobject::scene_compiler
