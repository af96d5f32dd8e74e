#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>
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
  std::string mode;                          ///< of the supervisor
  int fault = 0;                             ///< 0: none
  double share = 0.0;                        ///< share of the wrench that is rendered [0, 1]
  std::vector<double> torque;                ///< of the joints [Nm]
  std::vector<double> position;              ///< of the joints [rad]; empty: the telemetry has none; so `velocity`
  std::vector<double> velocity;              ///< of the joints [rad/s]
  double late = 0.0;                         ///< lateness of waking [s]; NaN: the telemetry has none; so the next two
  double compute = 0.0;                      ///< computing time [s]
  double absorbed = 0.0;                     ///< energy that the rendered torques have absorbed [J]
  Quaternion R_WR = Quaternion::Identity();  ///< rotates directions of the room to those of the scene, if it is known

  /// Returns the cycle with its wrench along the axes of the scene, as a replay has it.
  ReplayRow cycle_in_scene() const;
};

/// A line of a telemetry that is wrong; `what` is one clause without the place.
class MalformedTelemetry : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The columns of a telemetry, by its header. They may be in any order; other columns are ignored.
class TelemetryColumns {
 public:
  /// Throws MalformedTelemetry if a column is missing.
  explicit TelemetryColumns(std::string_view header);

  /// Reads a row. Throws MalformedTelemetry if it has another number of fields, or no finite number where one belongs.
  TelemetryRow row(std::string_view line) const;

 private:
  bool has(std::string_view name) const;
  void add_if_there(std::string_view name, std::vector<std::size_t>& places) const;
  std::size_t place(std::string_view name) const;

  std::vector<std::string> names_;
  std::vector<std::size_t> numbers_;
  std::size_t mode_ = 0;
  std::size_t outcome_ = 0;
  std::vector<std::size_t> torques_, positions_, velocities_;  ///< of the joints
  std::vector<std::size_t> late_, compute_, absorbed_;         ///< one place, or none
  std::vector<std::size_t> turn_;                              ///< four places, or none
};

using TelemetryLog = std::vector<TelemetryRow>;

/// Begin of the first line of a telemetry.
inline constexpr std::string_view kTelemetryBegin = "t_s,";

/// Tells if a file begins as a telemetry does. Throws Failure (kNoInput) if it cannot be read.
bool is_telemetry(const std::filesystem::path& file);

/// Reads telemetry.csv of godobject-controller. Throws Failure: kNoInput if the file cannot be read, kBadData naming
/// the line.
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
