#include "toolchain/bench/brute_force.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace godobject::bench {
namespace {

/// Spreads bits 0-20 to every third bit.
std::uint64_t spread(std::uint64_t bits) noexcept {
  bits &= 0x1fffff;
  bits = (bits | bits << 32) & 0x1f00000000ffff;
  bits = (bits | bits << 16) & 0x1f0000ff0000ff;
  bits = (bits | bits << 8) & 0x100f00f00f00f00f;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3;
  return (bits | bits << 2) & 0x1249249249249249;
}

/// Returns the numbers of the points in Morton order in their bounding cube.
std::vector<std::uint32_t> morton_order(const Pointshell& shell) {
  Vector3 low = shell.point(0);
  Vector3 high = low;
  for (std::size_t i = 1; i < shell.size; ++i) {
    low = low.cwiseMin(shell.point(i));
    high = high.cwiseMax(shell.point(i));
  }
  const double scale = 0x1fffff / std::max((high - low).maxCoeff(), 1e-12);
  std::vector<std::uint64_t> code(shell.size);
  for (std::size_t i = 0; i < shell.size; ++i) {
    const Vector3 at = scale * (shell.point(i) - low);
    code[i] = spread(static_cast<std::uint64_t>(at.x())) | spread(static_cast<std::uint64_t>(at.y())) << 1 |
              spread(static_cast<std::uint64_t>(at.z())) << 2;
  }
  std::vector<std::uint32_t> order(shell.size);
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return code[a] != code[b] ? code[a] < code[b] : a < b; });
  return order;
}

}  // namespace

BruteForce::BruteForce(const SceneView& scene, double cut) {
  const format::Grid& lattice = scene.grid;
  const double s = lattice.voxel_size;
  voxel_size_ = s;
  // half a voxel's diagonal, and some room for the error of trilinear interpolation
  constexpr double kCull = 1.0;
  limits_ = {static_cast<float>(cut), static_cast<float>(cut + kCull * s), static_cast<float>(1.0 / s)};
  // the border's nodes must be farther from the surface than the cut, so that no point beyond them is found
  const double room = cut + (kCull + 1.0) * s;
  for (int k = 0; k < 3; ++k) {
    const double first = std::floor((lattice.surface_min[k] - room - lattice.origin[k]) / s);
    const double last = std::ceil((lattice.surface_max[k] + room - lattice.origin[k]) / s);
    origin_W_[k] = lattice.origin[k] + s * first;
    grid_.nodes[k] = static_cast<std::int32_t>(last - first) + 1;
  }
  const auto count = [&](int k) { return static_cast<std::size_t>(grid_.nodes[k]); };
  values_.reserve(count(0) * count(1) * count(2));
  for (std::size_t z = 0; z < count(2); ++z) {
    for (std::size_t y = 0; y < count(1); ++y) {
      for (std::size_t x = 0; x < count(0); ++x) {
        const Vector3 node(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z));
        values_.push_back(static_cast<float>(scene.voxelmap.sample(origin_W_ + s * node).distance));
      }
    }
  }
  grid_.value = values_.data();

  const Pointshell& shell = scene.pointshell;
  const std::size_t padded = (shell.size + PointView::kPad - 1) / PointView::kPad * PointView::kPad;
  order_ = morton_order(shell);
  x_.assign(padded, 0.0f);
  y_.assign(padded, 0.0f);
  z_.assign(padded, 0.0f);
  for (std::size_t i = 0; i < shell.size; ++i) {
    x_[i] = shell.x[order_[i]];
    y_[i] = shell.y[order_[i]];
    z_[i] = shell.z[order_[i]];
  }
  order_.resize(padded, 0);
  points_ = {x_.data(), y_.data(), z_.data(), order_.data(), shell.size};

  const std::size_t room_for = padded + PointView::kPad;
  scratch_.resize(room_for);
  near_index_.resize(room_for);
  for (auto* values : {&near_distance_, &near_gradient_x_, &near_gradient_y_, &near_gradient_z_}) {
    values->resize(room_for);
  }
  near_ = {near_index_.data(),      near_distance_.data(),   near_gradient_x_.data(),
           near_gradient_y_.data(), near_gradient_z_.data(), 0};
}

const NearList& BruteForce::scan(PointScan how, const Pose& H_WS) noexcept {
  const double per_voxel = 1.0 / voxel_size_;
  const Matrix3 m = per_voxel * H_WS.rotation.toRotationMatrix();
  const Vector3 t = per_voxel * (H_WS.translation - origin_W_);
  LatticePose pose;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) pose.m[3 * row + column] = static_cast<float>(m(row, column));
    pose.t[row] = static_cast<float>(t[row]);
  }
  how(grid_, points_, pose, limits_, scratch_.data(), near_);
  return near_;
}

std::vector<NamedScan> runnable_scans() {
  std::vector<NamedScan> scans = {
      {"trilinear for all, scalar double", &scan_trilinear_double},
      {"nearest cull, scalar float", &scan_cull_float},
  };
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    scans.push_back({"trilinear for all, AVX2", &scan_trilinear_avx2});
    scans.push_back({"nearest cull, AVX2", &scan_cull_avx2});
  }
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512bw")) {
    scans.push_back({"trilinear for all, AVX-512", &scan_trilinear_avx512});
    scans.push_back({"nearest cull, AVX-512", &scan_cull_avx512});
  }
#endif
  return scans;
}

}  // namespace godobject::bench
