#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "hal/clock.h"
#include "tests/hal/fake_bus.h"
#include "tests/hal/frames.h"

namespace godobject::hal {

/// As much of a CANopen node as a start needs: it answers SDO requests from a dictionary, boots and starts by NMT, and
/// sends heartbeats. Written down byte by byte, so that it knows nothing of the codecs.
class ScriptedNode {
 public:
  struct Object {
    int size;
    std::uint32_t value;
    bool ignores_writes = false;
  };

  explicit ScriptedNode(int node) : node_(node) {}

  Object& object(int index, int subindex) { return objects[{index, subindex}]; }

  /// Takes a frame of the controller, at `now_ns`.
  void take(const CanFrame& frame, std::int64_t now_ns, FakeBus& bus) {
    if (frame.id == 0x000 && (frame.data[1] == 0 || frame.data[1] == node_)) {
      nmt.push_back(frame.data[0]);
      if (frame.data[0] == 0x82 && boots) boot_at_ns = now_ns + boot_delay_ns;
      if (frame.data[0] == 0x01 && starts) {
        state = 0x05;
        mode_at_ns = now_ns + first_mode_ns;
      }
    }
    if (frame.id == 0x600 + node_ && answers) {
      answer(frame, bus);
      after_answer_to(frame, bus);
    }
  }

  void run(std::int64_t now_ns, FakeBus& bus) {
    if (boot_at_ns >= 0 && now_ns >= boot_at_ns) {
      boot_at_ns = -1;
      state = 0x7F;
      bus.receive_next(frame(static_cast<std::uint16_t>(0x700 + node_), {0x00}));
    }
    const auto of_mode = object_if_there(0x1801, 1);
    if (state == 0x05 && tells_mode && of_mode != nullptr && of_mode->value < 0x80000000 && now_ns >= mode_at_ns) {
      mode_at_ns = now_ns + 1'000'000'000;
      bus.receive_next(frame(static_cast<std::uint16_t>(0x280 + node_), {static_cast<int>(object(0x6061, 0).value)}));
    }
    if (now_ns >= heartbeat_at_ns && state != 0) {
      heartbeat_at_ns = now_ns + 20'000'000;
      bus.receive_next(frame(static_cast<std::uint16_t>(0x700 + node_), {state}));
    }
  }

  std::map<std::pair<int, int>, Object> objects;
  std::map<std::pair<int, int>, std::uint32_t> reads;  ///< objects that read with another value than their own
  std::vector<std::pair<std::pair<int, int>, std::uint32_t>> writes;
  std::vector<int> nmt;
  std::function<void(FakeBus&)> before_answer = [](FakeBus&) {};
  std::function<void(const CanFrame&, FakeBus&)> before_answer_to = [](const CanFrame&, FakeBus&) {};
  std::function<void(const CanFrame&, FakeBus&)> after_answer_to = [](const CanFrame&, FakeBus&) {};
  /// Changes an answer to a request, before it is sent.
  std::function<void(const CanFrame&, CanFrame&)> change_answer = [](const CanFrame&, CanFrame&) {};
  std::uint32_t absent = 0x06020000;  ///< abort code for an object that the node lacks
  bool boots = true;
  bool starts = true;
  bool answers = true;
  bool tells_mode = true;
  std::int64_t boot_delay_ns = 10'000'000;
  std::int64_t boot_at_ns = -1;
  std::int64_t heartbeat_at_ns = 0;
  std::int64_t mode_at_ns = 0;
  std::int64_t first_mode_ns = 0;  ///< from the start on
  int state = 0x7F;

 private:
  const Object* object_if_there(int index, int subindex) const {
    const auto found = objects.find({index, subindex});
    return found == objects.end() ? nullptr : &found->second;
  }

  void answer(const CanFrame& request, FakeBus& bus) {
    before_answer(bus);
    before_answer_to(request, bus);
    const int command = request.data[0];
    const std::pair<int, int> key = {request.data[1] | request.data[2] << 8, request.data[3]};
    const auto id = static_cast<std::uint16_t>(0x580 + node_);
    const auto respond = [&](int first, std::uint32_t value) {
      const auto byte = [value](int i) { return static_cast<int>(value >> (8 * i) & 0xFF); };
      CanFrame response =
          frame(id, {first, request.data[1], request.data[2], request.data[3], byte(0), byte(1), byte(2), byte(3)});
      change_answer(request, response);
      bus.receive_next(response);
    };
    const auto found = objects.find(key);
    if (found == objects.end()) return respond(0x80, absent);
    Object& object = found->second;
    const int unused = (4 - object.size) << 2;
    if (command == 0x40) {
      const auto other = reads.find(key);
      return respond(object.size > 4 ? 0x41 : 0x43 | unused, other == reads.end() ? object.value : other->second);
    }
    if (command != (0x23 | unused)) return respond(0x80, 0x06070010);
    std::uint32_t value = 0;
    for (int i = 0; i < object.size; ++i) {
      value |= static_cast<std::uint32_t>(request.data[static_cast<std::size_t>(4 + i)]) << (8 * i);
    }
    writes.push_back({key, value});
    if (!object.ignores_writes) object.value = value;
    if (key == std::pair(0x6060, 0)) objects[{0x6061, 0}].value = value;
    respond(0x60, 0);
  }

