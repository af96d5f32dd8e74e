#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/scene/scene.h"
#include "toolchain/bench/brute_force.h"
#include "toolchain/bench/cycle_times.h"
#include "toolchain/bench/distribution.h"
#include "toolchain/bench/mesh_peers.h"

namespace godobject::bench {

/// Step #1 of `contact` looks for points nearer than this at the least [voxels]; brute force is asked for no more.
inline constexpr double kLeastReach = 0.125;

/// Times of scans with the body at `poses` [ns], pass after pass.
PassSamples time_scan(BruteForce& brute, PointScan scan, std::span<const Pose> poses, const PassBudget& budget);

/// Times of scans with a cold cache at poses[i] for i in `cycles` [ns].
std::vector<double> time_cold_scan(BruteForce& brute, PointScan scan, std::span<const Pose> poses,
                                   std::span<const std::size_t> cycles);

/// Times of queries with the moving mesh at the body poses[i] for i in `cycles` [ns].
Distribution time_query(const MeshPeer& peer, const Pose& H_BM, std::span<const Pose> poses,
                        std::span<const std::size_t> cycles);

/// How brute force and step #1's tree agree on the points that penetrate.
struct Agreement {
  std::size_t poses = 0;
  std::size_t points = 0;          ///< that the tree finds inside, all poses together
  std::size_t differing = 0;       ///< found by one of them only
  double worst = 0.0;              ///< the largest |distance| in the scene's field of those [m]
  double worst_distance = 0.0;     ///< largest difference of the distances of those that both find [m]
  std::size_t missed_by_cull = 0;  ///< points that a scan finds without the nearest cull and not with it
};

/// At the poses whose numbers are given; points inside: with a stored distance below zero.
Agreement agreement(const Scene& scene, std::span<const Pose> poses, std::span<const std::size_t> cycles);

}  // namespace godobject::bench
