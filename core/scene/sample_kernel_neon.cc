#if defined(__aarch64__)

#include "core/scene/chord_kernel_lanes.h"
#include "core/scene/lanes_neon.h"
#include "core/scene/sample_kernel_lanes.h"

namespace godobject::detail {

std::uint32_t look_up_samples_neon(const FieldOfNodes& field, SampleBatch& batch, std::uint32_t first,
                                   LanesWithFacets& with_facets) noexcept {
  return sample_lanes<Neon>(field, batch, first, with_facets);
}

std::uint32_t free_chords_neon(const FieldOfNodes& field, const ChordEnds& ends, const SampleBatch& batch,
                               std::uint32_t first) noexcept {
  return chord_lanes<Neon>(field, ends, batch, first);
}

}  // namespace godobject::detail

#endif
