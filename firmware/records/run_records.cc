#include "firmware/records/run_records.h"

#include <utility>

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"

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

void warn_of_little_room(const RunRecords::Setup& setup) {
  for (const std::filesystem::path& folder : {setup.folder, setup.incidents}) {
    if (folder.empty()) continue;
    const std::uintmax_t room = room_on_disk(folder);
    const std::uintmax_t least = IncidentRecorder::least_room(setup.period);
    if (room >= least) continue;
    setup.say(fmt::format("{}: the disk has {} MB left; below {} MB no stop is recorded; make room", folder.string(),
                          room / 1'000'000, least / 1'000'000));
  }
}

/// Makes the folder of incidents and says where it is. False: it cannot be made, and the run does not need it.
bool announce(const RunRecords::Setup& setup) {
  try {
    require_record_folder(setup.incidents);
  } catch (const command::Failure& failure) {
    if (setup.needs_incidents) throw;
    setup.say(fmt::format("a stop will not be recorded: {} by --incidents", failure.what()));
    return false;
  }
  setup.say(fmt::format("a stop will be recorded in {}", setup.incidents.string()));
  return true;
}

}  // namespace

RunRecords::RunRecords(Setup setup, TelemetryRing& ring, hal::CanLogRing& bus_ring) : ring_(ring), bus_ring_(bus_ring) {
  if (!setup.incidents.empty() && !announce(setup)) setup.incidents.clear();
  warn_of_little_room(setup);
  IncidentRecorder::Setup incidents{.folder = setup.incidents,
                                    .name = "",
                                    .format = setup.format,
                                    .bus_names = setup.bus_names,
                                    .facts = setup.facts,
                                    .least_room = IncidentRecorder::least_room(setup.period),
                                    .say = setup.say};
  if (!setup.folder.empty()) {
    const LatestLinks links(setup.folder, file_names(setup));
    const RecordFolder run(setup.folder, run_name(setup.start));
    run.write(setup.facts);
    telemetry_ = std::make_unique<TelemetryWriter>(run.create(TelemetryWriter::kFileName), setup.format, setup.every);
    if (setup.hand) hand_ = std::make_unique<HandLog>(run.create(HandLog::kFileName));
    if (setup.buses) {
      buses_ = std::make_unique<BusLogWriter>(run.create(BusLogWriter::kFileName));
      for (const std::string& bus : setup.bus_names) {
        buses_->add_bus(bus, run.create(BusLogWriter::packet_file_name(bus)));
      }
    }
    links.point_to(run.path().filename());
    if (setup.incidents.empty()) {
      incidents.folder = run.path();
      incidents.name = "incident";
    }
  }
  if (!incidents.folder.empty()) incidents_ = std::make_unique<IncidentRecorder>(std::move(incidents));
}

void RunRecords::take() {
  TelemetryRecord record;
  while (ring_.pop(record)) {
    if (telemetry_) telemetry_->add(record);
    if (incidents_) incidents_->add(record);
  }
  hal::LoggedFrame frame;
  while (bus_ring_.pop(frame)) {
    if (buses_) buses_->add(frame);
    if (incidents_) incidents_->add(frame);
  }
  if (telemetry_) telemetry_->flush();
  if (buses_) buses_->flush();
}

void RunRecords::drain() {
  if (!any()) return;
  do {
    take();
  } while (incidents_ && incidents_->write_some());
}

void RunRecords::write_words(const std::string& words) {
  if (incidents_) incidents_->write_words(words);
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
  if (incidents_) text += incidents_->summary();
  return text;
}

}  // namespace godobject::firmware
