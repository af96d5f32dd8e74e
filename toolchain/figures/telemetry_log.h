#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "toolchain/figures/replay_log.h"

namespace godobject::figures {

/// One cycle as godobject-controller wrote it.
struct TelemetryRow {
  /// As of a replay. The wrench is the one that the hand feels, in the room's directions about the mesh's origin; no
  /// times are told.
  ReplayRow cycle;
  std::string mode;            ///< of the supervisor
  int fault = 0;               ///< 0: none
  double share = 0.0;          ///< of what is rendered [0, 1]
  std::vector<double> torque;  ///< of the joints [Nm]
};

using TelemetryLog = std::vector<TelemetryRow>;

/// The first line of a telemetry begins so.
inline constexpr std::string_view kTelemetryBegin = "t_s,";

/// Reads telemetry.csv of godobject-controller, whose columns may be in any order and more than are looked at. Throws
/// Failure: kNoInput if it cannot be read, kBadData naming the line.
TelemetryLog read_telemetry_log(const std::filesystem::path& file);

/// The cycles in which something was rendered.
ReplayLog rendered(const TelemetryLog& log);

/// What the hand had done on the tool by a time.
struct HandWork {
  double t = 0.0;     ///< [s]
  double work = 0.0;  ///< [J]
};

/// Reads hand.csv of godobject-controller. Throws Failure as above.
std::vector<HandWork> read_hand_log(const std::filesystem::path& file);

}  // namespace godobject::figures
