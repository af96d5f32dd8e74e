#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "toolchain/figures/crossing.h"
#include "toolchain/figures/figure.h"

namespace godobject::figures {

/// What is to be shown of a scene: what the demo knows beside the scene file.
struct ScenePlan {
  std::string name;   ///< folder of its replays
  std::string image;  ///< name of its scene image, without folder and extension
  std::string title;
  std::string text;  ///< a few sentences for the page
  std::vector<Marker> markers;
  std::optional<Barrier> barrier;
};

/// What is to be shown of a run of the whole controller.
struct ArmPlan {
  ScenePlan scene;               ///< its name is that of the folder of its telemetry
  std::filesystem::path device;  ///< the arm's device file
};

struct Plan {
  std::vector<ScenePlan> scenes;
  std::vector<ArmPlan> runs;
};

/// Reads tables [[scene]] with name, image, title, text and, if wanted, markers = { A = 0.4, ... } and barrier =
/// [point, normal]; and, if wanted, tables [[run]] with the same and device, a path relative to the file. Throws
/// Failure: kNoInput, kBadData if it is not TOML, kBadConfig naming the key.
Plan read_plan(const std::filesystem::path& file);

}  // namespace godobject::figures
