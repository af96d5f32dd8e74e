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

/// What all chapters need.
struct BenchRequest {
  std::filesystem::path scenes;  ///< folder of scene files, with `paths` and `meshes`
  std::filesystem::path cache;   ///< folder of compiled scenes
  bool full = false;             ///< also what takes minutes
  std::function<void(std::string_view phase, double done)> progress;
};

/// A curve over x for the page's plots.
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

/// What a chapter found.
struct Chapter {
  std::vector<Table> tables;   ///< on stdout and on the page
  std::vector<Table> details;  ///< on the page and as CSV only
  std::vector<Plot> plots;
  std::vector<Target> targets;
  std::vector<std::string> remarks;
};

/// Whole cycles of every pipeline on every workload, warm and cold, and steps #1 and #2-#7 apart.
Chapter cycles_chapter(const BenchRequest& request);

/// The peers at the poses of `contact`, in the same run, and how much quicker it is.
Chapter peers_chapter(const BenchRequest& request);

/// The sliding bunny with 10^3 .. 10^6 points, and with voxels of 2 .. 0.25 mm.
Chapter scaling_chapter(const BenchRequest& request);

}  // namespace godobject::bench
