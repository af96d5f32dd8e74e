#include "firmware/records/run_records.h"

#include <fmt/format.h>

namespace godobject::firmware {

RunRecords::RunRecords(const Setup& setup, TelemetryRing& ring, hal::CanLogRing& bus_ring)
    : ring_(ring), bus_ring_(bus_ring) {
  if (setup.folder.empty()) return;
  telemetry_ = std::make_unique<TelemetryWriter>(setup.folder, setup.joint_count, ring);
  if (setup.buses) buses_ = std::make_unique<BusLogWriter>(setup.folder, setup.bus_names, bus_ring);
}

void RunRecords::drain() const {
  if (telemetry_) telemetry_->drain();
  if (buses_) buses_->drain();
}

std::string RunRecords::summary() const {
  std::string text;
  if (telemetry_) {
    text += fmt::format("{}: {} rows, {} lost\n", telemetry_->file().string(), telemetry_->written(),
                        telemetry_->lost() + ring_.lost());
  }
  if (buses_) {
    text += fmt::format("{}: {} frames, {} lost\n", buses_->file().string(), buses_->written(),
                        buses_->lost() + bus_ring_.lost());
  }
  return text;
}

}  // namespace godobject::firmware
