#include "toolchain/path/pose_file.h"

#include "toolchain/files/pose_path.h"
#include "toolchain/path/keyframes.h"
#include "toolchain/path/trajectory.h"

namespace godobject::path {

std::vector<Pose> read_poses(const std::filesystem::path& file) {
  if (file.extension() == ".csv") return files::read_pose_path(file).poses;
  std::vector<Pose> poses;
  for (const Sample& sample : sample(read_keyframes(file))) poses.push_back(sample.pose);
  return poses;
}

}  // namespace godobject::path
