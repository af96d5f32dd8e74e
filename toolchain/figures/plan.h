#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "toolchain/figures/crossing.h"
#include "toolchain/figures/figure.h"

namespace godobject::figures {

/// Title, text and markers of a scene in the demo.
struct ScenePlan {
  std::string name;   ///< folder of its replays
  std::string image;  ///< name of its scene image, without folder and extension
  std::string title;
  std::string text;  ///< a few sentences for the page
  std::vector<Marker> markers;
  std::optional<Barrier> barrier;
};

/// Title, text and markers of a run of the whole controller.
struct ArmPlan {
  ScenePlan scene;               ///< its name is the folder of its telemetry
  std::filesystem::path device;  ///< the arm's device file
};

/// A page of godobject-report to which the page links.
struct StudyPlan {
  std::string name;  ///< folder of its report.html
  std::string title;
  std::string text;
};

struct Plan {
  std::vector<ScenePlan> scenes;
  std::vector<ArmPlan> runs;
  std::vector<StudyPlan> studies;
};

/// Reads tables [[scene]] with name, image, title, text and, optionally, markers = { A = 0.4, ... } and barrier =
/// [point, normal]. Optional tables [[run]] have the same keys and device, a path relative to the file. Optional tables
/// [[study]] have name, title and text. Throws Failure: kNoInput, kBadData if it is not TOML, kBadConfig naming the
/// key.
Plan read_plan(const std::filesystem::path& file);

}  // namespace godobject::figures
