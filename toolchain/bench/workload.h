#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/scene/scene_view.h"
#include "godobject/pose.h"
#include "toolchain/session/owned_god_object.h"

namespace godobject::bench {

/// Part of a path, given by the numbers of its cycles.
struct Phase {
  std::string name;
  std::vector<std::size_t> cycles;
};

/// A scene file and a motion in it.
struct Workload {
  std::string name;
  std::string scene;  ///< SCENE.toml in the folder of scenes
  std::string path;   ///< in its folder `paths`: recorded (CSV) or key frames (TOML)
  std::vector<Phase> phases;
};

/// Returns the workloads: bunny on teapot, ear in handle, peg in hole, thin plate.
const std::vector<Workload>& workloads();

/// Returns the device poses of a workload, H_WM of the moving mesh. Throws Failure.
std::vector<Pose> device_poses(const Workload& workload, const std::filesystem::path& scenes);

/// A solver, with or without friction.
struct Pipeline {
  Solver solver = Solver::kContact;
  bool friction = false;

  std::string name() const;  ///< "contact, friction"
};

/// Returns all pipelines that a scene has data for.
std::vector<Pipeline> pipelines(const SceneView& scene);

}  // namespace godobject::bench
