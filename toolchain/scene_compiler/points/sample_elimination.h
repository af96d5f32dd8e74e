#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "toolchain/parallel/parallel.h"
#include "toolchain/scene_compiler/mesh/surface_sample.h"

namespace godobject::scene_compiler {

/// Returns the radius of `count` discs packed as densely as a plane `area` allows, each touching six others [m]. No
/// spread of `count` samples over the area has all of them farther apart than twice this.
double densest_disc_radius(double area, std::uint32_t count);

/// Weighted sample elimination (Yuksel 2015). Removes the most crowded of the samples `chosen` (ascending indices),
/// again and again, until `count` remain, spread like Poisson discs over `area` [m^2]. Returns their indices,
/// ascending. Elimination from the result gives a coarser level nested in it.
///
/// Two rules are not in the paper. A sample yields only to samples of its own kind of feature or a sharper one. So
/// sharp vertices and edges are sampled as if there were no faces, and a box keeps its corners down to the coarsest
/// level. And samples on opposite sides of a thin body do not crowd each other (same_side).
///
/// `progress` gets 0 .. 1 and may be empty. Deterministic. Cost: about 5 us for each of `chosen`.
std::vector<std::uint32_t> eliminate(std::span<const SurfaceSample> samples, std::vector<std::uint32_t> chosen,
                                     double area, std::uint32_t count, const parallel::Progress& progress);

/// Returns 0, 1, .. count - 1.
std::vector<std::uint32_t> all_indices(std::size_t count);

/// Return the most hierarchy levels that `points` samples can have, and the fewest samples that `levels` need. Each
/// level has at least 1.5 times as many samples as the one before. That limits a sphere tree's nodes to twice the
/// points.
std::uint32_t most_levels(std::uint32_t points);
std::uint32_t least_points(std::uint32_t levels);

/// Returns the number of samples of level 1 .. levels: a geometric progression from 8 to `points`.
std::vector<std::uint32_t> level_sizes(std::uint32_t points, std::uint32_t levels);

/// Returns hierarchy levels of these `sizes` (ascending) as ascending indices. Each is nested in the next by
/// elimination. The last one contains all samples.
std::vector<std::vector<std::uint32_t>> nested_levels(std::span<const SurfaceSample> samples,
                                                      const std::vector<std::uint32_t>& sizes, double area);

}  // namespace godobject::scene_compiler
