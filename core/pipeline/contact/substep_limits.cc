#include "core/pipeline/contact/substep_limits.h"

#include <algorithm>
#include <cmath>

#include "core/spatial/bounding_sphere.h"

namespace godobject::detail {

double first_search_radius(const ContactMemory& memory, const ProxyState& state, const Pose& H_WD,
                           const ContactLengths& lengths, double longest) noexcept {
  constexpr double kMost = 2.0;
  const double last = travel(lengths.sphere, memory.last_step.motion);
  const double device = state.started ? farthest_way(lengths.sphere, memory.H_WD_last, H_WD) : 0.0;
  const double expected = ContactLengths::kSearchRadiusOverDisplacement * std::max(last, device);
  return lengths.search_radius_for(std::min(expected, kMost * last), longest);
}

double allowed_share(const Motion& motion, const Surroundings& around, double search_radius,
                     const ContactLengths& lengths, bool constrained) noexcept {
  constexpr double kLargestTurn = 0.1;  // rad
  const double turn = motion.rotation.norm();
  const double displacement = travel(lengths.sphere, motion);
  const double room = std::max(around.left_out - lengths.margin, 0.5 * around.left_out);
  double share = displacement > room ? room / displacement : 1.0;
  if (constrained) {
    // the rows neglect |r|^2 R_max / 2, which stays within half of the search radius
    const double largest = std::min(kLargestTurn, std::sqrt(search_radius / lengths.radius));
    if (share * turn > largest) share = largest / turn;
  }
  return share;
}

}  // namespace godobject::detail
