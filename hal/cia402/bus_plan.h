#pragma once

#include <array>
#include <cstdint>

#include "hal/cia402/bus_layout.h"

namespace godobject::hal {

/// Worst case of one bus: every frame has its longest duration by bit stuffing, with the gap of 3 bits after it [ns].
struct BusLoad {
  int joints = 0;
  bool panel = false;
  std::int64_t sync_ns = 0;
  std::int64_t samples_ns = 0;   ///< TPDOs of drives and panel
  std::int64_t torques_ns = 0;   ///< RPDOs
  std::int64_t blocking_ns = 0;  ///< a heartbeat or a mode that is already on the wire
  std::int64_t end_ns = 0;       ///< end of the last RPDO, from the beginning of the cycle
  std::int64_t slot_ns = 0;      ///< end of the last RPDO after an SDO frame, less the blocking of the next SYNC
  std::int64_t late_ns = 0;      ///< time by which that SDO frame may delay samples beyond their collection
  double utilisation = 0.0;      ///< share of time with a frame on the wire, heartbeats and SDO included
  bool fits = false;             ///< `end_ns` and `slot_ns` are within the period
};

/// The time plan of a cycle on all buses.
///
/// On each bus there are SYNC, the TPDOs that answer it, the controller's computing time and the RPDOs. The drives
/// sample at the end of SYNC, queue their TPDOs the layout's `answer` later, and apply an RPDO at its end. All samples
/// are collected at one time, that of the slowest bus.
///
/// Frames of lower priority, in any number, cost one frame each time that the wire becomes idle: before SYNC, before
/// the samples if drives take time to answer, and before the RPDOs. These frames are heartbeats and modes, TPDO2
/// {6061}. An SDO exchange takes place every `read_back_interval`, at a distance from heartbeats. Its request
/// finds the wire idle after the samples; the drive sends the answer when it is ready. If one of these two frames falls
/// into a cycle, the last RPDO ends by `slot_ns` plus the blocking of SYNC. If both do, because a drive answers at
/// once, or if one is on the wire when SYNC is due, samples of the next cycle may be up to `late_ns` late.
///
/// Assumed: each node sends its most urgent frame first. Not counted: emergency messages, which lead to a stop anyway.
/// The layout's `drive_delay` counts for the delay, not for the wire.
struct BusPlan {
  std::array<BusLoad, kMaxBuses> buses{};  ///< the first `bus_count`
  BusTiming timing;
  std::array<std::int64_t, kMaxJoints>
      unblocked_ns{};                            ///< time from a joint's sample to its torque without blocking frames
  std::array<double, kMaxJoints> torque_step{};  ///< torque step of the joint: a permille of the rated torque [Nm]
  bool fits = false;                             ///< all buses fit
};

/// Longest duration of a data frame with 11 bit identifier and its gap, with the most stuff bits [ns]. `bytes`: of
/// data.
///
/// Classical, n bytes: 44 + 8 n bits, of which 34 + 8 n are stuffed, a bit after the first five and after each four
/// more, and 3 of gap: 55 + 10 n.
/// FD (ISO 11898-1): at the nominal rate SOF to BRS 17 with 4 stuff bits, CRC delimiter to gap 13; at the data rate ESI
/// and DLC 5, n bytes, 1 + 2 n stuff bits, stuff count 4, CRC 17 with 6 fixed stuff bits (beyond 16 bytes 21 with 7):
/// 34 nominal and 33 (38) + 10 n data bits.
std::int64_t longest_frame_ns(int bytes, bool fd, const BusLayout& layout) noexcept;

/// Shortest duration: without the stuff bits that depend on the frame's contents.
std::int64_t shortest_frame_ns(int bytes, bool fd, const BusLayout& layout) noexcept;

/// Plans a layout. Its joints and panel must be on its buses, and its rates positive. No heap, no exceptions; for the
/// start, not for the cycle.
BusPlan plan_buses(const BusLayout& layout) noexcept;

}  // namespace godobject::hal
