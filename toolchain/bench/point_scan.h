#pragma once

#include <cstddef>
#include <cstdint>

namespace godobject::bench {

/// Distances [m] at the nodes of a dense lattice, x fastest. Plain data: its layout does not depend on the flags of the
/// kernels for wider vectors.
struct GridView {
  const float* value = nullptr;
  std::int32_t nodes[3] = {};  ///< along x, y, z; at least 2 each
};

/// Sample points, one array per component [m], padded to kPad values; `order[i]` is the point's number in the scene.
struct PointView {
  static constexpr std::size_t kPad = 16;
  const float* x = nullptr;
  const float* y = nullptr;
  const float* z = nullptr;
  const std::uint32_t* order = nullptr;
  std::size_t count = 0;
};

/// Transform from the points' frame to lattice coordinates: q = m p + t, with node (i, j, k) at q = (i, j, k).
struct LatticePose {
  float m[9];  ///< row by row [1/m]
  float t[3];
};

/// Points that a scan finds: number, distance [m], gradient [1] in W. Room for all points and one vector more.
struct NearList {
  std::uint32_t* index = nullptr;
  float* distance = nullptr;
  float* gradient_x = nullptr;
  float* gradient_y = nullptr;
  float* gradient_z = nullptr;
  std::size_t count = 0;
};

/// Limits of a scan, which finds the points whose interpolated distance is below `cut`. A point whose nearest node has
/// a value above `cull` is not one of them. `per_voxel`: 1 / s [1/m].
struct ScanLimits {
  float cut;
  float cull;
  float per_voxel;
};

/// Step #1 by brute force: a look-up of every point. A position off the lattice counts as the nearest one on its
/// border, whose distance must not be below `cut`. `scratch`: PointView::count + kPad numbers for the points that pass
/// the cull.
using PointScan = void (*)(const GridView& grid, const PointView& points, const LatticePose& pose,
                           const ScanLimits& limits, std::uint32_t* scratch, NearList& near) noexcept;

/// A variant of the scan with its name in tables.
struct NamedScan {
  const char* name;  ///< "nearest cull, AVX-512"
  PointScan scan;
};

/// Computes trilinear value and gradient of all points in double precision.
void scan_trilinear_double(const GridView& grid, const PointView& points, const LatticePose& pose,
                           const ScanLimits& limits, std::uint32_t* scratch, NearList& near) noexcept;

/// Reads the nearest node of all points, and computes trilinear value and gradient of those that it does not exclude,
/// in single precision.
void scan_cull_float(const GridView& grid, const PointView& points, const LatticePose& pose, const ScanLimits& limits,
                     std::uint32_t* scratch, NearList& near) noexcept;

#if defined(__x86_64__)
/// Both variants with gathers of 8 (AVX2) or 16 (AVX-512) lanes. The processor must have these instructions.
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
