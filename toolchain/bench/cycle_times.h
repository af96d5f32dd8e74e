#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "core/scene/scene_view.h"
#include "godobject/pose.h"
#include "toolchain/bench/distribution.h"
#include "toolchain/bench/workload.h"

namespace godobject::bench {

/// The poses of a pipeline along a path, at which peers are measured.
struct Recording {
  std::vector<Pose> H_WS;  ///< body frame of the god object before each cycle, where step #1 begins
  std::vector<Pose> H_WD;  ///< body frame of the device
};

/// Runs the path once and returns its poses. Throws Failure if the scene lacks the pipeline.
Recording record(const SceneView& scene, const Pipeline& pipeline, std::span<const Pose> device);

/// Limits of the number of passes.
struct PassBudget {
  std::size_t least_passes = 3;
  std::size_t most_passes = 40;
  double seconds = 1.0;
};

/// Times of single cycles along a path [ns], pass after pass; each pass begins at the first pose.
struct CycleTimes {
  PassSamples whole;  ///< cycles without a stopwatch inside
  PassSamples step1;  ///< from separate passes with a stopwatch inside the cycle, as `solve`
  PassSamples solve;
};

/// Times cycles with warm caches: each cycle follows the one before at once.
CycleTimes time_cycles(const SceneView& scene, const Pipeline& pipeline, std::span<const Pose> device,
                       const PassBudget& budget);

/// Returns the times of whole cycles with cold caches [ns], in the order of `cycles` (ascending). 96 MB are read before
/// each of them; the other cycles of the path run warm.
std::vector<double> time_cold_cycles(const SceneView& scene, const Pipeline& pipeline, std::span<const Pose> device,
                                     std::span<const std::size_t> cycles);

/// Returns every n-th of `cycles`, about `wanted` of them.
std::vector<std::size_t> thinned(std::span<const std::size_t> cycles, std::size_t wanted);

/// 96 MB of memory. walk() reads them once per cache line, which evicts all caches that are not larger.
class ColdWalk {
 public:
  static constexpr std::size_t kBytes = 96'000'000;

  ColdWalk() : bytes_(kBytes) {}
  void walk() const noexcept;

 private:
  std::vector<unsigned char> bytes_;
};

/// Returns the difference of two successive readings of the clock [ns], which is part of every time of a single cycle.
Distribution clock_cost();

}  // namespace godobject::bench
