#pragma once

#include "firmware/cycle/control_cycle.h"
#include "firmware/loop/periodic_loop.h"
#include "hal/record_ring.h"

namespace godobject::firmware {

/// One row of the telemetry.
struct TelemetryRecord {
  CycleTimes times;
  CycleRecord cycle;
};

/// Four seconds, about 2.5 MiB.
using TelemetryRing = hal::RecordRing<TelemetryRecord, 4096>;

}  // namespace godobject::firmware
