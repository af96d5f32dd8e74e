#pragma once

#include <cstdint>

#include "firmware/loop/periodic_loop.h"

namespace godobject::firmware {

struct CycleRecord;
class Session;
class SimulatedArm;

/// Accompanies a run on a simulated arm in virtual time: looks at each cycle, moves the hand, changes the rendering. It
/// runs between two cycles in the thread of the loop and may take its time, because virtual time stands still.
class Companion {
 public:
  virtual ~Companion() = default;
  Companion(const Companion&) = delete;
  Companion& operator=(const Companion&) = delete;

  /// Called after each cycle. `computed_ns`: its computing time on the machine's clock.
  virtual void after_cycle(const CycleTimes& times, const CycleRecord& record, std::int64_t computed_ns,
                           SimulatedArm& arm, Session& session) = 0;

 protected:
  Companion() = default;
};

}  // namespace godobject::firmware
