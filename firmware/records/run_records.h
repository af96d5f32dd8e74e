#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "firmware/loop/telemetry_ring.h"
#include "firmware/records/bus_log_writer.h"
#include "firmware/records/hand_log.h"
#include "firmware/records/telemetry_writer.h"
#include "hal/can_log_ring.h"

namespace godobject::firmware {

/// The logs of a run, in a folder of their own: telemetry.csv and, if asked for, the log of the buses and hand.csv.
class RunRecords {
 public:
  struct Setup {
    std::filesystem::path folder;                   ///< of the logs of all runs; empty: nothing is written
    std::chrono::system_clock::time_point start{};  ///< of the run
    int joint_count = 0;
    bool buses = false;                  ///< the frames on the buses are logged, too
    std::vector<std::string> bus_names;  ///< bus 0 first
    bool hand = false;                   ///< the work of the simulated hand is logged, too
  };

  /// Makes the folder of the run with its files, and lets the links in `setup.folder` lead to them. The rings outlive
  /// this. Throws command::Failure (kIo) if a file cannot be made.
  RunRecords(const Setup& setup, TelemetryRing& ring, hal::CanLogRing& bus_ring);

  /// The writers, to be run on threads of their own; null: this log is not written.
  TelemetryWriter* telemetry() const noexcept { return telemetry_.get(); }
  BusLogWriter* buses() const noexcept { return buses_.get(); }
  HandLog* hand() const noexcept { return hand_.get(); }

  /// Writes all records that are in the rings.
  void drain() const;

  /// One line a log: its file, the number of records written and lost. Each line ends with a line feed.
  std::string summary() const;

 private:
  const TelemetryRing& ring_;
  const hal::CanLogRing& bus_ring_;
  std::unique_ptr<TelemetryWriter> telemetry_;
  std::unique_ptr<BusLogWriter> buses_;
  std::unique_ptr<HandLog> hand_;
};

}  // namespace godobject::firmware
