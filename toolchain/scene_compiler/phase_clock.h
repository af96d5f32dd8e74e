#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "toolchain/parallel/parallel.h"

namespace godobject::scene_compiler {

/// Gets the name of the running phase and its finished share, 0 .. 1. May be empty.
using PhaseProgress = std::function<void(const char* phase, double done)>;

/// Runs the phases of a compilation, reports their progress and measures their times.
class PhaseClock {
 public:
  using Seconds = std::vector<std::pair<std::string, double>>;

  explicit PhaseClock(PhaseProgress progress) : progress_(std::move(progress)) {}

  /// Returns the result of work(progress).
  template <class Work>
  auto run(const char* phase, Work&& work) {
    const auto begin = std::chrono::steady_clock::now();
    const parallel::Progress progress = [this, phase](double done) {
      if (progress_) progress_(phase, done);
    };
    progress(0.0);
    auto result = work(progress);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
    seconds_.emplace_back(phase, time.count());
    return result;
  }

  /// The phases so far, each with its time [s], in the order in which they ended.
  const Seconds& seconds() const { return seconds_; }

 private:
  PhaseProgress progress_;
  Seconds seconds_;
};

}  // namespace godobject::scene_compiler
