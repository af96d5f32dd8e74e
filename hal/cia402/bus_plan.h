#pragma once

#include <array>
#include <cstdint>

#include "hal/cia402/bus_layout.h"

namespace godobject::hal {

/// One bus in the worst case: every frame as long as bit stuffing can make it, with the gap of 3 bits after it [ns].
struct BusLoad {
  int joints = 0;
  bool panel = false;
  std::int64_t sync_ns = 0;
  std::int64_t samples_ns = 0;   ///< TPDOs of drives and panel
  std::int64_t torques_ns = 0;   ///< RPDOs
  std::int64_t blocking_ns = 0;  ///< a heartbeat or a mode that is on the wire already
  std::int64_t end_ns = 0;       ///< of the last RPDO, from the beginning of the cycle
  std::int64_t slot_ns = 0;      ///< end of the last RPDO behind an SDO frame, less what the next SYNC may wait for
  std::int64_t late_ns = 0;      ///< by how much that SDO frame may push samples beyond their collection
  double utilisation = 0.0;      ///< share of the time in which the wire is not idle, heartbeats and SDO included
  bool fits = false;             ///< neither `end_ns` nor `slot_ns` is beyond the period
};

/// What the buses carry in a cycle, and when.
///
/// On each bus: SYNC, the TPDOs that answer it, the controller's computing, the RPDOs. The drives sample at the end of
/// SYNC, have their TPDOs queued the layout's `answer` later, and apply an RPDO at its end. All samples are collected
/// at one time, that of the slowest bus. Frames of lower priority, of which there may be any number, cost one frame
/// wherever the wire falls idle: before SYNC, before the samples if drives take time to answer, and before the RPDOs.
/// These are heartbeats and modes, TPDO2 {6061}. An SDO exchange comes every `read_back_interval` cycles, when no
/// heartbeat is near: the request finds the wire idle behind the samples, the answer comes when the drive sends it. Of
/// the two frames one falls into a cycle: then the last RPDO ends by `slot_ns` and what SYNC may wait for a frame.
/// Where both do, because a drive answers at once, or where one is on the wire when SYNC is due, samples of the next
/// cycle may come up to `late_ns` too late. Assumed: each node sends the most urgent of its frames first. Not counted:
/// emergency messages (they end in a stop anyway). What a drive takes to act on a torque, and how old its position is
/// at SYNC, is the layout's `drive_delay`: it counts for the delay, not for the wire.
struct BusPlan {
  std::array<BusLoad, kMaxBuses> buses{};  ///< the first `bus_count`
  BusTiming timing;
  std::array<std::int64_t, kMaxJoints> unblocked_ns{};  ///< from a joint's sample to its torque without blocking frames
  std::array<double, kMaxJoints> torque_step{};         ///< of the joint: a permille of the rated torque [Nm]
  bool fits = false;                                    ///< all buses do
};

/// Length of a data frame with 11 bit identifier, its gap included, if stuffing is at its worst [ns]. `bytes`: of data.
///
/// Classical, n bytes: 44 + 8 n bits, of which 34 + 8 n are stuffed, a bit after the first five and after each four
/// more, and 3 of gap: 55 + 10 n.
/// FD (ISO 11898-1): at the nominal rate SOF to BRS 17 with 4 stuff bits, CRC delimiter to gap 13; at the data rate ESI
/// and DLC 5, n bytes, 1 + 2 n stuff bits, stuff count 4, CRC 17 with 6 fixed stuff bits (beyond 16 bytes 21 with 7):
/// 34 nominal and 33 (38) + 10 n data bits.
std::int64_t longest_frame_ns(int bytes, bool fd, const BusLayout& layout) noexcept;

/// The same without the stuff bits that depend on what is in the frame.
std::int64_t shortest_frame_ns(int bytes, bool fd, const BusLayout& layout) noexcept;

/// The plan of a layout whose joints and panel are on its buses and whose rates are positive. No heap, no exceptions;
/// for the start, not for the cycle.
BusPlan plan_buses(const BusLayout& layout) noexcept;

}  // namespace godobject::hal
