#include "toolchain/bench/peers.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "core/pipeline/penalty/penalty_contacts.h"
#include "toolchain/timing/stopwatch.h"

namespace godobject::bench {

PassSamples time_scan(BruteForce& brute, PointScan scan, std::span<const Pose> poses, const PassBudget& budget) {
  const timing::Stopwatch now_ns = timing::stopwatch();
  PassSamples samples(poses.size());
  const std::int64_t first_ns = now_ns();
  for (std::size_t pass = 0; pass < budget.most_passes; ++pass) {
    if (pass >= budget.least_passes && 1e-9 * static_cast<double>(now_ns() - first_ns) > budget.seconds) break;
    for (const Pose& H_WS : poses) {
      const std::int64_t begin_ns = now_ns();
      brute.scan(scan, H_WS);
      samples.push(static_cast<double>(now_ns() - begin_ns));
    }
  }
  return samples;
}

std::vector<double> time_cold_scan(BruteForce& brute, PointScan scan, std::span<const Pose> poses,
                                   std::span<const std::size_t> cycles) {
  const timing::Stopwatch now_ns = timing::stopwatch();
  const ColdWalk cold;
  std::vector<double> times;
  for (const std::size_t i : cycles) {
    cold.walk();
    const std::int64_t begin_ns = now_ns();
    brute.scan(scan, poses[i]);
    times.push_back(static_cast<double>(now_ns() - begin_ns));
  }
  return times;
}

Distribution time_query(const MeshPeer& peer, const Pose& H_BM, std::span<const Pose> poses,
                        std::span<const std::size_t> cycles) {
  const timing::Stopwatch now_ns = timing::stopwatch();
  std::vector<double> times;
  for (const std::size_t i : cycles) {
    const Pose H_WM = poses[i] * H_BM;
    const std::int64_t begin_ns = now_ns();
    peer.query(H_WM);
    times.push_back(static_cast<double>(now_ns() - begin_ns));
  }
  return distribution(std::move(times));
}

Agreement agreement(const SceneView& scene, std::span<const Pose> poses, std::span<const std::size_t> cycles) {
  Agreement found;
  BruteForce brute(scene, 0.0);
  const auto distance = [&](const Pose& H_WS, std::uint32_t i) {
    return scene.voxelmap.sample(H_WS * scene.pointshell.point(i)).distance;
  };
  for (const std::size_t cycle : cycles) {
    const Pose& H_WS = poses[cycle];
    std::set<std::uint32_t> tree;
    visit_points_below(0.0, scene.voxelmap, scene.pointshell, H_WS, [&](std::size_t i, const Vector3& p_W) {
      if (scene.voxelmap.sample(p_W).distance < 0.0) tree.insert(static_cast<std::uint32_t>(i));
      return 0.0;
    });
    const NearList& culled = brute.scan(&scan_cull_float, H_WS);
    const std::size_t culled_count = culled.count;
    const NearList& near = brute.scan(&scan_trilinear_double, H_WS);
    found.missed_by_cull += near.count - std::min(near.count, culled_count);
    std::set<std::uint32_t> scanned(near.index, near.index + near.count);
    for (std::size_t k = 0; k < near.count; ++k) {
      if (!tree.contains(near.index[k])) continue;
      const double difference = std::fabs(distance(H_WS, near.index[k]) - static_cast<double>(near.distance[k]));
      found.worst_distance = std::max(found.worst_distance, difference);
    }
    std::vector<std::uint32_t> differing;
    std::set_symmetric_difference(tree.begin(), tree.end(), scanned.begin(), scanned.end(),
                                  std::back_inserter(differing));
    for (const std::uint32_t i : differing) found.worst = std::max(found.worst, std::fabs(distance(H_WS, i)));
    ++found.poses;
    found.points += tree.size();
    found.differing += differing.size();
  }
  return found;
}

}  // namespace godobject::bench
