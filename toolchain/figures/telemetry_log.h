#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "toolchain/figures/replay_log.h"

namespace godobject::figures {

/// One cycle of the telemetry of godobject-controller.
struct TelemetryRow {
  /// As in a replay, without run times. The wrench is that on the hand, about the moving body's centre of mass and
  /// along the axes of the room.
  ReplayRow cycle;
  std::string mode;              ///< of the supervisor
  int fault = 0;                 ///< 0: none
  double share = 0.0;            ///< share of the wrench that is rendered [0, 1]
  std::vector<double> position;  ///< of the joints [rad]
  std::vector<double> velocity;  ///< of the joints [rad/s]
  std::vector<double> torque;    ///< of the joints [Nm]
  double late = 0.0;             ///< lateness of waking [s]
  double compute = 0.0;          ///< computing time [s]
  double absorbed = 0.0;         ///< energy that the rendered torques have absorbed [J]
};

using TelemetryLog = std::vector<TelemetryRow>;

/// Begin of the first line of a telemetry.
inline constexpr std::string_view kTelemetryBegin = "t_s,";

/// Tells if a file begins as a telemetry does. Throws Failure (kNoInput) if it cannot be read.
bool is_telemetry(const std::filesystem::path& file);

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
