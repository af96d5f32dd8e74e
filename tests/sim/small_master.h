#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "sim/can_device.h"
#include "tests/sim/canopen_bench.h"

namespace godobject::test {

/// The least of a master: start-up, then a SYNC and a torque for each joint a cycle. It checks what it reads itself.
class SmallMaster {
 public:
  struct Reading {
    int statusword = 0;
    std::int32_t counts = 0;
    int torque_permille = 0;
    std::int64_t time_ns = -1;
  };

  SmallMaster(const hal::BusLayout& layout, sim::CanDevice& device) : layout_(layout), device_(device) {}

  std::vector<hal::ReceivedFrame> drain(int bus) {
    std::vector<hal::ReceivedFrame> frames;
    hal::ReceivedFrame frame;
    while (device_.bus(bus).receive(frame)) frames.push_back(frame);
    return frames;
  }

  /// False: it was refused, or not answered within 5 ms.
  bool write(int bus, int node, int index, int sub, int bytes, std::uint32_t value) {
    drain(bus);
    if (device_.bus(bus).send(sdo_request(node, index, sub, bytes, value)) != hal::SendResult::kSent) return false;
    for (int i = 0; i < 5; ++i) {
      device_.advance_to(device_.now_ns() + 1'000'000);
      for (const hal::ReceivedFrame& received : drain(bus)) {
        if (received.frame.id == 0x580 + node) return received.frame.data[0] == 0x60;
      }
    }
    return false;
  }

  /// All nodes operational, at a multiple of the period.
  bool start() {
    device_.advance_to(100'000'000);
    bool good = true;
    const auto deadline_ms = static_cast<std::uint32_t>(std::lround(1e3 * layout_.command_deadline));
    for (int i = 0; i < layout_.joint_count; ++i) {
      const hal::DriveConfig& drive = layout_.drives.at(static_cast<std::size_t>(i));
      const auto node = static_cast<std::uint32_t>(drive.node);
      const auto set = [&](int index, int sub, int bytes, std::uint32_t value) {
        good = write(drive.bus, drive.node, index, sub, bytes, value) && good;
      };
      set(0x1400, 1, 4, 0x8000'0200 + node);
      set(0x1600, 0, 1, 0);
      set(0x1600, 1, 4, 0x6040'0010);
      set(0x1600, 2, 4, 0x6071'0010);
      set(0x1600, 0, 1, 2);
      set(0x1400, 5, 2, deadline_ms);
      set(0x1400, 1, 4, 0x200 + node);
      set(0x1800, 1, 4, 0x8000'0180 + node);
      set(0x1A00, 0, 1, 0);
      set(0x1A00, 1, 4, 0x6041'0010);
      set(0x1A00, 2, 4, 0x6064'0020);
      set(0x1A00, 3, 4, 0x6077'0010);
      set(0x1A00, 0, 1, 3);
      set(0x1800, 2, 1, 1);
      set(0x1800, 1, 4, 0x180 + node);
      set(0x6060, 0, 1, 10);
    }
    if (layout_.panel.bus >= 0) good = write(layout_.panel.bus, layout_.panel.node, 0x1800, 2, 1, 1) && good;
    for (int bus = 0; bus < layout_.bus_count; ++bus) (void)device_.bus(bus).send(can_frame(0, {1, 0}));
    device_.advance_to((device_.now_ns() / 1'000'000 + 2) * 1'000'000);
    for (int bus = 0; bus < layout_.bus_count; ++bus) drain(bus);
    return good;
  }

  void sync() {
    for (int bus = 0; bus < layout_.bus_count; ++bus) (void)device_.bus(bus).send(can_frame(0x80, {}));
  }

  /// Takes what has come: answers that stand behind the own SYNC.
  void collect() {
    for (int bus = 0; bus < layout_.bus_count; ++bus) {
      for (const hal::ReceivedFrame& received : drain(bus)) {
        if (received.own && received.frame.id == 0x80) sync_ns = received.time_ns;
        if (layout_.panel.bus == bus && received.frame.id == 0x180 + layout_.panel.node) panel = received.frame.data[0];
        for (int i = 0; i < layout_.joint_count; ++i) {
          const hal::DriveConfig& drive = layout_.drives.at(static_cast<std::size_t>(i));
          if (drive.bus != bus || received.frame.id != 0x180 + drive.node || received.frame.length != 8) continue;
          const auto& d = received.frame.data;
          Reading& reading = readings.at(static_cast<std::size_t>(i));
          reading.statusword = d[0] | d[1] << 8;
          reading.counts = static_cast<std::int32_t>(
              static_cast<std::uint32_t>(d[2]) | static_cast<std::uint32_t>(d[3]) << 8 |
              static_cast<std::uint32_t>(d[4]) << 16 | static_cast<std::uint32_t>(d[5]) << 24);
          reading.torque_permille = static_cast<std::int16_t>(d[6] | d[7] << 8);
          reading.time_ns = received.time_ns;
        }
      }
    }
  }

  /// Controlwords on the way to enabled, torques in permille of the motor's rated one.
  void command(const std::array<int, kMaxJoints>& permille, int controlword = -1) {
    for (int i = 0; i < layout_.joint_count; ++i) {
      const hal::DriveConfig& drive = layout_.drives.at(static_cast<std::size_t>(i));
      const int state = readings.at(static_cast<std::size_t>(i)).statusword & 0x6F;
      const int word = controlword >= 0                 ? controlword
                       : state == 0x21                  ? 0x07
                       : state == 0x23 || state == 0x27 ? 0x0F
                                                        : 0x06;
      const int torque = permille.at(static_cast<std::size_t>(i));
      (void)device_.bus(drive.bus).send(
          can_frame(0x200 + drive.node, {word & 0xFF, word >> 8, torque & 0xFF, (torque >> 8) & 0xFF}));
    }
  }

  /// A whole cycle; it begins and ends at a multiple of the period.
  void cycle(const std::array<int, kMaxJoints>& permille, std::int64_t collect_ns, int controlword = -1) {
    const std::int64_t begin_ns = device_.now_ns();
    sync();
    device_.advance_to(begin_ns + collect_ns);
    collect();
    command(permille, controlword);
    device_.advance_to(begin_ns + 1'000'000);
  }

  double position(int joint) const {
    const hal::DriveConfig& drive = layout_.drives.at(static_cast<std::size_t>(joint));
    return drive.zero +
           drive.sign * 2.0 * M_PI * readings.at(static_cast<std::size_t>(joint)).counts / (drive.counts * drive.gear);
  }

  std::array<Reading, kMaxJoints> readings{};
  int panel = -1;
  std::int64_t sync_ns = -1;

 private:
  const hal::BusLayout& layout_;
  sim::CanDevice& device_;
};

/// The first joints of an arm on buses of at most three, a panel on the last.
inline hal::BusLayout layout_of(const ArmModel& model) {
  hal::BusLayout layout;
  layout.joint_count = model.joint_count;
  layout.bus_count = (model.joint_count + 2) / 3;
  for (int i = 0; i < model.joint_count; ++i) {
    hal::DriveConfig& drive = layout.drives.at(static_cast<std::size_t>(i));
    drive.bus = i / 3;
    drive.node = 1 + i % 3;
    drive.gear = 100.0;
    drive.counts = 1 << 14;
    drive.rated_torque = model.joints.at(static_cast<std::size_t>(i)).torque / 100.0;
    drive.sign = i % 2 == 0 ? 1.0 : -1.0;
    drive.zero = 0.1 * i;
  }
  layout.panel = {layout.bus_count - 1, 0x20};
  return layout;
}

}  // namespace godobject::test
