#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/scene/scene_view.h"
#include "firmware/configuration/controller_file.h"
#include "firmware/configuration/scene_file.h"
#include "firmware/cycle/control_cycle.h"
#include "firmware/drives/drive_link.h"
#include "firmware/loop/controller_run.h"
#include "firmware/loop/telemetry_ring.h"
#include "firmware/records/run_records.h"
#include "hal/can_log_ring.h"
#include "toolchain/files/aligned_bytes.h"

namespace godobject::firmware {

class Companion;
class OperatorNotice;

/// Settings of a run that `Session::change` replaces while it goes on.
struct Rendering {
  Solver solver = Solver::kContact;
  bool friction = false;
  double stiffness = 0.0;  ///< k_D [N/m]
  double damping = 0.0;    ///< b_D [Ns/m]
};

/// One run of the controller, from checked files to the stopped drives. It owns everything that the loop uses: scene,
/// rings, drives, cycle, report. Large: make it on the heap, before the loop.
class Session {
 public:
  /// Reads the scene image, checks the gains, connects the drives and prepares the cycle. Prints warnings and the gain
  /// line. No drive is started. Throws command::Failure with the codes of `godobject-controller --help`.
  Session(const ControllerConfig& config, const std::string& transport);

  /// Starts the drives, runs the loop until the supervisor has ended it, stops the drives and prints the summary.
  /// `duration` [s]; none: with a simulated path half a second longer than that, else until `requests.end`.
  /// Returns the fault that stopped the run, with its place; empty: none did. Throws command::Failure if the drives
  /// cannot be started, a right is missing or a log cannot be made.
  std::string run(const std::optional<double>& duration, RunRequests& requests);

  /// The same until `requests.end`, accompanied. No file is written. Throws command::Failure (kInternal) before any
  /// drive is started if the arm is not simulated in virtual time.
  std::string run(Companion& companion, RunRequests& requests);

  /// Renders with another solver or other gains from the next cycle on; the god object goes on from its place.
  /// Only for a Companion, between two cycles. The gain check is not made. Returns false, without effect, if image or
  /// build lack the solver or friction, or if a gain is out of the range of an image.
  bool change(const Rendering& rendering) noexcept;

  Rendering rendering() const noexcept;
  const Placement& placement() const noexcept { return placement_; }
  double delay() const noexcept { return delay_; }  ///< from the sample of a position to the torque [s]

 private:
  void start_cycle();
  std::uint64_t work_budget(const CycleSetup& setup) const;
  std::uint64_t measured_budget(const CycleSetup& setup, double seconds) const;
  RunRecords::Setup records_setup() const;
  RunSetup run_setup(const std::optional<double>& duration, hal::Clock& stopwatch) const;
  bool run_loop(const RunSetup& setup, RunRequests& requests, RunRecords& records);
  void run_accompanied(const RunSetup& setup, hal::Clock& clock, RunRequests& requests, Companion& companion);
  void run_in_virtual_time(const RunSetup& setup, hal::Clock& clock, RunRequests& requests, RunRecords& records,
                           OperatorNotice& notice);
  std::string describe_stop() const;

  ControllerConfig config_;
  SceneFile image_;
  SceneView scene_;  // of the image, with the gains of the controller file
  Placement placement_;
  TelemetryRing ring_;
  hal::CanLogRing bus_ring_;
  RunReport report_;
  std::unique_ptr<DriveLink> link_;
  double delay_ = 0.0;                         // of the drives [s]
  std::optional<files::AlignedBytes> memory_;  // of the god object
  std::optional<ControlCycle> cycle_;
  std::optional<long> page_faults_;  // of the loop's thread, in a real-time run
};

}  // namespace godobject::firmware
