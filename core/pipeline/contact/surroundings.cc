#include "core/pipeline/contact/surroundings.h"

#include <cmath>

namespace godobject::detail {

Selection select_rows(ContactWorkspace& workspace) noexcept {
  constexpr std::uint32_t kDeepest = ContactRows::kCapacity / 2;
  std::uint32_t count = 0;
  for (const auto* near : {&workspace.samples, &workspace.features}) {
    for (std::uint32_t k = 0; k < near->count; ++k) {
      if (!near->is_bound_only(k)) workspace.distances[count++] = static_cast<float>(near->distance[k]);
    }
  }
  if (count <= ContactRows::kCapacity) return {std::numeric_limits<double>::infinity(), 1};
  float* const begin = workspace.distances.data();
  std::nth_element(begin, begin + kDeepest, begin + count);
  // strictly below: equal distances, as on a flat face, are taken by stride
  const double deepest = static_cast<double>(std::nextafter(begin[kDeepest], -std::numeric_limits<float>::infinity()));
  const std::uint32_t room = kDeepest / 2;
  return {deepest, (count + room - 1) / room};
}

}  // namespace godobject::detail
