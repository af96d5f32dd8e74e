#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "godobject/pose.h"

namespace godobject::figures {

/// One cycle as godobject-replay wrote it; of a telemetry see TelemetryRow.
struct ReplayRow {
  double t = 0.0;      ///< [s]
  Pose H_WD;           ///< device pose of the moving mesh's frame
  Pose H_WS;           ///< god object's, after the cycle
  Wrench wrench;       ///< spring part on the device, in W about the centre of mass
  double depth = 0.0;  ///< of the god object's deepest sample point, positive inside [m]
  double contacts = 0.0;
  double step1_ns = 0.0;  ///< time of step #1
  double solve_ns = 0.0;  ///< time of steps #2-#7
  std::string status;
};

using ReplayLog = std::vector<ReplayRow>;

/// Reads the output of godobject-replay, or of the telemetry of godobject-controller the cycles in which something was
/// rendered. Throws Failure: kNoInput if it cannot be read, kBadData naming the line.
ReplayLog read_replay_log(const std::filesystem::path& file);

/// The row whose time is nearest to t. Throws Failure (kBadData) naming `file` if t is more than a cycle off the log's
/// span.
const ReplayRow& row_at(const ReplayLog& log, double t, const std::filesystem::path& file);

/// The first row in which the god object is deepest.
const ReplayRow& deepest_row(const ReplayLog& log);

/// A moment of a scene as people name it: a time in seconds ("1.2"), or "deepest", when any of these replays of the
/// scene is deepest. Nothing if it is neither.
std::optional<double> moment(std::string_view name, const std::vector<const ReplayLog*>& logs);

}  // namespace godobject::figures
