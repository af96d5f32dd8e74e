#include "hal/cia402/parameter_watch.h"

#include <algorithm>
#include <cmath>

#include "hal/canopen/object_numbers.h"

namespace godobject::hal::cia402 {

using canopen::SdoResponse;

namespace {

/// Time in which every parameter is read once [s]. Chosen: a second, less 5 % for requests that wait for heartbeats.
constexpr double kWithin = 0.95;

}  // namespace

ParameterWatch::ParameterWatch(const BusLayout& layout, int bus) noexcept
    : steps_(watched_parameters(layout)), bus_(bus), within_(static_cast<int>(std::lround(kWithin / layout.period))) {
  for (int joint = 0; joint < layout.joint_count; ++joint) {
    const DriveConfig& drive = layout.drives[static_cast<std::size_t>(joint)];
    if (drive.bus != bus) continue;
    joints_[static_cast<std::size_t>(joint_count_)] = joint;
    nodes_[static_cast<std::size_t>(joint_count_)] = drive.node;
    ++joint_count_;
    temperatures_[static_cast<std::size_t>(joint)] = TemperatureWatch(drive.temperature);
    if (drive.temperature.exists()) steps_of_round_ = kWatchedCount + 1;
  }
}

void ParameterWatch::find(Alarm alarm, const SdoResponse& response) noexcept {
  if (finding_.alarm != Alarm::kNone) return;
  const ParameterStep step = asks_for_temperature() ? ParameterStep() : steps_[step_];
  finding_ = {alarm, bus_, joints_[drive_], 0, step.index, step.subindex, step.value, response.value};
}

int ParameterWatch::interval(int wanted) const noexcept {
  return std::min(wanted, std::max(1, within_ / std::max(1, static_cast<int>(steps_of_round_) * joint_count_)));
}

void ParameterWatch::take_temperature(const SdoResponse& response) noexcept {
  const TemperatureConfig& config = asked_temperature().config();
  if (!waits_ || response.node != nodes_[drive_] || response.index != config.index ||
      response.subindex != config.subindex) {
    return;
  }
  waits_ = false;
  silent_[drive_] = 0;
  asked_temperature().take(response);
}

bool ParameterWatch::next(CanFrame& request) noexcept {
  if (joint_count_ == 0) return false;
  if (waits_ && asks_for_temperature()) asked_temperature().miss();
  if (waits_ && ++silent_[drive_] >= kMostSilent) find(Alarm::kParameterChanged, SdoResponse());
  do {
    // the same parameter of all drives, then the next one: each drive is asked equally often
    drive_ = (drive_ + 1) % static_cast<std::size_t>(joint_count_);
    if (drive_ == 0) step_ = (step_ + 1) % steps_of_round_;
  } while (asks_for_temperature() && !asked_temperature().config().exists());
  waits_ = true;
  if (asks_for_temperature()) {
    const TemperatureConfig& config = asked_temperature().config();
    request = canopen::sdo_read(nodes_[drive_], config.index, config.subindex);
    return true;
  }
  request = canopen::sdo_read(nodes_[drive_], steps_[step_].index, steps_[step_].subindex);
  return true;
}

void ParameterWatch::take(const SdoResponse& response) noexcept {
  if (asks_for_temperature()) return take_temperature(response);
  const ParameterStep& step = steps_[step_];
  if (!waits_ || response.node != nodes_[drive_] || response.index != step.index ||
      response.subindex != step.subindex) {
    return;
  }
  waits_ = false;
  silent_[drive_] = 0;
  const bool read = response.kind == SdoResponse::Kind::kRead && (response.size == 0 || response.size == step.size);
  if (read && step.accepts(response.value)) return;
  find(step.index == canopen::kModeDisplay ? Alarm::kWrongMode : Alarm::kParameterChanged, response);
}

}  // namespace godobject::hal::cia402
