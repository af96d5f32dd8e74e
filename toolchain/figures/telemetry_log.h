#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "toolchain/figures/replay_log.h"

namespace godobject::figures {

/// One cycle of the telemetry of godobject-controller.
struct TelemetryRow {
  /// As in a replay, without run times. The wrench is that at the hand, in the room's directions about the mesh's
  /// origin.
  ReplayRow cycle;
  std::string mode;            ///< of the supervisor
  int fault = 0;               ///< 0: none
  double share = 0.0;          ///< share of the wrench that is rendered [0, 1]
  std::vector<double> torque;  ///< of the joints [Nm]
};

using TelemetryLog = std::vector<TelemetryRow>;

/// Begin of the first line of a telemetry.
inline constexpr std::string_view kTelemetryBegin = "t_s,";

/// Reads telemetry.csv of godobject-controller. The columns may be in any order; other columns are ignored. Throws
/// Failure: kNoInput if the file cannot be read, kBadData naming the line.
TelemetryLog read_telemetry_log(const std::filesystem::path& file);

/// Returns the cycles that rendered.
ReplayLog rendered(const TelemetryLog& log);

/// Work that the hand has done on the tool up to a time.
struct HandWork {
  double t = 0.0;     ///< [s]
  double work = 0.0;  ///< [J]
};

/// Reads hand.csv of godobject-controller. Throws Failure as read_telemetry_log.
std::vector<HandWork> read_hand_log(const std::filesystem::path& file);

}  // namespace godobject::figures
