#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/can_bus.h"
#include "hal/canopen/object_numbers.h"
#include "hal/cia402/alarm_latch.h"
#include "hal/cia402/bring_up.h"
#include "hal/cia402/bus_layout.h"
#include "hal/cia402/can_statistics.h"
#include "hal/cia402/joint_channel.h"
#include "hal/cia402/parameter_watch.h"
#include "hal/cia402/stations.h"
#include "hal/clock.h"
#include "hal/frame_tap.h"
#include "hal/joint_drives.h"

namespace godobject::hal {

/// CiA 402 drives in cyclic synchronous torque mode over one or several CANopen buses, and the operator's panel.
///
/// A cycle: `request` sends SYNC, the first frame on each bus. `receive` takes the received frames, at most kMostFrames
/// a bus. A sample belongs to this cycle if and only if it follows the own echo of this cycle's SYNC; an earlier one is
/// late and not used. `send` sends RPDO1 to each joint. One more frame may use the wire between samples and torques:
/// every `drive_heartbeat` the controller's heartbeat; else, about every `read_back_interval` and at a distance
/// from the nodes' heartbeats, an SDO request. It is handed over right after SYNC, or after the collection if the
/// drives' `answer` leaves the wire idle before. A mode, TPDO2, counts whenever it arrives.
///
/// Nothing is queued for later. On a bus whose last SYNC has not returned, neither torques nor another SYNC are handed
/// over for kHeldCycles. Then the missing SYNC is given up and a new one is tried.
///
/// A start ends with a probe of kProbeCycles, during which drives are still kUnavailable: after the last of some SYNCs
/// no sample may arrive any more. A drive that answers a SYNC only after the next one would always be one period late.
///
/// A drive without a sample for `heartbeat_timeout` is kUnavailable; before that it keeps its last state. Without a
/// panel the enable switch is never held.
///
/// Alarms: see `Alarm`; `alarm_detail` gives the cause. Frames of other nodes: SYNC, RPDOs, the controller's heartbeat
/// and SDO reads raise kForeignMaster, NMT and SDO writes kForeignWrite. An emergency message raises an alarm unless
/// canopen::is_warning. Five unanswered requests in a row to a drive for its watched parameters raise
/// kParameterChanged. A drive's temperature is read with them, about once a second: kTooHot, and kTemperatureLost after
/// three requests without an answer, last as long as their cause. PowerRequest kReset clears the alarm when it begins,
/// but not kNodeReset, kForeignWrite, kParameterChanged and kAnswersLate, which need a new start.
///
/// All functions but `bring_up` and `stop_nodes` are real-time safe. Cost without the bus objects: 1 us a cycle with
/// seven joints.
class CanDrives final : public JointDrives {
 public:
  static constexpr int kMostFrames = 64;                ///< taken from a bus in a cycle
  static constexpr int kMostBadFrames = 3;              ///< in a row of one joint
  static constexpr std::uint32_t kMostUnreturned = 32;  ///< frames: those of three cycles, with heartbeats and SDO
  // cycles at 1 ms and at longer periods; at shorter ones as many milliseconds
  static constexpr int kHeldCycles = 10;  ///< for which a SYNC's echo is waited for
  static constexpr int kProbeCycles = 8;  ///< after a start
  static constexpr int kProbeSilent = 4;  ///< of these, the last ones: without SYNC

  /// `buses`: one for each bus of the layout; they and the tap outlive this. The layout has been checked: buses and
  /// nodes exist, and node numbers are unique on each bus and not 127.
  CanDrives(const BusLayout& layout, std::span<CanBus* const> buses, const BusTiming& timing,
            FrameTap* tap = nullptr) noexcept;

  // never on the heap by itself: this library links no heap function, not even for an unused virtual destructor
  static void* operator new(std::size_t) = delete;
  static void operator delete(void*) noexcept {}

  /// Starts all nodes, see `hal::bring_up`, and forgets their earlier state.
  BringUpResult bring_up(Clock& clock, const std::atomic<bool>* end = nullptr) noexcept;

