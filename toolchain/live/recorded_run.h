#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "toolchain/files/scene_image.h"
#include "toolchain/live/live_source.h"

namespace godobject::live {

/// A replay or a telemetry that is played in real time, again and again. Only looks.
class RecordedRun final : public LiveSource {
 public:
  /// `config`: of the controller that wrote a telemetry; none: no arm is shown. Throws command::Failure as
  /// figures::read_replay_log and files::SceneImage::read.
  RecordedRun(const std::filesystem::path& file, const std::filesystem::path& image,
              const std::optional<firmware::ControllerConfig>& config);

  const SceneView& scene() const override { return image_.scene; }
  const firmware::Placement* placement() const override { return placement_ ? &*placement_ : nullptr; }
  void take(std::vector<LiveSample>& samples) override;
  std::optional<LiveSettings> settings() const override { return {}; }
  double speed() const override { return 1.0; }
  std::uint64_t lost() const override { return 0; }
  std::string failure() const override { return ""; }
  std::string answer(const Request& request) override;

  /// Pose H_WM of the moving mesh in the first cycle.
  const Pose& start() const { return samples_.front().H_WD; }
  /// Largest force and torque [N, Nm].
  double largest_force() const;
  double largest_torque() const;

 private:
  const files::SceneImage image_;
  const std::optional<firmware::Placement> placement_;
  std::vector<LiveSample> samples_;
  std::size_t next_ = 0;
  std::int64_t begin_ns_ = 0;  ///< time at which the first sample was shown; 0: never
};

}  // namespace godobject::live
