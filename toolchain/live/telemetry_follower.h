#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/configuration/scene_file.h"
#include "toolchain/figures/telemetry_log.h"
#include "toolchain/live/live_source.h"

namespace godobject::live {

/// A controller in another process, through the telemetry.csv that a thread of it writes: whoever looks takes nothing
/// from the loop. The file is a link to that of the newest run, so a run that begins later is followed, too. Only
/// looks.
class TelemetryFollower final : public LiveSource {
 public:
  /// `config`: of the controller, whose telemetry.folder has the file. Throws command::Failure if scene or gains cannot
  /// be read. The file need not exist yet; `take` throws command::Failure (kBadData) if it is no telemetry.
  explicit TelemetryFollower(const firmware::ControllerConfig& config);

  const SceneView& scene() const override { return scene_; }
  const firmware::Placement* placement() const override { return &placement_; }
  void take(std::vector<LiveSample>& samples) override;
  std::optional<LiveSettings> settings() const override { return {}; }
  double speed() const override { return speed_; }
  std::uint64_t lost() const override { return skipped_; }
  std::string failure() const override { return ""; }
  std::string answer(const Request& request) override;

 private:
  LiveSample waiting() const;
  bool is_another_file() const;
  void open();
  void read_line(std::string_view line, std::vector<LiveSample>& samples);
  void measure_speed(const std::vector<LiveSample>& samples);

  const std::filesystem::path file_;
  const firmware::SceneFile image_;
  const SceneView scene_;
  const firmware::Placement placement_;
  const Pose start_;           ///< H_WM before there is a telemetry
  const JointVector posture_;  ///< the same of the joints [rad]
  std::ifstream stream_;
  bool waits_ = false;         ///< the page has been told
  bool begins_again_ = false;  ///< the time has gone back
  double last_t_ = -1.0;       ///< of the row before [s]
  std::uint64_t inode_ = 0;
  std::size_t read_ = 0;  ///< bytes
  std::string rest_;      ///< of a line that is not complete yet
  std::optional<figures::TelemetryColumns> columns_;
  std::uint64_t skipped_ = 0;  ///< lines that are no row
  double speed_ = 0.0;
  double mark_ = 0.0;  ///< time of the controller [s] at `wall_mark_ns_`
  std::int64_t wall_mark_ns_ = 0;
};

}  // namespace godobject::live
