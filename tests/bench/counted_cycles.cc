// counted_cycles X.scene POSES.csv FIRST END FRICTION: replays a path with `contact` up to row END. From row FIRST on,
// cycles run in counted_update, the function that callgrind counts.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "toolchain/files/pose_path.h"
#include "toolchain/files/scene_image.h"
#include "toolchain/session/owned_god_object.h"

namespace {

using namespace godobject;

OwnedGodObject god_object;

Status plain_update(const Pose& H_WM, CycleReport& report) { return god_object->update({H_WM, Motion{}}, report); }

}  // namespace

[[gnu::noinline]] Status counted_update(const Pose& H_WM, CycleReport& report);
[[gnu::noinline]] Status counted_update(const Pose& H_WM, CycleReport& report) {
  return god_object->update({H_WM, Motion{}}, report);
}

int main(int argc, char** argv) try {
  if (argc != 6) return 64;
  const auto image = files::SceneImage::read(argv[1]);
  const files::PosePath path = files::read_pose_path(argv[2], image.scene.settings.period);
  const auto first = static_cast<std::size_t>(std::atoi(argv[3]));
  const auto end = static_cast<std::size_t>(std::atoi(argv[4]));
  const bool friction = std::string_view(argv[5]) == "on";
  if (god_object.start(image.scene, Solver::kContact, friction) != Status::kOk || end > path.poses.size()) {
    return 65;
  }
  std::size_t contacts = 0;
  for (std::size_t i = 0; i < end; ++i) {
    CycleReport report;
    const Status status = i < first ? plain_update(path.poses[i], report) : counted_update(path.poses[i], report);
    if (status != Status::kOk) return 65;
    if (i >= first) contacts += report.contacts;
  }
  std::printf("%zu cycles, %zu contacts\n", end - first, contacts);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 70;
}
