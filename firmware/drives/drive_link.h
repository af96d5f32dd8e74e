#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "hal/clock.h"
#include "hal/joint_drives.h"

namespace godobject::firmware {

class SimulatedArm;

/// The result of `DriveLink::commission`.
struct CommissioningReport {
  std::string table;      ///< one line a joint, for the user; each ends with a line feed
  std::string keys;       ///< keys that the drives themselves tell, to paste into the device file; empty: none
  std::string objection;  ///< the joints that failed and what to do, without a line feed; empty: all passed
};

/// The connected drives of an arm: what a drive family offers to a session. `DriveFamily::connect` makes it before the
/// loop. In the loop only `drives()` is used, and the number behind `round_trip_ns()`; all other functions allocate,
/// wait or write text.
class DriveLink {
 public:
  virtual ~DriveLink() = default;
  DriveLink(const DriveLink&) = delete;
  DriveLink& operator=(const DriveLink&) = delete;

  /// The joints for the control cycle; valid as long as the link.
  virtual hal::JointDrives& drives() noexcept = 0;

  /// The simulated arm behind the link; null: the arm is real.
  virtual SimulatedArm* simulated_arm() noexcept = 0;

  /// True: the loop keeps to the machine's clock, on a real-time thread. False: it runs in virtual time.
  virtual bool real_time() const noexcept = 0;

  /// The clock that the loop sleeps on. The link outlives it.
  virtual std::unique_ptr<hal::Clock> make_clock() = 0;

  /// Names of the buses, bus 0 first; empty if the family has none.
  virtual const std::vector<std::string>& bus_names() const noexcept = 0;

  /// One line for each finding of `connect` that does not forbid a run.
  virtual const std::vector<std::string>& warnings() const noexcept = 0;

  /// Brings the drives from any state to one in which they answer `drives().request()`. No torque, no power.
  /// False: `end` became true first, and the drives are stopped. Throws command::Failure (kUnavailable) naming drive
  /// and cure if they cannot be started.
  virtual bool start(hal::Clock& clock, const std::atomic<bool>& end) = 0;

  /// Ends the communication that `start` began. The supervisor has taken the power away before.
  virtual void stop() noexcept = 0;

  /// Time from the request of the last cycle to its last sample [ns]; 0: not known. A reference, so that the loop reads
  /// it each cycle without a virtual call; valid as long as the link.
  virtual const std::int64_t& round_trip_ns() const noexcept = 0;

  /// Transport figures since `start`, for the end of a run. Each line ends with a line feed; empty if there are none.
  virtual std::string statistics() const = 0;

  /// The alarm of the present reading as one clause: where, what, numbers, cure.
  virtual std::string alarm() const = 0;

  /// Tests, without power and after `start`, that each drive stops by itself when the controller falls silent. Throws
  /// command::Failure (kUnavailable) if a test cannot be run or `end` becomes true.
  virtual CommissioningReport commission(hal::Clock& clock, const std::atomic<bool>& end) = 0;

 protected:
  DriveLink() = default;
};

}  // namespace godobject::firmware
