#include "core/pipeline/contact/qp/contact_rows.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "core/vector_widths.h"

namespace godobject {
namespace {

constexpr std::uint32_t kLanes = 8;
constexpr std::uint32_t kBlock = 64;
using Lanes __attribute__((vector_size(kLanes * sizeof(float)))) = float;
using Ids __attribute__((vector_size(kLanes * sizeof(float)))) = std::uint32_t;
using Found __attribute__((vector_size(kLanes * sizeof(float)))) = std::int32_t;

/// The largest violation in a scan.
struct Largest {
  float violation;      ///< [m]
  std::uint32_t block;  ///< first row of the block that contains it
};

/// Returns the violation of row `i` [m]; m: the motion (x, r).
float violation(const ContactRows& rows, std::uint32_t i, const float (&m)[6]) noexcept {
  return rows.required_gain[i] - (m[0] * rows.normal_x[i] + m[1] * rows.normal_y[i] + m[2] * rows.normal_z[i] +
                                  m[3] * rows.torque_x[i] + m[4] * rows.torque_y[i] + m[5] * rows.torque_z[i]);
}

/// Returns the largest violation of the first `count` rows, a multiple of kLanes.
GODOBJECT_VECTOR_WIDTHS
Largest largest_violation(const ContactRows& rows, std::uint32_t count, const float (&m)[6]) noexcept {
  Largest found{-FLT_MAX, 0};
  for (std::uint32_t begin = 0; begin < count; begin += kBlock) {
    const std::uint32_t end = begin + kBlock < count ? begin + kBlock : count;
    Lanes most = {-FLT_MAX, -FLT_MAX, -FLT_MAX, -FLT_MAX, -FLT_MAX, -FLT_MAX, -FLT_MAX, -FLT_MAX};
    for (std::uint32_t i = begin; i < end; i += kLanes) {
      // one expression: versions of a function may pass vectors differently, so none is passed to or from a function
#define GODOBJECT_AT(component) (*reinterpret_cast<const Lanes*>(rows.component + i))
      const Lanes here = GODOBJECT_AT(required_gain) - (m[0] * GODOBJECT_AT(normal_x) + m[1] * GODOBJECT_AT(normal_y) +
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

constexpr std::uint32_t kContacts = 4;  // that are appended together
using Doubles __attribute__((vector_size(kContacts * sizeof(double)))) = double;
using Narrow __attribute__((vector_size(kContacts * sizeof(float)))) = float;

/// Writes the batch's contacts as rows from `at` on, and up to kContacts - 1 meaningless ones behind them. `m`: matrix
/// from the batch's gradients to S, row by row.
GODOBJECT_VECTOR_WIDTHS
void append(const ContactRows::Batch& batch, std::uint32_t count, const double (&m)[9], const GapLaw& gap,
            ContactRows& rows, std::uint32_t at) noexcept {
  for (std::uint32_t i = 0; i < count; i += kContacts) {
#define GODOBJECT_OF(component) (*reinterpret_cast<const Doubles*>(batch.component + i))
#define GODOBJECT_SET(component, value)                                 \
  {                                                                     \
    const Narrow narrow = __builtin_convertvector(value, Narrow);       \
    __builtin_memcpy(rows.component + at + i, &narrow, sizeof(narrow)); \
  }
    const Doubles fx = GODOBJECT_OF(gradient_x), fy = GODOBJECT_OF(gradient_y), fz = GODOBJECT_OF(gradient_z);
    const Doubles gx = m[0] * fx + m[1] * fy + m[2] * fz;
    const Doubles gy = m[3] * fx + m[4] * fy + m[5] * fz;
    const Doubles gz = m[6] * fx + m[7] * fy + m[8] * fz;
    const Doubles squared = gx * gx + gy * gy + gz * gz;
    Doubles steepness;
    for (std::uint32_t lane = 0; lane < kContacts; ++lane) steepness[lane] = std::sqrt(squared[lane]);
    const Doubles flatness = 1.0 / steepness;
    const Doubles nx = flatness * gx, ny = flatness * gy, nz = flatness * gz;
    const Doubles lost = flatness * (gap.margin - GODOBJECT_OF(distance));
    const Doubles share = gap.recovery * lost;
    const Doubles regained = share < gap.largest_gain ? share : gap.largest_gain + Doubles{};
    const Doubles spare = lost < -gap.tolerance ? lost : Doubles{};
    const Doubles px = GODOBJECT_OF(point_x), py = GODOBJECT_OF(point_y), pz = GODOBJECT_OF(point_z);
    GODOBJECT_SET(normal_x, nx)
    GODOBJECT_SET(normal_y, ny)
    GODOBJECT_SET(normal_z, nz)
    GODOBJECT_SET(torque_x, (py * nz - pz * ny))
    GODOBJECT_SET(torque_y, (pz * nx - px * nz))
    GODOBJECT_SET(torque_z, (px * ny - py * nx))
    GODOBJECT_SET(point_x, px)
    GODOBJECT_SET(point_y, py)
    GODOBJECT_SET(point_z, pz)
    GODOBJECT_SET(required_gain, (lost > gap.tolerance ? regained : spare))
#undef GODOBJECT_SET
#undef GODOBJECT_OF
  }
}

/// Returns the first row of the first block of kBlock rows from `begin` on that contains the id; if there is none, the
/// end of the last full block.
GODOBJECT_VECTOR_WIDTHS
std::uint32_t block_of(const ContactRows& rows, std::uint32_t point_id, std::uint32_t begin) noexcept {
  for (; begin + kBlock <= rows.count; begin += kBlock) {
    Found found = {};
    for (std::uint32_t i = begin; i < begin + kBlock; i += kLanes) {
      Ids ids;
      __builtin_memcpy(&ids, rows.id + i, sizeof(ids));
      found |= ids == point_id;
    }
    std::int32_t any = 0;
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) any |= found[lane];
    if (any != 0) break;
  }
  return begin;
}

}  // namespace

std::uint32_t ContactRows::push(Batch& batch, const Matrix3& S_to_gradient, const GapLaw& gap) noexcept {
  const std::uint32_t pushed = std::min(batch.count, kCapacity - count);
  double to_S[9];
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) to_S[3 * row + column] = S_to_gradient(column, row);
  }
  for (std::uint32_t i = batch.count; i % kContacts != 0; ++i) {
    batch.point_x[i] = batch.point_y[i] = batch.point_z[i] = batch.distance[i] = 0.0;
    batch.gradient_x[i] = batch.gradient_y[i] = batch.gradient_z[i] = 1.0;
  }
  append(batch, pushed, to_S, gap, *this, count);
  std::copy_n(batch.id, pushed, id + count);
  count += pushed;
  return batch.count - pushed;
}

void ContactRows::remove(std::uint32_t i) noexcept {
  const std::uint32_t last = --count;
  for (float* component :
       {normal_x, normal_y, normal_z, torque_x, torque_y, torque_z, required_gain, point_x, point_y, point_z}) {
    component[i] = component[last];
  }
  id[i] = id[last];
}

std::uint32_t ContactRows::find(std::uint32_t point_id, std::uint32_t begin) const noexcept {
  std::uint32_t i = block_of(*this, point_id, begin);
  while (i < count && id[i] != point_id) ++i;
  return i;
}

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
