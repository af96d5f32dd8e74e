#pragma once

#include <cstdint>

#include "hal/can_frame.h"
#include "hal/canopen/object_numbers.h"

/// Network management of CiA 301: NMT, SYNC, heartbeat and boot-up. Pure functions, real-time safe.
namespace godobject::hal::canopen {

inline constexpr std::uint16_t kCobTime = 0x100;
inline constexpr std::uint16_t kCobRpdo4 = 0x500;
inline constexpr std::uint16_t kCobLssMaster = 0x7E5;
inline constexpr int kMaxNode = 127;
inline constexpr int kControllerNode = 127;  ///< node number of the controller, whose heartbeat the drives watch

constexpr std::uint16_t cob(Cob base, int node) noexcept { return static_cast<std::uint16_t>(base + node); }

/// The node of a COB-ID, 1 to 127, if it is `base` plus a node; else 0.
constexpr int node_of(std::uint16_t id, std::uint16_t base) noexcept {
  return id > base && id <= base + kMaxNode ? id - base : 0;
}

/// An NMT command to one node, or to all nodes with 0.
constexpr CanFrame nmt_frame(NmtCommand command, int node) noexcept {
  CanFrame frame{kCobNmt, 2};
  frame.data[0] = command;
  frame.data[1] = static_cast<std::uint8_t>(node);
  return frame;
}

/// SYNC without a counter (1019 is 0).
constexpr CanFrame sync_frame() noexcept { return CanFrame{kCobSync, 0}; }

constexpr CanFrame heartbeat_frame(int node, NmtState state) noexcept {
  CanFrame frame{cob(kCobHeartbeat, node), 1};
  frame.data[0] = state;
  return frame;
}

/// A node's heartbeat. With kNmtBoot it is the boot-up message.
struct Heartbeat {
  int node = 0;
  NmtState state = kNmtBoot;
};

/// Parses a frame. False: it is no valid heartbeat.
bool parse_heartbeat(const CanFrame& frame, Heartbeat& heartbeat) noexcept;

/// True if only a master may send this COB-ID: NMT, SYNC, TIME, RPDOs, SDO requests, LSS, and the controller's
/// heartbeat.
bool is_of_master(std::uint16_t id) noexcept;

}  // namespace godobject::hal::canopen
