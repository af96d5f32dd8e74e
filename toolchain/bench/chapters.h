#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "toolchain/bench/scene_cache.h"
#include "toolchain/bench/table.h"
#include "toolchain/bench/target.h"

namespace godobject::bench {

/// Options that all chapters share.
struct BenchRequest {
  std::filesystem::path scenes;  ///< folder of scene files, with `paths` and `meshes`
  std::filesystem::path cache;   ///< folder of compiled scenes
  bool full = false;             ///< more passes and larger scenes, some minutes more
  std::function<void(std::string_view phase, double done)> progress;
};

/// A curve of a plot.
struct Curve {
  std::string name;
  std::vector<double> x;
  std::vector<double> y;
};

/// A picture of curves; both axes logarithmic.
struct Plot {
  std::string name;  ///< of the PNG file, without its ending
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<Curve> curves;
};

/// The results of a chapter.
struct Chapter {
  std::vector<Table> tables;   ///< on stdout and on the page
  std::vector<Table> details;  ///< on the page and as CSV only
  std::vector<Plot> plots;
  std::vector<Target> targets;
  std::vector<std::string> remarks;
};

/// Times whole cycles of every pipeline on every workload, warm and cold, and the steps #1 and #2-#7 apart.
Chapter cycles_chapter(const BenchRequest& request);

/// Times the peers at the poses of `contact` in the same run, and their ratios to `contact`.
Chapter peers_chapter(const BenchRequest& request);

/// Times the sliding bunny with 10^3 .. 10^6 points, and with voxels of 2 .. 0.25 mm.
Chapter scaling_chapter(const BenchRequest& request);

}  // namespace godobject::bench
