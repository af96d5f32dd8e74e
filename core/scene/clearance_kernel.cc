#include "core/scene/clearance_kernel.h"

#include <algorithm>
#include <cmath>

namespace godobject::detail {
namespace {

using format::kBrickCells;
using format::kBrickNodes;
namespace index_entry = format::index_entry;

/// Returns the clearance of a point outside of the grid, from its distance to the surface's box [m]. g: point [cells].
float clearance_outside(const FieldOfCells& f, const float (&g)[3]) noexcept {
  float squared = 0.0f;
  for (int axis = 0; axis < 3; ++axis) {
    const float away = std::max({f.surface_min[axis] - g[axis], g[axis] - f.surface_max[axis], 0.0f});
    squared += away * away;
  }
  return std::max(f.assured, f.cell_edge * (std::sqrt(squared) - f.outside_off));
}

/// Returns the clearance of a point in the grid [m]. g: point [cells].
float clearance_within(const FieldOfCells& f, const float (&g)[3]) noexcept {
  const std::int32_t i[3] = {static_cast<std::int32_t>(g[0]), static_cast<std::int32_t>(g[1]),
                             static_cast<std::int32_t>(g[2])};
  const std::uint32_t entry =
      f.index[(i[0] >> kBrickShift) + f.stride_y * (i[1] >> kBrickShift) + f.stride_z * (i[2] >> kBrickShift)];
  if ((entry & index_entry::kFar) != 0) {
    if ((entry & index_entry::kInside) != 0) return 0.0f;
    float squared = 0.0f;
    for (int axis = 0; axis < 3; ++axis) {
      const float from_center = g[axis] - (static_cast<float>(i[axis] & ~(kBrickCells - 1)) + kBrickCenter);
      squared += from_center * from_center;
    }
    return std::max(f.assured, index_entry::far_clearance(entry) - kLengthRoundedUp * f.cell_edge * std::sqrt(squared));
  }
  std::uint32_t number = entry & index_entry::kNumber;
  if ((entry & index_entry::kRefined) != 0) number = f.refined[kRefinedWords * number];
  constexpr int kCell = kBrickCells - 1;
  constexpr int kY = kBrickNodes;
  constexpr int kZ = kBrickNodes * kBrickNodes;
  const std::int16_t* const brick = f.bricks + static_cast<std::size_t>(number) * kBrickWords;
  const std::int16_t* const v = brick + (i[0] & kCell) + kY * (i[1] & kCell) + kZ * (i[2] & kCell);
  const auto between_x = [&](int node) {
    const auto at = static_cast<float>(v[node]);
    return at + (g[0] - static_cast<float>(i[0])) * (static_cast<float>(v[node + 1]) - at);
  };
  const float fy = g[1] - static_cast<float>(i[1]);
  const float fz = g[2] - static_cast<float>(i[2]);
  const float x00 = between_x(0);
  const float x10 = between_x(kY);
  const float x01 = between_x(kZ);
  const float x11 = between_x(kZ + kY);
  const float y0 = x00 + fy * (x10 - x00);
  const float y1 = x01 + fy * (x11 - x01);
  const auto lipschitz = static_cast<std::uint16_t>(brick[kLipschitzAt]);
  const auto deviation = static_cast<std::uint16_t>(brick[kLipschitzAt + 1]);
  const float distance = f.quantum * (y0 + fz * (y1 - y0) - static_cast<float>(deviation));
  return std::clamp(distance, 0.0f, f.near_band) / format::decode_lipschitz(lipschitz);
}

}  // namespace

void look_up_clearances(const FieldOfCells& f, const float* x, const float* y, const float* z, float* clearance,
                        std::uint32_t count) noexcept {
  for (std::uint32_t i = 0; i < count; ++i) {
    float g[3];
    for (int axis = 0; axis < 3; ++axis) {
      const float(&m)[4] = f.to_cells[axis];
      g[axis] = m[0] * x[i] + m[1] * y[i] + m[2] * z[i] + m[3];
    }
    // false for NaN
    const bool within =
        g[0] >= 0.0f && g[1] >= 0.0f && g[2] >= 0.0f && g[0] < f.cells[0] && g[1] < f.cells[1] && g[2] < f.cells[2];
    const float shift = std::fabs(g[0]) + std::fabs(g[1]) + std::fabs(g[2]) + f.offset;
    clearance[i] = (within ? clearance_within(f, g) : clearance_outside(f, g)) - kPointRounding * f.cell_edge * shift;
  }
}

}  // namespace godobject::detail
