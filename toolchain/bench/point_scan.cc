#include "toolchain/bench/point_scan.h"

#include <algorithm>
#include <cmath>

namespace godobject::bench {
namespace {

template <class Real>
struct Position {
  Real x, y, z;
};

template <class Real>
Real on_lattice(Real q, std::int32_t nodes) noexcept {
  return std::min(std::max(q, Real{0}), static_cast<Real>(nodes - 1));
}

/// Returns the lattice coordinates of point i.
template <class Real>
Position<Real> position(const GridView& grid, const PointView& points, const LatticePose& pose,
                        std::size_t i) noexcept {
  const auto x = static_cast<Real>(points.x[i]);
  const auto y = static_cast<Real>(points.y[i]);
  const auto z = static_cast<Real>(points.z[i]);
  const auto row = [&](std::size_t k) noexcept {
    return static_cast<Real>(pose.m[3 * k]) * x + static_cast<Real>(pose.m[3 * k + 1]) * y +
           static_cast<Real>(pose.m[3 * k + 2]) * z + static_cast<Real>(pose.t[k]);
  };
  return {on_lattice(row(0), grid.nodes[0]), on_lattice(row(1), grid.nodes[1]), on_lattice(row(2), grid.nodes[2])};
}

std::size_t node(const GridView& grid, std::int32_t x, std::int32_t y, std::int32_t z) noexcept {
  return static_cast<std::size_t>(x) +
         static_cast<std::size_t>(grid.nodes[0]) *
             (static_cast<std::size_t>(y) + static_cast<std::size_t>(grid.nodes[1]) * static_cast<std::size_t>(z));
}

/// Interpolates at q and appends the point to `near` if its distance is below the cut.
template <class Real>
void keep_if_near(const GridView& grid, const Position<Real>& q, const ScanLimits& limits, std::uint32_t index,
                  NearList& near) noexcept {
  const auto cell = [](Real at, std::int32_t nodes) noexcept {
    return std::min(static_cast<std::int32_t>(at), nodes - 2);
  };
  const std::int32_t x = cell(q.x, grid.nodes[0]);
  const std::int32_t y = cell(q.y, grid.nodes[1]);
  const std::int32_t z = cell(q.z, grid.nodes[2]);
  const Real fx = q.x - static_cast<Real>(x);
  const Real fy = q.y - static_cast<Real>(y);
  const Real fz = q.z - static_cast<Real>(z);
  const float* const v = grid.value + node(grid, x, y, z);
  const std::size_t up_y = static_cast<std::size_t>(grid.nodes[0]);
  const std::size_t up_z = up_y * static_cast<std::size_t>(grid.nodes[1]);
  const auto at = [&](std::size_t offset) noexcept { return static_cast<Real>(v[offset]); };
  const auto mix = [](Real low, Real high, Real f) noexcept { return low + f * (high - low); };
  // dx: differences along x on the cell's four edges; c: values on them
  const Real dx00 = at(1) - at(0);
  const Real dx10 = at(up_y + 1) - at(up_y);
  const Real dx01 = at(up_z + 1) - at(up_z);
  const Real dx11 = at(up_y + up_z + 1) - at(up_y + up_z);
  const Real c00 = at(0) + fx * dx00;
  const Real c10 = at(up_y) + fx * dx10;
  const Real c01 = at(up_z) + fx * dx01;
  const Real c11 = at(up_y + up_z) + fx * dx11;
  const Real c0 = mix(c00, c10, fy);
  const Real c1 = mix(c01, c11, fy);
  const Real distance = mix(c0, c1, fz);
  if (!(distance < static_cast<Real>(limits.cut))) return;
  const auto per_voxel = static_cast<Real>(limits.per_voxel);
  near.index[near.count] = index;
  near.distance[near.count] = static_cast<float>(distance);
  near.gradient_x[near.count] = static_cast<float>(per_voxel * mix(mix(dx00, dx10, fy), mix(dx01, dx11, fy), fz));
  near.gradient_y[near.count] = static_cast<float>(per_voxel * mix(c10 - c00, c11 - c01, fz));
  near.gradient_z[near.count] = static_cast<float>(per_voxel * (c1 - c0));
  ++near.count;
}

}  // namespace

void scan_trilinear_double(const GridView& grid, const PointView& points, const LatticePose& pose,
                           const ScanLimits& limits, std::uint32_t*, NearList& near) noexcept {
  near.count = 0;
  for (std::size_t i = 0; i < points.count; ++i) {
    keep_if_near(grid, position<double>(grid, points, pose, i), limits, points.order[i], near);
  }
}

void scan_cull_float(const GridView& grid, const PointView& points, const LatticePose& pose, const ScanLimits& limits,
                     std::uint32_t* scratch, NearList& near) noexcept {
  std::size_t survivors = 0;
  for (std::size_t i = 0; i < points.count; ++i) {
    const Position<float> q = position<float>(grid, points, pose, i);
    const auto nearest = [](float at) noexcept { return static_cast<std::int32_t>(at + 0.5f); };
    const float value = grid.value[node(grid, nearest(q.x), nearest(q.y), nearest(q.z))];
    scratch[survivors] = static_cast<std::uint32_t>(i);
    survivors += value < limits.cull ? 1u : 0u;
  }
  near.count = 0;
  for (std::size_t k = 0; k < survivors; ++k) {
    const std::uint32_t i = scratch[k];
    keep_if_near(grid, position<float>(grid, points, pose, i), limits, points.order[i], near);
  }
}

}  // namespace godobject::bench
