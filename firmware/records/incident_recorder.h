#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "firmware/loop/telemetry_ring.h"
#include "firmware/records/log_file.h"
#include "firmware/records/recent_frames.h"
#include "firmware/records/record_folder.h"
#include "firmware/records/telemetry_rows.h"
#include "hal/can_log_ring.h"

namespace godobject::firmware {

/// Keeps the last 30 s of telemetry and frames in memory, and writes them to a new folder when a fault stops the arm.
/// The record goes on until the operator resets the fault or the run ends, for 60 s at most, so its size is bounded. It
/// is the work of a thread beside the loop: not real-time safe.
///
/// The folder has telemetry.csv with a row each cycle, can.log with all frames (`candump -L`), and the files of the
/// setup.
class IncidentRecorder {
 public:
  static constexpr std::int64_t kBefore_ns = 30'000'000'000;
  /// Chosen: the drives are at rest after 1 s; an arm that stays stopped for a night must not fill the disk.
  static constexpr std::int64_t kAfter_ns = 60'000'000'000;
  /// Room that a record needs on the disk [bytes]. Chosen: 90 s of seven joints on three buses at 1 kHz take some
  /// 140 MB, and shorter periods as much more as they are shorter. `period`: T [s].
  static std::uintmax_t least_room(double period) noexcept {
    return static_cast<std::uintmax_t>(200e6 * std::max(1.0, 1e-3 / period));
  }

  struct Setup {
    std::filesystem::path folder{};        ///< of all incidents
    std::string name{};                    ///< of the incident's folder; empty: the time of the stop in UTC
    TelemetryFormat format = {};           ///< of the telemetry
    std::vector<std::string> bus_names{};  ///< bus 0 first
    std::vector<RecordFile> facts{};       ///< written into each incident's folder
    std::uintmax_t least_room = 0;         ///< with less room on the disk nothing is written [bytes]
    std::function<void(const std::string&)> say = [](const std::string&) {};  ///< a line for the operator
  };

  explicit IncidentRecorder(Setup setup) : setup_(std::move(setup)) {}

  /// Takes the next cycle. A fault that is new begins an incident, unless the operator released the enable switch.
  void add(const TelemetryRecord& record);

  /// Takes the next frame, of the last cycle that was taken.
  void add(const hal::LoggedFrame& frame) { frames_.push(last_ns_, frame); }

  /// Writes a bounded part of the rows and frames that an incident still lacks. False: it lacks none.
  bool write_some();

  /// Writes words about the stop, words.txt, into the folder of the incident whose fault is not reset yet; without
  /// effect if there is none.
  void write_words(const std::string& words);

  /// One line for each incident. Each line ends with a line feed.
  std::string summary() const;

 private:
  struct Incident {
    Incident(const Setup& setup, const TelemetryRecord& stop);

    RecordFolder folder;
    std::int64_t ends_ns;
    std::optional<LogFile> telemetry;  // none: the record is complete
    std::optional<LogFile> frames;
  };

  void begin(const TelemetryRecord& stop);
  void end();
  void say(const std::string& line) const noexcept;
  void drop_old();
  void write_rows(LogFile& file);
  void write_frames(LogFile& file);
  bool is_written() const;

  Setup setup_;
  std::deque<TelemetryRecord> rows_;
  std::size_t next_row_ = 0;  // to be written, of rows_
  RecentFrames frames_;
  std::int64_t last_ns_ = 0;  // time of the last cycle
  bool has_fault_ = false;
  std::unique_ptr<Incident> incident_;  // null: no fault, or it could not be recorded
  std::string text_;
  std::string summary_;
};

}  // namespace godobject::firmware