  /// Sends NMT stop to all nodes, for the end. Sends nothing if the start was refused because of a second master, or if
  /// it ended before its first frame: then the nodes may obey another controller.
  void stop_nodes() noexcept;

  int joint_count() const noexcept override { return layout_.joint_count; }
  void request() noexcept override;
  std::int64_t collect_ns() const noexcept override { return timing_.collect_ns; }
  void receive(JointReading& reading) noexcept override;
  bool send(const JointCommand& command) noexcept override;
  double delay() const noexcept override { return timing_.delay_s; }

  /// Omits the RPDOs to a joint while no power is requested, to test its deadline; -1: to no joint.
  void withhold(int joint) noexcept { withheld_ = joint; }

  const CanStatistics& statistics() const noexcept { return statistics_; }
  const cia402::AlarmDetail& alarm_detail() const noexcept { return alarm_.first(); }

 private:
  struct Bus {
    CanBus* wire = nullptr;
    bool asked{};                // SYNC was sent in this cycle
    bool holds{};                // no SYNC and no torque is handed over in this cycle
    int held{};                  // such cycles in a row
    int since_sdo = 0;           // cycles
    std::uint32_t unechoed = 0;  // SYNCs without an echo so far
    std::int64_t echo_ns{};      // time stamps of this cycle's SYNC and of its last sample
    std::int64_t sample_ns{};
    cia402::ParameterWatch watch;
  };
  struct Joint {
    cia402::JointChannel channel;
    bool fresh = false;
    std::uint32_t age = 0;
    int bad_frames = 0;  // in a row
    int silent = 0;      // cycles since its heartbeat
    std::int8_t mode = canopen::kModeTorque;
  };
  struct Panel {
    bool fresh = false;
    bool seen = false;  // since the start
    int lost = 0;
    int silent = 0;  // cycles since its heartbeat
    std::uint8_t inputs = 0;
  };

  void restart() noexcept;
  Joint& joint(int i) noexcept { return joints_[static_cast<std::size_t>(i)]; }
  SendResult send_on(int bus, const CanFrame& frame) noexcept;
  void check_health() noexcept;
  void check_temperature(int joint) noexcept;
  void drain(int bus) noexcept;
  void take_own(Bus& bus, const ReceivedFrame& received) noexcept;
  void take(int bus, const ReceivedFrame& received) noexcept;
  void take_foreign_master(int bus, const CanFrame& frame) noexcept;
  void take_sample(int bus, int station, const ReceivedFrame& received) noexcept;
  void take_mode(int joint, const CanFrame& frame) noexcept;
  void take_emergency(int bus, int station, const CanFrame& frame) noexcept;
  void take_heartbeat(int bus, int station, const CanFrame& frame) noexcept;
  void close_joint(int i) noexcept;
  void close_panel() noexcept;
  void begin_reset() noexcept;
  bool heartbeat_is_near(int bus) const noexcept;
  void send_heartbeat_or_sdo() noexcept;
  int joint_of(int station) const noexcept { return station == cia402::kPanelStation ? -1 : station; }

  BusLayout layout_;
  BusTiming timing_;
  FrameTap* tap_;
  cia402::Stations stations_;
  int heartbeat_cycles_;
  int timeout_cycles_;
  int read_back_cycles_;
  int held_cycles_;
  int probe_cycles_;
  int probe_silent_;
  int near_heartbeat_;  // cycles before a heartbeat in which no SDO exchange begins
  int most_panel_lost_;
  std::array<Bus, kMaxBuses> buses_{};
  std::array<Joint, kMaxJoints> joints_{};
  Panel panel_;
  JointReading reading_;
  cia402::AlarmLatch alarm_;
  CanStatistics statistics_;
  PowerRequest power_{};
  bool sync_failed_{};
  bool anothers_ = false;  // the nodes obey, or may obey, a second master
  int withheld_ = -1;
  int probe_{};         // remaining cycles of the probe
  int to_heartbeat_{};  // cycles until the next heartbeat
};

}  // namespace godobject::hal
