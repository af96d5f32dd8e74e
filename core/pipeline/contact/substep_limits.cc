#include "core/pipeline/contact/substep_limits.h"

#include <algorithm>
#include <cmath>

#include "core/spatial/bounding_sphere.h"

namespace godobject::detail {

double first_search_radius(const ContactMemory& memory, const ProxyState& state, const Pose& H_WD,
                           const ContactLengths& lengths, double longest) noexcept {
  // measured (godobject-replay, the demo's paths): with 1.25 a second sub-step follows in 34 instead of 24 cycles over
  // the teapot; no bound saves at most 8 a path. The bound limits the look-ups of the cycle in which the device jumps.
  constexpr double kMost = 2.0;
  const double last = travel(lengths.sphere, memory.last_step.motion);
  const double device = state.started ? farthest_way(lengths.sphere, memory.H_WD_last, H_WD) : 0.0;
  const double expected = ContactLengths::kSearchRadiusOverDisplacement * std::max(last, device);
  return lengths.search_radius_for(std::min(expected, kMost * last), longest);
}

double allowed_share(const Motion& motion, const Surroundings& around, double search_radius,
                     const ContactLengths& lengths, bool constrained) noexcept {
  constexpr double kLargestTurn = 0.1;  // [rad] derived: the rows then neglect 5 % of a displacement
  const double turn = motion.rotation.norm();
  const double displacement = travel(lengths.sphere, motion);
  const double free = around.free_displacement;
  // a margin remains to points that are not near, or half of a free displacement that is less than two
  const double room = std::max(free - lengths.margin, 0.5 * free);
  double share = displacement > room ? room / displacement : 1.0;
  if (constrained) {
    // the rows neglect |r|^2 R_max / 2: the root limits that to half of the search radius
    const double largest = std::min(kLargestTurn, std::sqrt(search_radius / lengths.radius));
    if (share * turn > largest) share = largest / turn;
  }
  return share;
}

}  // namespace godobject::detail
