#pragma once

#include <cstddef>

#include "firmware/cycle/control_cycle.h"
#include "firmware/loop/periodic_loop.h"
#include "hal/record_ring.h"

namespace godobject::firmware {

/// One row of the telemetry: times and results of a cycle.
struct TelemetryRecord {
  CycleTimes times;
  CycleRecord cycle;
};

/// Records of 4096 cycles, 2 MiB: of 4 s at 1 kHz, half a second at 8 kHz. Chosen: the writer drains it every 50 ms; a
/// disk may stall for ten times that before a row is lost.
using TelemetryRing = hal::RecordRing<TelemetryRecord, 4096>;
static_assert(sizeof(TelemetryRing) < (std::size_t{2} << 20) + 1024);

}  // namespace godobject::firmware
