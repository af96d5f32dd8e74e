#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "firmware/loop/telemetry_ring.h"
#include "firmware/records/bus_log_writer.h"
#include "firmware/records/hand_log.h"
#include "firmware/records/incident_recorder.h"
#include "firmware/records/record_folder.h"
#include "firmware/records/telemetry_rows.h"
#include "firmware/records/telemetry_writer.h"
#include "hal/can_log_ring.h"

namespace godobject::firmware {

/// The records of a run. Logs, in a folder of their own: telemetry.csv, the facts of the run and, if asked for, the log
/// of the buses and hand.csv. Incidents: the time around each stop.
class RunRecords {
 public:
  struct Setup {
    std::filesystem::path folder{};     ///< of the logs of all runs; empty: no logs
    std::filesystem::path incidents{};  ///< of all incidents; empty: in the folder of the run, if it has one
    bool needs_incidents = true;        ///< false: a folder of incidents that cannot be made is only said
    std::chrono::system_clock::time_point start{};  ///< of the run
    TelemetryFormat format = {};                    ///< of the telemetry
    double period = 1e-3;                           ///< T [s]
    std::uint32_t every = 1;                        ///< cycles a row of the log; an incident has each cycle
    bool buses = false;                             ///< the frames on the buses are logged, too
    std::vector<std::string> bus_names{};           ///< bus 0 first
    bool hand = false;                              ///< the work of the simulated hand is logged, too
    std::vector<RecordFile> facts{};                ///< versions, limits and input files of the run
    std::function<void(const std::string&)> say = [](const std::string&) {};  ///< a line for the operator
  };

  /// Makes the folder of the run with its files, and lets the links in `setup.folder` lead to them. The rings outlive
  /// this. Throws command::Failure (kIo) if a file cannot be made.
  RunRecords(Setup setup, TelemetryRing& ring, hal::CanLogRing& bus_ring);

  /// False: nothing is recorded, and `drain` need not be called.
  bool any() const noexcept { return telemetry_ || incidents_; }

  HandLog* hand() const noexcept { return hand_.get(); }  ///< null: this log is not written

  /// Writes all records that are in the rings. Without effect if nothing is recorded.
  void drain();

  /// Drains every 50 ms until it is asked to stop: the work of a thread beside the loop.
  void run(const std::stop_token& stop) { drain_until_stopped(*this, stop); }

  /// Adds the words about a stop to its incident, after the last `drain`.
  void write_words(const std::string& words);

  /// One line a log or incident: its file or folder, the number of records written and lost. Each line ends with a line
  /// feed.
  std::string summary() const;

 private:
  void take();

  TelemetryRing& ring_;
  hal::CanLogRing& bus_ring_;
  std::unique_ptr<TelemetryWriter> telemetry_;
  std::unique_ptr<BusLogWriter> buses_;
  std::unique_ptr<HandLog> hand_;
  std::unique_ptr<IncidentRecorder> incidents_;
};

}  // namespace godobject::firmware
