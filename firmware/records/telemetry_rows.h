#pragma once

#include <string>

#include "firmware/loop/telemetry_ring.h"
#include "godobject/pose.h"

namespace godobject::firmware {

/// Returns the first line of telemetry.csv with its line feed: names of columns with units.
std::string telemetry_header(int joint_count);

/// Properties that all rows of a file share.
struct TelemetryFormat {
  int joint_count = 0;
  Quaternion R_WR = Quaternion::Identity();  ///< rotates directions of the room to those of the scene
};

/// Appends a row of telemetry.csv with its line feed.
void append_telemetry_row(const TelemetryRecord& record, const TelemetryFormat& format, std::string& text);

}  // namespace godobject::firmware
