#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "toolchain/parallel/parallel.h"
#include "toolchain/scene_compiler/mesh/surface_sample.h"

namespace godobject::scene_compiler {

/// Radius of the discs when `count` of them are packed as densely as a plane `area` allows, each touching six [m]. In
/// no spread of `count` samples over the area are all further apart than twice this.
double densest_disc_radius(double area, std::uint32_t count);

/// Weighted sample elimination (Yuksel 2015): of the samples `chosen` (ascending indices), the one that is crowded most
/// goes, again and again, until `count` are left, spread like Poisson discs over `area` [m^2]. Returns their indices,
/// ascending. Eliminating further from the result gives a coarser level nested in it.
///
/// Two things beyond the paper. A sample yields only to those of its own place or a sharper one: sharp vertices and
/// edges are sampled as if there were no faces, and faces make room for them; so a box keeps its corners down to the
/// coarsest level. And samples on opposite sides of a thin body do not see each other (same_side).
///
/// `progress` gets 0 .. 1; may be empty. Deterministic. Cost: about 5 us for each of `chosen`.
std::vector<std::uint32_t> eliminate(std::span<const SurfaceSample> samples, std::vector<std::uint32_t> chosen,
                                     double area, std::uint32_t count, const parallel::Progress& progress);

/// 0, 1, .. count - 1.
std::vector<std::uint32_t> all_indices(std::size_t count);

/// The most hierarchy levels that `points` samples can have, and the fewest samples that `levels` need: from level to
/// level they grow by half at least, which keeps a sphere tree's nodes below twice the points.
std::uint32_t most_levels(std::uint32_t points);
std::uint32_t least_points(std::uint32_t levels);

/// Samples of level 1 .. levels: a geometric progression from 8 to `points`.
std::vector<std::uint32_t> level_sizes(std::uint32_t points, std::uint32_t levels);

/// Hierarchy levels of these `sizes` (ascending), each nested in the next by elimination; the last holds all samples.
/// As ascending indices.
std::vector<std::vector<std::uint32_t>> nested_levels(std::span<const SurfaceSample> samples,
                                                      const std::vector<std::uint32_t>& sizes, double area);

}  // namespace godobject::scene_compiler
