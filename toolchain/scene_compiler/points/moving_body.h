#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "core/scene/format.h"
#include "toolchain/parallel/parallel.h"
#include "toolchain/scene_compiler/mesh/outer_surface.h"
#include "toolchain/scene_compiler/mesh/surface_sample.h"

namespace godobject::scene_compiler {

/// Samples of the moving surface in the mesh's frame M: `points` spread evenly, then any that were added.
struct MovingSampling {
  std::vector<SurfaceSample> samples;
  std::uint32_t points = 0;
  std::uint32_t levels = 0;
  double area = 0.0;  ///< of the outer surface [m^2]
};

/// The moving body as the image stores it.
struct MovingBody {
  format::Body body{};
  std::vector<float> points;   ///< x[n], y[n], z[n] in the body frame B
  std::vector<float> normals;  ///< the same, unit, pointing into the body
  std::vector<format::Node> nodes;
};

/// The evenness with which the points of the moving body cover its surface.
struct PointSpread {
  std::vector<std::uint32_t> level_sizes;  ///< samples of level 1 .. level_count; the last is the number of points
  double spacing = 0.0;   ///< median distance of a point to the nearest one on its side of the body [m]
  double coverage = 0.0;  ///< largest distance of the outer surface to its nearest point, at random places [m]
};

/// Spreads `points` samples over the outer surface (Poisson disk by sample elimination), enough for `levels` nested
/// levels. Deterministic. `progress` gets 0 .. 1 and may be empty. Throws std::runtime_error or Failure naming the
/// cure.
MovingSampling sample_moving_body(const OuterSurface& outer, std::uint32_t points, std::uint32_t levels,
                                  const parallel::Progress& progress);

/// Returns the samples in nested levels (added ones in the last), with inward normals, sphere tree and mass properties.
/// The sphere around the points also contains `others` (in M). Deterministic.
MovingBody make_moving_body(const OuterSurface& outer, const MovingSampling& sampling,
                            std::span<const Eigen::Vector3d> others = {});

/// Measures the spread of the samples that make_moving_body stores. Deterministic.
PointSpread measure_spread(const OuterSurface& outer, const MovingSampling& sampling);

/// Returns the largest distance of the outer surface to its nearest sample, at random places [m].
double largest_gap(const OuterSurface& outer, std::span<const SurfaceSample> samples);

/// Returns the pose of the body frame B (centre of mass, principal axes) in the moving mesh's frame M, as the core
/// reads it.
Eigen::Isometry3d body_pose(const format::Body& body);

}  // namespace godobject::scene_compiler
