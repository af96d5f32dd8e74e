#if defined(__aarch64__)

#include "core/scene/clearance_kernel_lanes.h"
#include "core/scene/lanes_neon.h"

namespace godobject::detail {

void look_up_clearances_neon(const FieldOfCells& field, const float* x, const float* y, const float* z,
                             float* clearance, std::uint32_t count) noexcept {
  look_up_lanes<Neon>(field, x, y, z, clearance, count);
}

}  // namespace godobject::detail

#endif
