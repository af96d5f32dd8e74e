#if defined(__x86_64__)

#include "core/scene/chord_kernel_lanes.h"
#include "core/scene/lanes_avx512.h"
#include "core/scene/sample_kernel_lanes.h"

namespace godobject::detail {

std::uint32_t look_up_samples_avx512(const FieldOfNodes& field, SampleBatch& batch, std::uint32_t first,
                                     LanesWithFacets& with_facets) noexcept {
  return sample_lanes<Avx512>(field, batch, first, with_facets);
}

std::uint32_t free_chords_avx512(const FieldOfNodes& field, const ChordEnds& ends, const SampleBatch& batch,
                                 std::uint32_t first) noexcept {
  return chord_lanes<Avx512>(field, ends, batch, first);
}

}  // namespace godobject::detail

#endif
