#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "godobject/pose.h"

namespace godobject::figures {

/// One cycle of the output of godobject-replay. For a telemetry see TelemetryRow.
struct ReplayRow {
  double t = 0.0;      ///< [s]
  Pose H_WD;           ///< device pose of the moving mesh's frame
  Pose H_WS;           ///< god object's pose of the same frame, after the cycle
  Wrench wrench;       ///< spring part on the device, in W about the centre of mass
  double depth = 0.0;  ///< of the god object's deepest sample point, positive inside [m]
  double contacts = 0.0;
  double step1_ns = 0.0;  ///< time of step #1
  double solve_ns = 0.0;  ///< time of steps #2-#7
  std::string status;
};

using ReplayLog = std::vector<ReplayRow>;

/// Reads the output of godobject-replay, or a telemetry of godobject-controller, of which it returns the cycles that
/// rendered. Throws Failure: kNoInput if the file cannot be read, kBadData naming the line.
ReplayLog read_replay_log(const std::filesystem::path& file);

/// Returns the row whose time is nearest to t. Throws Failure (kBadData) naming `file` if t is more than a cycle
/// outside the log.
const ReplayRow& row_at(const ReplayLog& log, double t, const std::filesystem::path& file);

/// Returns the device pose of each row. A row that is no pose repeats the pose before it; the first one, that of the
/// god object. `log`: not empty.
std::vector<Pose> device_poses(const ReplayLog& log);

/// Returns the first row in which the god object is deepest.
const ReplayRow& deepest_row(const ReplayLog& log);

/// Returns the time [s] that a name denotes: a number of seconds ("1.2"), or "deepest", the time of the largest depth
/// of all these replays. Returns nullopt for any other name.
std::optional<double> moment(std::string_view name, const std::vector<const ReplayLog*>& logs);

}  // namespace godobject::figures
