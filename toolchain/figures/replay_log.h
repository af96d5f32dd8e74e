#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/spatial/pose.h"

namespace godobject::figures {

/// One cycle as godobject-replay wrote it.
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

/// Reads the output of godobject-replay. Throws Failure: kNoInput if it cannot be read, kBadData naming the line.
ReplayLog read_replay_log(const std::filesystem::path& file);

/// The row whose time is nearest to t. Throws Failure (kBadData) naming `file` if t is more than a cycle off the log's
/// span.
const ReplayRow& row_at(const ReplayLog& log, double t, const std::filesystem::path& file);

}  // namespace godobject::figures
