#pragma once

#include <limits>

#include "hal/canopen/sdo.h"
#include "hal/cia402/temperature.h"
#include "hal/joint_drives.h"

namespace godobject::hal::cia402 {

/// The temperature of one drive by its answers, which come about once a second. An answer that is missing is a warning,
/// and kMostLost of them in a row are an alarm. Both end with the next answer. Real-time safe.
class TemperatureWatch {
 public:
  /// Chosen: three seconds. A winding that takes tens of seconds to heat up rises by some degrees in them.
  static constexpr int kMostLost = 3;

  TemperatureWatch() = default;
  explicit TemperatureWatch(const TemperatureConfig& config) noexcept : config_(config) {}

  const TemperatureConfig& config() const noexcept { return config_; }

  /// Takes the answer to a request. An abort, and a number of another size, are as no answer.
  void take(const canopen::SdoResponse& response) noexcept {
    const bool read =
        response.kind == canopen::SdoResponse::Kind::kRead && (response.size == 0 || response.size == config_.size);
    if (!read) return miss();
    lost_ = 0;
    celsius_ = hal::celsius(config_, response.value);
  }

  /// There was no answer to a request.
  void miss() noexcept { lost_ = lost_ < kMostLost ? lost_ + 1 : kMostLost; }

  double celsius() const noexcept { return celsius_; }                ///< the last one; NaN: none yet [degC]
  bool is_warm() const noexcept { return celsius_ >= config_.warn; }  ///< the last one was
  bool is_lost() const noexcept { return lost_ > 0; }                 ///< the last answer is missing

  /// The alarm of the present state.
  Alarm alarm() const noexcept {
    if (lost_ >= kMostLost) return Alarm::kTemperatureLost;
    return celsius_ >= config_.stop ? Alarm::kTooHot : Alarm::kNone;
  }

 private:
  TemperatureConfig config_;
  double celsius_ = std::numeric_limits<double>::quiet_NaN();
  int lost_ = 0;
};

}  // namespace godobject::hal::cia402