  int node_;
};

/// A drive that can do what it must. `rated`: torque [mNm].
inline ScriptedNode scripted_drive(int node, std::uint32_t rated) {
  ScriptedNode drive(node);
  drive.objects = {
      {{0x1000, 0}, {4, 0x00020192}}, {{0x1005, 0}, {4, 0x80}},  {{0x1016, 1}, {4, 0}},   {{0x1017, 0}, {2, 0}},
      {{0x1029, 1}, {1, 0}},          {{0x1400, 1}, {4, 0x201}}, {{0x1400, 2}, {1, 255}}, {{0x1400, 5}, {2, 0}},
      {{0x1600, 0}, {1, 1}},          {{0x1600, 1}, {4, 0}},     {{0x1600, 2}, {4, 0}},   {{0x1800, 1}, {4, 0x181}},
      {{0x1800, 2}, {1, 254}},        {{0x1A00, 0}, {1, 1}},     {{0x1A00, 1}, {4, 0}},   {{0x1A00, 2}, {4, 0}},
      {{0x1801, 1}, {4, 0x80000281}}, {{0x1801, 2}, {1, 254}},   {{0x1801, 5}, {2, 0}},   {{0x1A01, 0}, {1, 0}},
      {{0x1A01, 1}, {4, 0}},          {{0x1A00, 3}, {4, 0}},     {{0x6007, 0}, {2, 1}},   {{0x605A, 0}, {2, 6}},
      {{0x605E, 0}, {2, 0}},          {{0x6060, 0}, {1, 0}},     {{0x6061, 0}, {1, 0}},   {{0x6064, 0}, {4, 0}},
      {{0x6071, 0}, {2, 0}},          {{0x6076, 0}, {4, rated}}, {{0x6085, 0}, {4, 1}},   {{0x6077, 0}, {2, 0}},
      {{0x6502, 0}, {4, 0x380}}};
  return drive;
}

inline ScriptedNode scripted_panel(int node) {
  ScriptedNode panel(node);
  panel.objects = {{{0x1000, 0}, {4, 0x00010191}}, {{0x1005, 0}, {4, 0x80}}, {{0x1017, 0}, {2, 0}},
                   {{0x1800, 1}, {4, 0x1A0}},      {{0x1800, 2}, {1, 255}},  {{0x1A00, 0}, {1, 0}},
                   {{0x1A00, 1}, {4, 0}},          {{0x6000, 1}, {1, 0}}};
  return panel;
}

/// Time that passes only in `sleep_until`, in which the nodes of each bus do what they have to.
class ScriptedWorld final : public Clock {
 public:
  struct Place {
    FakeBus* bus;
    ScriptedNode* node;
  };

  explicit ScriptedWorld(std::vector<Place> places) : places_(std::move(places)) {}

  std::int64_t now_ns() noexcept override { return now_ns_; }

  void sleep_until(std::int64_t ns) noexcept override {
    if (ns <= now_ns_) return;
    longest_sleep_ns = std::max(longest_sleep_ns, ns - now_ns_);
    now_ns_ = ns;
    each_sleep();
    for (const Place& place : places_) {
      for (const CanFrame& frame : place.bus->sent) place.node->take(frame, now_ns_, *place.bus);
      place.node->run(now_ns_, *place.bus);
    }
    for (const Place& place : places_) {
      log.insert(log.end(), place.bus->sent.begin(), place.bus->sent.end());
      place.bus->sent.clear();
    }
  }

  std::vector<CanFrame> log;  ///< all that the controller has sent
  std::function<void()> each_sleep = [] {};
  std::int64_t longest_sleep_ns = 0;

 private:
  std::vector<Place> places_;
  std::int64_t now_ns_ = 0;
};

}  // namespace godobject::hal
