#include "core/scene/sample_bits.h"

#include "core/vector_widths.h"

namespace godobject {
namespace {

constexpr std::uint32_t kSamplesAtOnce = SampleBatch::kAtOnce;
using Doubles __attribute__((vector_size(8 * kSamplesAtOnce))) = double;
using Longs __attribute__((vector_size(8 * kSamplesAtOnce))) = std::int64_t;
constexpr Longs kFirstSamples = {1, 2, 4, 8};

}  // namespace

// in one expression: no vector is passed to or from a function, whose way of passing it may differ
#define GODOBJECT_AT(component) (*reinterpret_cast<const Doubles*>(batch.component + i))
#define GODOBJECT_BITS_OF(holds)                                                             \
  Longs bits = {};                                                                           \
  Longs here = kFirstSamples;                                                                \
  for (std::uint32_t i = 0; i < batch.count; i += kSamplesAtOnce, here <<= kSamplesAtOnce) { \
    bits |= (holds)&here;                                                                    \
  }                                                                                          \
  return static_cast<std::uint64_t>(bits[0] | bits[1] | bits[2] | bits[3]);

GODOBJECT_VECTOR_WIDTHS
std::uint64_t clearance_below(const SampleBatch& batch,
                              double bound) noexcept {GODOBJECT_BITS_OF(GODOBJECT_AT(clearance) < bound)}

GODOBJECT_VECTOR_WIDTHS std::uint64_t keeps_distance(const SampleBatch& batch, double kept, double rounding) noexcept {
    GODOBJECT_BITS_OF((GODOBJECT_AT(distance) > 0.0) &
                      ((GODOBJECT_AT(distance) + rounding >= kept) |
                       (GODOBJECT_AT(distance) + rounding >= GODOBJECT_AT(from_distance))))}

GODOBJECT_VECTOR_WIDTHS std::uint64_t steeper(const SampleBatch& batch, double gradient) noexcept {
  const double squared = gradient * gradient;
  GODOBJECT_BITS_OF(GODOBJECT_AT(gradient_x) * GODOBJECT_AT(gradient_x) +
                        GODOBJECT_AT(gradient_y) * GODOBJECT_AT(gradient_y) +
                        GODOBJECT_AT(gradient_z) * GODOBJECT_AT(gradient_z) >
                    squared)
}

#undef GODOBJECT_BITS_OF
#undef GODOBJECT_AT

}  // namespace godobject
