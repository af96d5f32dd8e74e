#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/scene/format.h"
#include "core/scene/scene.h"
#include "godobject/pose.h"

namespace godobject::scene_compiler {

/// The depth of the deepest node.
std::uint32_t deepest_level(std::span<const format::Node> nodes);

/// The tree without its nodes at `level` >= 1: their children hang on the nodes above, which become leaves where all
/// that was below them were leaves. A leaf beside nodes that have children stays. Points keep their order.
std::vector<format::Node> without_level(std::span<const format::Node> nodes, std::uint32_t level);

/// What step #1 of the scene's own solver looks up in one tree along a motion. Counted, so that it is the same
/// everywhere: a node or a point counts 1, a batch kBatch more, about what that costs.
struct SearchWork {
  double mean = 0.0;  ///< of a cycle
  double most = 0.0;  ///< in one cycle

  static constexpr double kBatch = 4.0;
};

enum class Tree { kSamples, kFeatures };

/// `poses_WB`: of the god object, a cycle apart. `contact` searches the tree with its memory; of `paper` and
/// `corrected` every cycle begins anew.
SearchWork search_work(const Scene& scene, Tree tree, std::span<const Pose> poses_WB);

struct LeanTree {
  std::vector<format::Node> nodes;
  std::uint32_t levels_left_out = 0;
};

/// The tree without levels that add nothing: one after the other, that first which helps the most, as long as step #1
/// looks up no more without it in the mean, and in the worst cycle no more than kMostGrowth of what the whole tree
/// asks.
inline constexpr double kMostGrowth = 1.01;
LeanTree lean_tree(const Scene& scene, Tree tree, std::span<const Pose> poses_WB);

}  // namespace godobject::scene_compiler
