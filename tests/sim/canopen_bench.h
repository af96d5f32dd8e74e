#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "sim/canopen_node.h"

namespace godobject::test {

inline constexpr std::int64_t kMs = 1'000'000;  // [ns]

inline hal::CanFrame can_frame(int id, std::initializer_list<int> bytes) {
  hal::CanFrame frame;
  frame.id = static_cast<std::uint16_t>(id);
  for (const int byte : bytes) frame.data.at(frame.length++) = static_cast<std::uint8_t>(byte);
  return frame;
}

inline std::vector<int> bytes_of(const hal::CanFrame& frame) {
  return {frame.data.begin(), frame.data.begin() + frame.length};
}

/// Returns true if the frame has this identifier and exactly these bytes.
inline bool is(const hal::CanFrame& frame, int id, std::initializer_list<int> bytes) {
  return frame.id == id && bytes_of(frame) == std::vector<int>(bytes);
}

/// A request of an expedited SDO: `bytes` 0 reads.
inline hal::CanFrame sdo_request(int node, int index, int sub, int bytes, std::uint32_t value) {
  hal::CanFrame frame = can_frame(
      0x600 + node, {bytes == 0 ? 0x40 : 0x23 | ((4 - bytes) << 2), index & 0xFF, index >> 8, sub, 0, 0, 0, 0});
  for (int i = 0; i < bytes; ++i)
    frame.data.at(static_cast<std::size_t>(4 + i)) = static_cast<std::uint8_t>(value >> (8 * i));
  return frame;
}

inline std::uint32_t last_four(const hal::CanFrame& frame) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value |= static_cast<std::uint32_t>(frame.data.at(4 + i)) << (8 * i);
  return value;
}

/// A node alone, in time that the test sets.
template <class Node>
struct NodeBench {
  Node& node;
  std::int64_t now_ns = 0;

  std::vector<hal::CanFrame> sent() {
    std::vector<hal::CanFrame> frames;
    hal::CanFrame frame;
    while (node.take_frame(frame)) frames.push_back(frame);
    return frames;
  }
  std::vector<hal::CanFrame> put(const hal::CanFrame& frame) {
    node.receive(frame, now_ns);
    return sent();
  }
  hal::CanFrame sdo(int index, int sub, int bytes = 0, std::uint32_t value = 0) {
    const auto answers = put(sdo_request(node.number(), index, sub, bytes, value));
    return answers.size() == 1 ? answers[0] : hal::CanFrame{};
  }
  /// The abort code of a write; 0: done.
  std::uint32_t write(int index, int sub, int bytes, std::uint32_t value) {
    const hal::CanFrame answer = sdo(index, sub, bytes, value);
    return answer.data[0] == 0x60 ? 0 : last_four(answer);
  }
  std::uint32_t read(int index, int sub = 0) { return last_four(sdo(index, sub)); }

  /// To boot-up and what comes after; all frames on the way are dropped.
  void boot() {
    node.set_supply(true, now_ns);
    now_ns += sim::CanopenNode::kBoot_ns;
    node.run_timers(now_ns);
    sent();
  }
};

}  // namespace godobject::test
