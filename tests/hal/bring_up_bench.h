#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "hal/cia402/bring_up.h"
#include "tests/hal/scripted_node.h"

namespace godobject::hal {

inline constexpr std::int64_t kSecond_ns = 1'000'000'000;

/// Two buses: joints 0 and 2 as nodes 1 and 2 on the first, joint 1 as node 1 on the second with the panel, node 32.
class BringUpTest : public testing::Test {
 protected:
  BringUpTest() {
    layout_.bus_count = 2;
    layout_.joint_count = 3;
    layout_.drives[0] = {.bus = 0, .node = 1, .rated_torque = 20.0};
    layout_.drives[1] = {.bus = 1, .node = 1, .rated_torque = 1.5, .torque_limit = 1.5};
    layout_.drives[2] = {.bus = 0, .node = 2, .rated_torque = 0.25};
    layout_.panel = {.bus = 1, .node = 32};
  }

  BringUpResult start() { return bring_up(layout_, wires_, world_, nullptr); }

  /// No frame that could give torque or power was sent.
  bool sent_no_command() const {
    return std::ranges::none_of(world_.log,
                                [](const CanFrame& frame) { return frame.id >= 0x200 && frame.id < 0x580; });
  }

  BusLayout layout_;
  FakeBus first_;
  FakeBus second_;
  std::array<CanBus*, 2> wires_ = {&first_, &second_};
  ScriptedNode joint_0_ = scripted_drive(1, 20000);
  ScriptedNode joint_1_ = scripted_drive(1, 1500);
  ScriptedNode joint_2_ = scripted_drive(2, 250);
  ScriptedNode panel_ = scripted_panel(32);
  ScriptedWorld world_{{{&first_, &joint_0_}, {&first_, &joint_2_}, {&second_, &joint_1_}, {&second_, &panel_}}};
};

}  // namespace godobject::hal
