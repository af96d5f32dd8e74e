#include "core/pipeline/contact_rows.h"

#include <cfloat>

// One version for each width of the processor's vectors, chosen when the program is loaded. No fused products (see
// CMakeLists.txt): all versions give the same bits.
#if defined(__x86_64__) && defined(__gnu_linux__)
#define GODOBJECT_VECTOR_WIDTHS __attribute__((target_clones("arch=haswell", "default")))
#else
#define GODOBJECT_VECTOR_WIDTHS
#endif

namespace godobject {
namespace {

constexpr std::uint32_t kLanes = 8;
constexpr std::uint32_t kBlock = 64;
using Lanes __attribute__((vector_size(kLanes * sizeof(float)))) = float;

struct Largest {
  float violation;
  std::uint32_t block;  ///< first row of those among which it is
};

float violation(const ContactRows& rows, std::uint32_t i, const float (&m)[6]) noexcept {
  return rows.need[i] - (m[0] * rows.normal_x[i] + m[1] * rows.normal_y[i] + m[2] * rows.normal_z[i] +
                         m[3] * rows.torque_x[i] + m[4] * rows.torque_y[i] + m[5] * rows.torque_z[i]);
}

/// Over the first `count` rows, a multiple of kLanes.
GODOBJECT_VECTOR_WIDTHS
Largest largest_violation(const ContactRows& rows, std::uint32_t count, const float (&m)[6]) noexcept {
  Largest found{-FLT_MAX, 0};
  for (std::uint32_t begin = 0; begin < count; begin += kBlock) {
    const std::uint32_t end = begin + kBlock < count ? begin + kBlock : count;
    Lanes most = {-FLT_MAX, -FLT_MAX, -FLT_MAX, -FLT_MAX, -FLT_MAX, -FLT_MAX, -FLT_MAX, -FLT_MAX};
    for (std::uint32_t i = begin; i < end; i += kLanes) {
      // in one expression: no vector is passed to or from a function, whose way of passing it may differ
#define GODOBJECT_AT(component) (*reinterpret_cast<const Lanes*>(rows.component + i))
      const Lanes here = GODOBJECT_AT(need) - (m[0] * GODOBJECT_AT(normal_x) + m[1] * GODOBJECT_AT(normal_y) +
                                               m[2] * GODOBJECT_AT(normal_z) + m[3] * GODOBJECT_AT(torque_x) +
                                               m[4] * GODOBJECT_AT(torque_y) + m[5] * GODOBJECT_AT(torque_z));
#undef GODOBJECT_AT
      most = here > most ? here : most;
    }
    float largest = most[0];
    for (std::uint32_t lane = 1; lane < kLanes; ++lane) largest = most[lane] > largest ? most[lane] : largest;
    if (largest > found.violation) found = {largest, begin};
  }
  return found;
}

}  // namespace

ContactRows::Violated ContactRows::most_violated(const Motion& motion, double tolerance) const noexcept {
  const float m[6] = {static_cast<float>(motion.translation.x()), static_cast<float>(motion.translation.y()),
                      static_cast<float>(motion.translation.z()), static_cast<float>(motion.rotation.x()),
                      static_cast<float>(motion.rotation.y()),    static_cast<float>(motion.rotation.z())};
  const std::uint32_t even = count - count % kLanes;
  Largest largest = largest_violation(*this, even, m);
  Violated found;
  for (std::uint32_t i = even; i < count; ++i) {
    const float here = violation(*this, i, m);
    if (!(here > largest.violation)) continue;
    largest.violation = here;
    found.row = i;
  }
  found.violation = static_cast<double>(largest.violation);
  if (!(found.violation > tolerance)) {
    found.row = kNone;
  } else if (found.row == kNone) {
    found.row = largest.block;
    float most = -FLT_MAX;
    for (std::uint32_t i = largest.block; i < largest.block + kBlock && i < even; ++i) {
      const float here = violation(*this, i, m);
      if (!(here > most)) continue;
      most = here;
      found.row = i;
    }
  }
  return found;
}

}  // namespace godobject
