#if defined(__aarch64__)

#include <arm_neon.h>

#include "core/scene/clearance_kernel_lanes.h"

namespace godobject::detail {
namespace {

struct Neon {
  static constexpr std::uint32_t kLanes = 4;
  using Floats __attribute__((vector_size(4 * kLanes))) = float;
  using Ints __attribute__((vector_size(4 * kLanes))) = std::int32_t;

  /// There are no gathers: one load a lane.
  static Floats gather(const float* from, Ints at) noexcept {
    return Floats{from[at[0]], from[at[1]], from[at[2]], from[at[3]]};
  }
  static Ints gather(const std::uint32_t* from, Ints at) noexcept {
    const auto load = [&](int lane) noexcept { return static_cast<std::int32_t>(from[at[lane]]); };
    return Ints{load(0), load(1), load(2), load(3)};
  }
  static Ints truncated(Floats x) noexcept { return vcvtq_s32_f32(x); }
  static Floats root(Floats x) noexcept { return vsqrtq_f32(x); }
  static Floats larger(Floats a, Floats b) noexcept { return vmaxnmq_f32(a, b); }
  static Floats smaller(Floats a, Floats b) noexcept { return vminnmq_f32(a, b); }
};

}  // namespace

void look_up_clearances_neon(const FieldOfCells& field, const float* x, const float* y, const float* z,
                             float* clearance, std::uint32_t count) noexcept {
  look_up_lanes<Neon>(field, x, y, z, clearance, count);
}

}  // namespace godobject::detail

#endif
