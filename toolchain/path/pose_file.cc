#include "toolchain/path/pose_file.h"

#include <fmt/format.h>

#include <cmath>

#include "toolchain/command_line/failure.h"
#include "toolchain/files/pose_path.h"
#include "toolchain/path/keyframes.h"
#include "toolchain/path/trajectory.h"

namespace godobject::path {

std::vector<Pose> read_poses(const std::filesystem::path& file, double period) {
  if (file.extension() == ".csv") return files::read_pose_path(file, period).poses;
  const Keyframes keyframes = read_keyframes(file);
  if (std::fabs(keyframes.period - period) > 1e-9) {
    throw command::Failure(command::ExitCode::kBadConfig,
                           fmt::format("{}: period = {:g}, and the scene has {:g}: set period = {:g}", file.string(),
                                       keyframes.period, period, period));
  }
  std::vector<Pose> poses;
  for (const Sample& sample : sample(keyframes)) poses.push_back(sample.pose);
  return poses;
}

}  // namespace godobject::path
