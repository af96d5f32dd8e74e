#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/scene/format.h"
#include "core/scene/scene_view.h"
#include "godobject/pose.h"

namespace godobject::scene_compiler {

/// Returns the level of the deepest node.
std::uint32_t deepest_level(std::span<const format::Node> nodes);

/// Returns the tree without its nodes at `level` >= 1. Their children become children of the nodes above. A node above
/// becomes a leaf if all nodes below it were leaves. A leaf beside nodes with children stays. Points keep their order.
std::vector<format::Node> without_level(std::span<const format::Node> nodes, std::uint32_t level);

/// The number of look-ups of step #1 of the scene's own solver in one tree along a motion. Counting gives the same
/// result on every machine. A node or a point counts 1, a batch kBatch more, which is about its cost.
struct SearchWork {
  double mean = 0.0;  ///< of a cycle
  double most = 0.0;  ///< in one cycle

  static constexpr double kBatch = 4.0;
};

enum class Tree { kSamples, kFeatures };

/// Counts the look-ups. `poses_WB`: poses of the god object, one for each cycle. `contact` searches the tree with its
/// memory. `paper` and `corrected` start again at the root in every cycle.
SearchWork search_work(const SceneView& scene, Tree tree, std::span<const Pose> poses_WB);

struct LeanTree {
  std::vector<format::Node> nodes;
  std::uint32_t levels_left_out = 0;
};

/// Returns the tree without levels that save nothing. Removes one level after the other, the most useless first, as
/// long as step #1 needs no more look-ups on average, and in the worst cycle at most kMostGrowth times as many as with
/// the whole tree.
inline constexpr double kMostGrowth = 1.01;
LeanTree lean_tree(const SceneView& scene, Tree tree, std::span<const Pose> poses_WB);

}  // namespace godobject::scene_compiler
