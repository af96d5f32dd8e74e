#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "core/scene/scene.h"
#include "godobject/pose.h"
#include "toolchain/bench/distribution.h"
#include "toolchain/bench/workload.h"

namespace godobject::bench {

/// What a pipeline did along a path, for peers to look at the same poses.
struct Recording {
  std::vector<Pose> H_WS;  ///< god object's body frame before each cycle: where its step #1 looks first
  std::vector<Pose> H_WD;  ///< the device's, body frame
};

/// Runs the path once. Throws Failure if the scene lacks the pipeline.
Recording record(const Scene& scene, const Pipeline& pipeline, std::span<const Pose> device);

/// How long passes go on.
struct PassBudget {
  std::size_t least_passes = 3;
  std::size_t most_passes = 40;
  double seconds = 1.0;
};

/// Times of single cycles along a path [ns], pass after pass, each from the path's first pose.
struct CycleTimes {
  PassSamples whole;  ///< without a stopwatch inside
  PassSamples step1;  ///< in passes of their own: each holds readings of the clock
  PassSamples solve;
};

/// Warm: one cycle follows the other.
CycleTimes time_cycles(const Scene& scene, const Pipeline& pipeline, std::span<const Pose> device,
                       const PassBudget& budget);

/// Whole cycles with a cold cache [ns], in the order of `cycles` (ascending): 96 MB are walked before each of them, the
/// others run warm.
std::vector<double> time_cold_cycles(const Scene& scene, const Pipeline& pipeline, std::span<const Pose> device,
                                     std::span<const std::size_t> cycles);

/// Every n-th of `cycles`, so that about `wanted` are left.
std::vector<std::size_t> thinned(std::span<const std::size_t> cycles, std::size_t wanted);

/// 96 MB of memory, read once a line: what was in the caches before is gone, unless they are larger.
class ColdWalk {
 public:
  static constexpr std::size_t kBytes = 96'000'000;

  ColdWalk() : bytes_(kBytes) {}
  void walk() const noexcept;

 private:
  std::vector<unsigned char> bytes_;
};

/// What two readings of the clock right after each other differ by [ns]: it is in every time of a single cycle.
Distribution clock_cost();

}  // namespace godobject::bench
