#pragma once

#include <string>

#include "firmware/loop/telemetry_ring.h"

namespace godobject::firmware {

/// Returns the first line of telemetry.csv with its line feed: names of columns with units.
std::string telemetry_header(int joint_count);

/// Appends a row of telemetry.csv with its line feed.
void append_telemetry_row(const TelemetryRecord& record, int joint_count, std::string& text);

}  // namespace godobject::firmware
