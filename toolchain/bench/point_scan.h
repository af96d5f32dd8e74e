#pragma once

#include <cstddef>
#include <cstdint>

namespace godobject::bench {

/// Distances [m] at the nodes of a dense lattice, x fastest. Plain data, so that kernels for wider vectors see no type
/// whose layout follows the compiler's flags.
struct GridView {
  const float* value = nullptr;
  std::int32_t nodes[3] = {};  ///< along x, y, z; at least 2 each
};

/// Sample points, one array a component [m], padded to kPad values; `order[i]` is the point's number in the scene.
struct PointView {
  static constexpr std::size_t kPad = 16;
  const float* x = nullptr;
  const float* y = nullptr;
  const float* z = nullptr;
  const std::uint32_t* order = nullptr;
  std::size_t count = 0;
};

/// From the points' frame to lattice coordinates: q = m p + t, node (i, j, k) at q = (i, j, k).
struct LatticePose {
  float m[9];  ///< row by row [1/m]
  float t[3];
};

/// Points that a scan keeps: number, distance [m], gradient [1] in W. Room for all points and one vector more.
struct NearList {
  std::uint32_t* index = nullptr;
  float* distance = nullptr;
  float* gradient_x = nullptr;
  float* gradient_y = nullptr;
  float* gradient_z = nullptr;
  std::size_t count = 0;
};

/// What a scan looks for: points whose interpolated distance is below `cut`. `cull`: no such point is nearest to a node
/// with more than that. `per_voxel`: 1 / s [1/m].
struct ScanLimits {
  float cut;
  float cull;
  float per_voxel;
};

/// Step #1 by brute force: looks at every point. Positions off the lattice are those of its border, whose distance must
/// not be below `cut`. `scratch`: PointView::count + kPad numbers for what survives the cull.
using PointScan = void (*)(const GridView& grid, const PointView& points, const LatticePose& pose,
                           const ScanLimits& limits, std::uint32_t* scratch, NearList& near) noexcept;

/// One way to scan, with the name that tables show.
struct NamedScan {
  const char* name;  ///< "nearest cull, AVX-512"
  PointScan scan;
};

/// Trilinear value and gradient of all points, in double precision.
void scan_trilinear_double(const GridView& grid, const PointView& points, const LatticePose& pose,
                           const ScanLimits& limits, std::uint32_t* scratch, NearList& near) noexcept;

/// The nearest node's value of all points, in single precision; trilinear value and gradient of those near enough.
void scan_cull_float(const GridView& grid, const PointView& points, const LatticePose& pose, const ScanLimits& limits,
                     std::uint32_t* scratch, NearList& near) noexcept;

#if defined(__x86_64__)
/// The same, and trilinear for all, with gathers of 8 (AVX2) or 16 (AVX-512) lanes. Only where the processor has them.
void scan_trilinear_avx2(const GridView& grid, const PointView& points, const LatticePose& pose,
                         const ScanLimits& limits, std::uint32_t* scratch, NearList& near) noexcept;
void scan_cull_avx2(const GridView& grid, const PointView& points, const LatticePose& pose, const ScanLimits& limits,
                    std::uint32_t* scratch, NearList& near) noexcept;
void scan_trilinear_avx512(const GridView& grid, const PointView& points, const LatticePose& pose,
                           const ScanLimits& limits, std::uint32_t* scratch, NearList& near) noexcept;
void scan_cull_avx512(const GridView& grid, const PointView& points, const LatticePose& pose, const ScanLimits& limits,
                      std::uint32_t* scratch, NearList& near) noexcept;
#endif

}  // namespace godobject::bench
