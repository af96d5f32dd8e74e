#include "firmware/records/run_records.h"

#include <fmt/format.h>

#include "firmware/records/record_folder.h"

namespace godobject::firmware {
namespace {

std::vector<std::string> file_names(const RunRecords::Setup& setup) {
  std::vector<std::string> names{TelemetryWriter::kFileName};
  if (setup.hand) names.emplace_back(HandLog::kFileName);
  if (!setup.buses) return names;
  names.emplace_back(BusLogWriter::kFileName);
  for (const std::string& bus : setup.bus_names) names.push_back(BusLogWriter::packet_file_name(bus));
  return names;
}

}  // namespace

RunRecords::RunRecords(const Setup& setup, TelemetryRing& ring, hal::CanLogRing& bus_ring)
    : ring_(ring), bus_ring_(bus_ring) {
  if (setup.folder.empty()) return;
  const LatestLinks links(setup.folder, file_names(setup));
  const RecordFolder run(setup.folder, run_name(setup.start));
  telemetry_ = std::make_unique<TelemetryWriter>(run.create(TelemetryWriter::kFileName), setup.joint_count, ring);
  if (setup.hand) hand_ = std::make_unique<HandLog>(run.create(HandLog::kFileName));
  if (setup.buses) {
    buses_ = std::make_unique<BusLogWriter>(run.create(BusLogWriter::kFileName), bus_ring);
    for (const std::string& bus : setup.bus_names) {
      buses_->add_bus(bus, run.create(BusLogWriter::packet_file_name(bus)));
    }
  }
  links.point_to(run.path().filename());
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
