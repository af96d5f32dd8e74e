#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "firmware/cycle/control_cycle.h"
#include "tests/support/fault_record.h"

namespace godobject::firmware {

/// Returns the reaction to a fault that began in the period `begin`, from the records of a run: the modes that
/// followed, the fault, and the number of cycles until the controller renders nothing any more. Ignores the records
/// from the period `end` on.
template <class Cycle>
test::SeenFault seen_since(const std::vector<Cycle>& cycles, std::int64_t begin,
                           std::int64_t end = std::numeric_limits<std::int64_t>::max()) {
  test::SeenFault seen;
  Mode last = Mode::kBoot;
  bool faded = false;
  bool stopped = false;
  bool asked = false;
  bool full = true;
  for (const Cycle& cycle : cycles) {
    const CycleRecord& record = cycle.record;
    if (cycle.number < begin || cycle.number >= end) continue;
    if (seen.after.empty() || record.mode != last) {
      seen.after += (seen.after.empty() ? "" : ", ") + std::string(name(record.mode));
      faded = faded || (record.mode == Mode::kFade && !stopped);
      asked = asked || record.mode == Mode::kEnding;
      stopped = stopped || record.mode == Mode::kStopping;
    }
    last = record.mode;
    full = full && record.share == 1.0;
    if (record.share == 0.0 && seen.cycles < 0) seen.cycles = static_cast<int>(cycle.number - begin + 1);
    if (record.fault != Fault::kNone && seen.found.empty()) {
      seen.found = record.fault == Fault::kAlarm ? describe(record.alarm) : describe(record.fault);
    }
  }
  if (asked && seen.found.empty()) {
    seen.reaction = "ends";
  } else if (stopped) {
    seen.reaction = faded ? "FADE, STOP" : "STOP";
  } else {
    seen.reaction = full ? "goes on" : "renders less";
  }
  return seen;
}

/// Returns the largest motor torque and the number of closed brakes as text. `joint(i)` has both values.
template <class JointOf>
std::string rest_of(int joints, const JointOf& joint) {
  double torque = 0.0;
  int braked = 0;
  for (int i = 0; i < joints; ++i) {
    torque = std::max(torque, std::fabs(joint(i).motor_torque()));
    braked += joint(i).brake_torque() > 0.0 ? 1 : 0;
  }
  char text[64];
  std::snprintf(text, sizeof(text), "%.3g Nm, %d of %d brakes closed", torque, braked, joints);
  return text;
}

}  // namespace godobject::firmware
