#include "core/pipeline/contact/search/near_points.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "core/scene/sample_bits.h"
#include "core/vector_widths.h"

namespace godobject {
namespace {

constexpr std::uint32_t kPointsAtOnce = NearPoints::kAtOnce;
using Floats __attribute__((vector_size(4 * kPointsAtOnce))) = float;
using Doubles __attribute__((vector_size(8 * kPointsAtOnce))) = double;
using Longs __attribute__((vector_size(8 * kPointsAtOnce))) = std::int64_t;
constexpr Longs kFirstPoints = {1, 2, 4, 8};

/// NearPoints::leave_their_ball for the points from `begin` to `end`. `change`: the turn, row by row; the last column
/// is the shift [m].
GODOBJECT_VECTOR_WIDTHS
std::uint64_t leaving(const NearPoints& near, std::uint32_t begin, std::uint32_t end, const double (&change)[3][4],
                      double gap) noexcept {
  Longs bits = {};
  Longs here = kFirstPoints;
  for (std::uint32_t i = begin; i < end; i += kPointsAtOnce, here <<= kPointsAtOnce) {
    // versions of a function may pass vectors differently, so none is passed to or from a function
    const Doubles x = __builtin_convertvector(*reinterpret_cast<const Floats*>(near.x + i), Doubles);
    const Doubles y = __builtin_convertvector(*reinterpret_cast<const Floats*>(near.y + i), Doubles);
    const Doubles z = __builtin_convertvector(*reinterpret_cast<const Floats*>(near.z + i), Doubles);
    const Doubles dx = change[0][0] * x + change[0][1] * y + change[0][2] * z + change[0][3];
    const Doubles dy = change[1][0] * x + change[1][1] * y + change[1][2] * z + change[1][3];
    const Doubles dz = change[2][0] * x + change[2][1] * y + change[2][2] * z + change[2][3];
    const Doubles squared = dx * dx + dy * dy + dz * dz;
    const Doubles room = *reinterpret_cast<const Doubles*>(near.clearance + i) - gap;
    const Longs held = (room >= 0.0) & (squared <= room * room);
    const Longs inside = *reinterpret_cast<const Doubles*>(near.distance + i) <= 0.0;
    bits |= ~inside & ~held & here;
  }
  return static_cast<std::uint64_t>(bits[0] | bits[1] | bits[2] | bits[3]);
}

/// NearPoints::end_below for the points from `begin` to `end`. `change` as for `leaving`.
GODOBJECT_VECTOR_WIDTHS
std::uint64_t ending_below(const NearPoints& near, std::uint32_t begin, std::uint32_t end, const double (&change)[3][4],
                           double gap) noexcept {
  Longs bits = {};
  Longs here = kFirstPoints;
  for (std::uint32_t i = begin; i < end; i += kPointsAtOnce, here <<= kPointsAtOnce) {
#define GODOBJECT_OF(component) __builtin_convertvector(*reinterpret_cast<const Floats*>(near.component + i), Doubles)
    const Doubles x = GODOBJECT_OF(x);
    const Doubles y = GODOBJECT_OF(y);
    const Doubles z = GODOBJECT_OF(z);
    const Doubles dx = change[0][0] * x + change[0][1] * y + change[0][2] * z + change[0][3];
    const Doubles dy = change[1][0] * x + change[1][1] * y + change[1][2] * z + change[1][3];
    const Doubles dz = change[2][0] * x + change[2][1] * y + change[2][2] * z + change[2][3];
    const Doubles grows = dx * GODOBJECT_OF(gradient_x) + dy * GODOBJECT_OF(gradient_y) + dz * GODOBJECT_OF(gradient_z);
#undef GODOBJECT_OF
    const Longs below = *reinterpret_cast<const Doubles*>(near.distance + i) + grows < gap;
    bits |= below & here;
  }
  return static_cast<std::uint64_t>(bits[0] | bits[1] | bits[2] | bits[3]);
}

/// Writes the turn, row by row, and the shift as the last column.
void write_change(const Matrix3& turn, const Vector3& shift, double (&change)[3][4]) noexcept {
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) change[row][column] = turn(row, column);
    change[row][3] = shift[row];
  }
}

/// Returns the smallest distance of the first `count` points, a multiple of kPointsAtOnce.
GODOBJECT_VECTOR_WIDTHS
double least_distance_of(const NearPoints& near, std::uint32_t count) noexcept {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Doubles least = {kInfinity, kInfinity, kInfinity, kInfinity};
  for (std::uint32_t i = 0; i < count; i += kPointsAtOnce) {
    const Doubles here = *reinterpret_cast<const Doubles*>(near.distance + i);
    least = here < least ? here : least;
  }
  return std::min({least[0], least[1], least[2], least[3]});
}

}  // namespace

std::uint64_t NearPoints::push_bounds(const std::uint32_t* numbers, const PointBatch& batch,
                                      std::uint64_t chosen) noexcept {
  std::uint32_t i = count;
  std::uint64_t left = chosen;
  for (; left != 0 && i < kMostBounded; left &= left - 1, ++i) {
    const auto k = static_cast<std::uint32_t>(std::countr_zero(left));
    index[i] = numbers[k];
    x[i] = batch.x[k];
    y[i] = batch.y[k];
    z[i] = batch.z[k];
    distance[i] = clearance[i] = static_cast<double>(batch.clearance[k]);
  }
  std::fill(gradient_x + count, gradient_x + i, 0.0f);
  std::fill(gradient_y + count, gradient_y + i, 0.0f);
  std::fill(gradient_z + count, gradient_z + i, 0.0f);
  count = bounded = i;
  return chosen & ~left;
}

double NearPoints::least_distance() const noexcept {
  const std::uint32_t even = count - count % kPointsAtOnce;
  double found = least_distance_of(*this, even);
  for (std::uint32_t i = even; i < count; ++i) found = std::min(found, distance[i]);
  return found;
}

std::uint64_t NearPoints::leave_their_ball(std::uint32_t first, const Matrix3& turn, const Vector3& shift,
                                           double gap) const noexcept {
  double change[3][4];
  write_change(turn, shift, change);
  const std::uint32_t end = std::min(count, first + 64);
  return leaving(*this, first, end, change, gap) & first_bits(end - first);
}

std::uint64_t NearPoints::end_below(std::uint32_t first, const Matrix3& turn, const Vector3& shift,
                                    double gap) const noexcept {
  double change[3][4];
  write_change(turn, shift, change);
  const std::uint32_t end = std::min(count, first + 64);
  return ending_below(*this, first, end, change, gap) & first_bits(end - first);
}

}  // namespace godobject
