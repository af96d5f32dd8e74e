#include "firmware/records/incident_recorder.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <utility>

#include <fmt/format.h>

#include "firmware/cycle/fault.h"
#include "firmware/records/bus_log_writer.h"
#include "firmware/records/telemetry_rows.h"

namespace godobject::firmware {
namespace {

constexpr std::size_t kRowsOfAPart = 512;     // chosen: some 5 ms of formatting, much less than the rings hold
constexpr std::size_t kFramesOfAPart = 8192;  // chosen: the frames of as many cycles

/// The stop as a table of run.toml.
std::string stop_table(const TelemetryRecord& stop) {
  return fmt::format("\n[stop]\nutc = \"{}\"\nt_s = {:.6f}\nfault = {}\n", run_name(std::chrono::system_clock::now()),
                     1e-9 * static_cast<double>(stop.times.deadline_ns), static_cast<int>(stop.cycle.fault));
}

}  // namespace

IncidentRecorder::Incident::Incident(const Setup& setup, const TelemetryRecord& stop)
    : folder(setup.folder, setup.name.empty() ? run_name(std::chrono::system_clock::now()) : setup.name),
      ends_ns(stop.times.deadline_ns + kAfter_ns),
      telemetry(folder.create("telemetry.csv")) {
  telemetry->write(telemetry_header(setup.format.joint_count), 0);
  if (!setup.bus_names.empty()) frames.emplace(folder.create("can.log"));
  for (const RecordFile& fact : setup.facts) {
    folder.create(fact.name).write(fact.name == kRunFile ? fact.text + stop_table(stop) : fact.text, 1);
  }
}

void IncidentRecorder::add(const TelemetryRecord& record) {
  last_ns_ = record.times.deadline_ns;
  rows_.push_back(record);
  drop_old();
  // who releases the enable switch ends the work: that is no incident, and happens many times a day
  const bool has_fault = record.cycle.fault != Fault::kNone && record.cycle.fault != Fault::kEnableReleased;
  if (has_fault_ && !has_fault) end();
  if (!has_fault_ && has_fault) begin(record);
  has_fault_ = has_fault;
}

void IncidentRecorder::drop_old() {
  const std::int64_t first_ns = last_ns_ - kBefore_ns;
  const bool writes = incident_ && incident_->telemetry;
  while (rows_.front().times.deadline_ns < first_ns && !(writes && next_row_ == 0)) {
    rows_.pop_front();
    next_row_ -= std::min<std::size_t>(next_row_, 1);
  }
  frames_.drop_before(first_ns, writes);
}

void IncidentRecorder::begin(const TelemetryRecord& stop) {
  try {
    if (const std::uintmax_t room = room_on_disk(setup_.folder); room < setup_.least_room) {
      say(fmt::format("the stop is not recorded: {} has {} MB left, less than {} MB; make room on the disk",
                      setup_.folder.string(), room / 1'000'000, setup_.least_room / 1'000'000));
      return;
    }
    incident_ = std::make_unique<Incident>(setup_, stop);
  } catch (const std::exception& failure) {
    say(fmt::format("the stop is not recorded: {}", failure.what()));
    return;
  }
  next_row_ = 0;
  frames_.rewind();
  say(fmt::format("the stop is recorded in {0}; read it with godobject-controller explain {0}",
                  incident_->folder.path().string()));
}

/// A line for the operator. If it cannot be said, the records go on.
void IncidentRecorder::say(const std::string& line) const noexcept {
  try {
    setup_.say(line);
  } catch (...) {
  }
}

/// Completes the record.
void IncidentRecorder::end() {
  if (!incident_) return;
  while (write_some()) {
  }
  summary_ = summary();
  incident_.reset();
}

bool IncidentRecorder::write_some() {
  if (!incident_ || !incident_->telemetry) return false;
  write_rows(*incident_->telemetry);
  if (incident_->frames) write_frames(*incident_->frames);
  if (!is_written()) return true;
  if (last_ns_ >= incident_->ends_ns) {
    summary_ = summary();
    incident_->telemetry.reset();
    incident_->frames.reset();
  }
  return false;
}

void IncidentRecorder::write_rows(LogFile& file) {
  const std::size_t end = std::min(rows_.size(), next_row_ + kRowsOfAPart);
  const std::size_t count = end - next_row_;
  text_.clear();
  for (; next_row_ < end; ++next_row_) append_telemetry_row(rows_[next_row_], setup_.format, text_);
  file.write(text_, count);
}

void IncidentRecorder::write_frames(LogFile& file) {
  std::size_t count = 0;
  text_.clear();
  for (hal::LoggedFrame frame; count < kFramesOfAPart && frames_.take(frame); ++count) {
    append_candump_line(frame.received, setup_.bus_names.at(static_cast<std::size_t>(frame.bus)), text_);
  }
  file.write(text_, count);
}

bool IncidentRecorder::is_written() const {
  return next_row_ == rows_.size() && (!incident_->frames || frames_.all_taken());
}

void IncidentRecorder::write_words(const std::string& words) {
  if (!incident_ || words.empty()) return;
  try {
    incident_->folder.create("words.txt").write(words + "\n", 1);
  } catch (const std::exception& failure) {
    say(failure.what());
  }
}

std::string IncidentRecorder::summary() const {
  if (!incident_ || !incident_->telemetry) return summary_;
  const std::optional<LogFile>& frames = incident_->frames;
  return summary_ + fmt::format("{}: {} rows, {} frames, {} lost\n", incident_->folder.path().string(),
                                incident_->telemetry->written(), frames ? frames->written() : 0,
                                incident_->telemetry->lost() + (frames ? frames->lost() : 0));
}

}  // namespace godobject::firmware
