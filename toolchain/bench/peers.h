#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/scene/scene_view.h"
#include "toolchain/bench/brute_force.h"
#include "toolchain/bench/cycle_times.h"
#include "toolchain/bench/distribution.h"
#include "toolchain/bench/mesh_peers.h"

namespace godobject::bench {

/// The smallest search radius of step #1 of `contact` [voxels], and the one of brute force.
inline constexpr double kLeastReach = 0.125;

/// Returns the times of scans with the body at `poses` [ns], pass after pass.
PassSamples time_scan(BruteForce& brute, PointScan scan, std::span<const Pose> poses, const PassBudget& budget);

/// Returns the times of scans with cold caches at poses[i] for i in `cycles` [ns].
std::vector<double> time_cold_scan(BruteForce& brute, PointScan scan, std::span<const Pose> poses,
                                   std::span<const std::size_t> cycles);

/// Returns the times of queries with the moving body at poses[i] for i in `cycles` [ns].
Distribution time_query(const MeshPeer& peer, const Pose& H_BM, std::span<const Pose> poses,
                        std::span<const std::size_t> cycles);

/// Comparison of the penetrating points that brute force and the tree of step #1 find.
struct Agreement {
  std::size_t poses = 0;
  std::size_t points = 0;          ///< penetrating points by the tree, all poses together
  std::size_t differing = 0;       ///< points that only one of them finds
  double worst = 0.0;              ///< largest |distance| of the differing points in the scene's field [m]
  double worst_distance = 0.0;     ///< largest difference of the distances of the common points [m]
  std::size_t missed_by_cull = 0;  ///< points that the nearest cull wrongly excludes
};

/// Compares both at poses[i] for i in `cycles`. A point penetrates if its stored distance is below zero.
Agreement agreement(const SceneView& scene, std::span<const Pose> poses, std::span<const std::size_t> cycles);

}  // namespace godobject::bench
