#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "toolchain/session/owned_god_object.h"
#include "core/scene/scene.h"
#include "godobject/pose.h"

namespace godobject::bench {

/// Part of a path, by the numbers of its cycles.
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

/// Bunny on teapot, ear in handle, peg in hole, thin plate; of the last cycles none is left out.
const std::vector<Workload>& workloads();

/// The device's poses of a workload, of the moving mesh's frame in W. Throws Failure.
std::vector<Pose> device_poses(const Workload& workload, const std::filesystem::path& scenes);

/// A solver, with or without friction.
struct Pipeline {
  Solver solver = Solver::kContact;
  bool friction = false;

  std::string name() const;  ///< "contact, friction"
};

/// All pipelines that a scene holds.
std::vector<Pipeline> pipelines(const Scene& scene);

}  // namespace godobject::bench
