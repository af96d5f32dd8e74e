#include "core/pipeline/contact/contact_lengths.h"

#include <cmath>

namespace godobject {

// "Measured" is: by godobject-replay on the demo's paths, with and without friction; instructions by
// tests/bench/instructions.
ContactLengths ContactLengths::make(const Parameters& q) noexcept {
  ContactLengths lengths;
  lengths.margin = q.margin;
  // measured: 0.5 and 0.95 end with gaps of 10 and 7 um instead of 16 um in the handle
  lengths.wanted_margin = 0.8 * q.margin;
  // measured: with 0.1 the gap falls to 0.9 um instead of 4 um in the peg's hole; 0.5 changes no replay
  lengths.least_margin = 0.25 * q.margin;
  // derived: interpolation in single precision rounds by 6e-8 of some voxels
  lengths.rounding = std::min(1e-6 * q.voxel_size, 0.1 * lengths.least_margin);
  // measured: 0.03 s takes 43 % fewer instructions in the peg's hole, but a second sub-step follows in 315 instead of
  // 243 cycles there; 0.5 s takes 4.5 times the instructions
  lengths.shortest_search_radius = 0.125 * q.voxel_size;
  // measured: 1 takes up to half a percent more sub-steps through the plate, 2.5 takes 2 % more instructions in the
  // hole
  lengths.longest_search_radius = 1.5 * q.voxel_size;
  // measured: with 0.001 a second sub-step follows in 58 instead of 24 cycles over the teapot; with 0.1 the rows
  // overflow in 37 instead of 14 cycles in the hole
  lengths.opening = 0.01 * q.voxel_size;
  // chosen: it limits only the way out after a start inside; 0.05 and 1 change no replay
  lengths.largest_gain = 0.25 * q.voxel_size;
  // chosen: longer than the overlap of assembled parts; it bounds the force on the hand, 1 N at the defaults
  lengths.longest_way_out = 0.25 * q.voxel_size;
  lengths.deepest_overlap = q.voxel_size;  // chosen: the compiler tells of thinner walls
  lengths.radius = q.mass.radius;
  lengths.sphere = q.mass.sphere;
  lengths.point_budget = q.point_budget;
  lengths.metric.gyration = std::sqrt(q.coupling_rotation / q.coupling_translation);
  // chosen, and not below the rounding
  lengths.metric.tolerance = std::max(1e-3 * q.margin, 1e-6 * q.voxel_size);
  // derived: rounding of stored distances
  lengths.metric.still = 1e-6 * q.voxel_size;
  return lengths;
}

GapLaw ContactLengths::gap_law() const noexcept { return {margin, metric.tolerance, kRecovery, largest_gain}; }

}  // namespace godobject
