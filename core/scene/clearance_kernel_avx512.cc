#if defined(__x86_64__)

#include "core/scene/clearance_kernel_lanes.h"
#include "core/scene/lanes_avx512.h"

namespace godobject::detail {

void look_up_clearances_avx512(const FieldOfCells& field, const float* x, const float* y, const float* z,
                               float* clearance, std::uint32_t count) noexcept {
  look_up_lanes<Avx512>(field, x, y, z, clearance, count);
}

}  // namespace godobject::detail

#endif
