#include "toolchain/live/recorded_run.h"

#include <algorithm>

#include "hal/linux/monotonic_clock.h"
#include "toolchain/figures/replay_log.h"
#include "toolchain/figures/telemetry_log.h"

namespace godobject::live {
namespace {

LiveSample replayed(const figures::ReplayRow& row) {
  LiveSample sample;
  sample.t = row.t;
  sample.mode = "replay";
  sample.outcome = row.status;
  sample.share = 1.0;
  sample.H_WD = row.H_WD;
  sample.H_WS = row.H_WS;
  sample.wrench_R = row.wrench;  // without an arm the room is the scene
  sample.depth = row.depth;
  sample.contacts = row.contacts;
  sample.computed = 1e-9 * (row.step1_ns + row.solve_ns);
  return sample;
}

std::vector<LiveSample> read_samples(const std::filesystem::path& file) {
  std::vector<LiveSample> samples;
  if (figures::is_telemetry(file)) {
    for (const figures::TelemetryRow& row : figures::read_telemetry_log(file)) samples.push_back(sample_of(row));
  } else {
    for (const figures::ReplayRow& row : figures::read_replay_log(file)) samples.push_back(replayed(row));
  }
  return samples;
}

}  // namespace

RecordedRun::RecordedRun(const std::filesystem::path& file, const std::filesystem::path& image,
                         const std::optional<firmware::ControllerConfig>& config)
    : image_(files::SceneImage::read(image)),
      placement_(config
                     ? std::optional(firmware::place(config->workspace, config->device, image_.scene.H_MB.translation))
                     : std::nullopt),
      samples_(read_samples(file)) {}

void RecordedRun::take(std::vector<LiveSample>& samples) {
  const std::int64_t now_ns = hal::MonotonicClock().now_ns();
  if (begin_ns_ == 0 || next_ == samples_.size()) {
    begin_ns_ = now_ns;
    next_ = 0;
  }
  const double until = samples_.front().t + 1e-9 * static_cast<double>(now_ns - begin_ns_);
  for (; next_ < samples_.size() && samples_[next_].t <= until; ++next_) samples.push_back(samples_[next_]);
}

std::string RecordedRun::answer(const Request&) { return "this page plays a record, which it cannot change"; }

double RecordedRun::largest_force() const {
  double largest = 0.0;
  for (const LiveSample& sample : samples_) largest = std::max(largest, sample.wrench_R.force.norm());
  return largest;
}

double RecordedRun::largest_torque() const {
  double largest = 0.0;
  for (const LiveSample& sample : samples_) largest = std::max(largest, sample.wrench_R.torque.norm());
  return largest;
}

}  // namespace godobject::live
