#if defined(__x86_64__)

#include "core/scene/lanes_avx512.h"
#include "core/scene/sample_kernel_lanes.h"

namespace godobject::detail {

std::uint32_t look_up_samples_avx512(const FieldOfNodes& field, SampleBatch& batch, std::uint32_t first) noexcept {
  return sample_lanes<Avx512>(field, batch, first);
}

}  // namespace godobject::detail

#endif
