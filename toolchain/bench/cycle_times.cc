#include "toolchain/bench/cycle_times.h"

#include <algorithm>
#include <memory>

#include "toolchain/command_line/failure.h"
#include "toolchain/timing/stopwatch.h"

namespace godobject::bench {
namespace {

/// A god object with its memory.
class Runner {
 public:
  Runner(const SceneView& scene, const Pipeline& pipeline) {
    if (god_object_.start(scene, pipeline.solver, pipeline.friction) != Status::kOk) {
      throw command::Failure(command::ExitCode::kBadData,
                             "the scene image was compiled without " + pipeline.name() + "; compile it again");
    }
  }

  OwnedGodObject& god_object() { return god_object_; }

  CycleReport update(const Pose& H_WM, StepTimes* times = nullptr) {
    CycleReport report;
    if (god_object_->update({H_WM, Motion{}}, report, times) != Status::kOk) {
      throw command::Failure(command::ExitCode::kBadData, "a pose of the path is invalid; godobject-replay names it");
    }
    return report;
  }

 private:
  OwnedGodObject god_object_;
};

/// Runs passes within the budget.
template <class Pass>
void run_passes(const PassBudget& budget, Pass&& pass) {
  const timing::Stopwatch now_ns = timing::stopwatch();
  const std::int64_t begin_ns = now_ns();
  for (std::size_t done = 0; done < budget.most_passes; ++done) {
    const double spent = 1e-9 * static_cast<double>(now_ns() - begin_ns);
    if (done >= budget.least_passes && spent > budget.seconds) break;
    pass();
  }
}

}  // namespace

Recording record(const SceneView& scene, const Pipeline& pipeline, std::span<const Pose> device) {
  Recording recording;
  Runner runner(scene, pipeline);
  for (const Pose& H_WM : device) {
    recording.H_WD.push_back(H_WM * scene.H_MB);
    const ProxyState& state = runner.god_object().state();
    recording.H_WS.push_back(state.started ? state.H_WS : recording.H_WD.back());
    runner.update(H_WM);
  }
  return recording;
}

CycleTimes time_cycles(const SceneView& scene, const Pipeline& pipeline, std::span<const Pose> device,
                       const PassBudget& budget) {
  const timing::Stopwatch now_ns = timing::stopwatch();
  CycleTimes times{PassSamples(device.size()), PassSamples(device.size()), PassSamples(device.size())};
  Runner runner(scene, pipeline);
  run_passes(budget, [&] {
    runner.god_object()->reset();
    for (const Pose& H_WM : device) {
      const std::int64_t begin_ns = now_ns();
      runner.update(H_WM);
      times.whole.push(static_cast<double>(now_ns() - begin_ns));
    }
  });
  run_passes(budget, [&] {
    runner.god_object()->reset();
    for (const Pose& H_WM : device) {
      StepTimes steps{.now_ns = now_ns};
      runner.update(H_WM, &steps);
      times.step1.push(static_cast<double>(steps.step1_ns));
      times.solve.push(static_cast<double>(steps.solve_ns));
    }
  });
  return times;
}

std::vector<double> time_cold_cycles(const SceneView& scene, const Pipeline& pipeline, std::span<const Pose> device,
                                     std::span<const std::size_t> cycles) {
  const timing::Stopwatch now_ns = timing::stopwatch();
  const ColdWalk cold;
  Runner runner(scene, pipeline);
  std::vector<double> times;
  std::size_t next = 0;
  for (std::size_t i = 0; i < device.size() && next < cycles.size(); ++i) {
    if (i != cycles[next]) {
      runner.update(device[i]);
      continue;
    }
    ++next;
    cold.walk();
    const std::int64_t begin_ns = now_ns();
    runner.update(device[i]);
    times.push_back(static_cast<double>(now_ns() - begin_ns));
  }
  return times;
}

std::vector<std::size_t> thinned(std::span<const std::size_t> cycles, std::size_t wanted) {
  const std::size_t stride = std::max<std::size_t>(1, cycles.size() / std::max<std::size_t>(1, wanted));
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < cycles.size(); i += stride) kept.push_back(cycles[i]);
  return kept;
}

void ColdWalk::walk() const noexcept {
  constexpr std::size_t kLine = 64;
  // volatile, so that the compiler does not remove the unused reads
  const volatile unsigned char* const bytes = bytes_.data();
  for (std::size_t i = 0; i < bytes_.size(); i += kLine) static_cast<void>(bytes[i]);
}

Distribution clock_cost() {
  constexpr int kReadings = 100'000;
  const timing::Stopwatch now_ns = timing::stopwatch();
  std::vector<double> costs;
  for (int i = 0; i < kReadings; ++i) {
    const std::int64_t begin_ns = now_ns();
    costs.push_back(static_cast<double>(now_ns() - begin_ns));
  }
  return distribution(std::move(costs));
}

}  // namespace godobject::bench
