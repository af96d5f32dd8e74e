#include "core/pipeline/contact/contact_lengths.h"

#include <cmath>

namespace godobject {

ContactLengths ContactLengths::make(const Parameters& q) noexcept {
  ContactLengths lengths;
  lengths.margin = q.margin;
  lengths.wanted_margin = 0.8 * q.margin;
  lengths.least_margin = 0.25 * q.margin;
  lengths.rounding = std::min(1e-6 * q.voxel_size, 0.1 * lengths.least_margin);
  lengths.shortest_search_radius = shortest_search_radius_of(q);
  lengths.longest_search_radius = 1.5 * q.voxel_size;
  lengths.opening = 0.01 * q.voxel_size;
  lengths.largest_gain = 0.25 * q.voxel_size;
  lengths.radius = q.mass.radius;
  lengths.sphere = q.mass.sphere;
  lengths.point_budget = q.point_budget;
  lengths.metric.gyration = std::sqrt(q.coupling_rotation / q.coupling_translation);
  lengths.metric.tolerance = std::max(1e-3 * q.margin, 1e-6 * q.voxel_size);
  lengths.metric.still = 1e-6 * q.voxel_size;
  return lengths;
}

GapLaw ContactLengths::gap_law() const noexcept { return {margin, metric.tolerance, kRecovery, largest_gain}; }

}  // namespace godobject
