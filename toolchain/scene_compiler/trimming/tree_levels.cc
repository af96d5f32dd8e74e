#include "toolchain/scene_compiler/trimming/tree_levels.h"

#include <algorithm>

#include "core/pipeline/contact/contact_directions.h"
#include "core/pipeline/contact/contact_lengths.h"
#include "core/pipeline/contact/search/near_search.h"
#include "core/pipeline/penalty/penalty_contacts.h"
#include "core/scene/clearance_kernel.h"

namespace godobject::scene_compiler {
namespace {

using format::Node;

class Rebuilding {
 public:
  Rebuilding(std::span<const Node> nodes, std::uint32_t level) : from_(nodes), level_(level) {}

  std::vector<Node> make() {
    add(0, 0);
    return std::move(nodes_);
  }

 private:
  template <class Visit>
  void for_each_child(std::uint32_t n, const Visit& visit) const {
    for (std::uint32_t child = n + 1; child < from_[n].skip; child = from_[child].skip) visit(child);
  }

  void add(std::uint32_t n, std::uint16_t level) {
    const auto number = nodes_.size();
    nodes_.push_back(from_[n]);
    nodes_[number].level = level;
    const auto below = static_cast<std::uint16_t>(level + 1);
    bool all_leaves = true;
    for_each_child(n, [&](std::uint32_t child) { all_leaves &= from_[child].leaf != 0; });
    if (from_[n].level + 1u == level_ && all_leaves) {
      nodes_[number].leaf = 1;
    } else {
      for_each_child(n, [&](std::uint32_t child) {
        if (from_[child].level != level_ || from_[child].leaf != 0) return add(child, below);
        for_each_child(child, [&](std::uint32_t grandchild) { add(grandchild, below); });
      });
    }
    nodes_[number].skip = static_cast<std::uint32_t>(nodes_.size());
  }

  std::span<const Node> from_;
  std::uint32_t level_;
  std::vector<Node> nodes_;
};

/// A voxelmap that counts its look-ups. Batches use the kernel of every processor, so the count is the same everywhere.
class CountingField {
 public:
  CountingField(const Voxelmap& map, double& cost) : map_(map), cost_(cost) {}

  FieldSample sample(const Vector3& p) const noexcept { return ++cost_, map_.sample(p); }
  LayerSample layer(const Vector3& p) const noexcept { return ++cost_, map_.layer(p); }
  double lower_bound(const Vector3& center, double radius) const noexcept {
    return ++cost_, map_.lower_bound(center, radius);
  }
  void clearances(const Pose& H, PointBatch& batch) const noexcept {
    cost_ += SearchWork::kBatch + batch.count;
    if (!map_.in_batches()) return map_.clearances(H, batch);
    detail::look_up_clearances(map_.in_cells(H), batch.x, batch.y, batch.z, batch.clearance, batch.count);
  }
  void samples(const Pose& H, SampleBatch& batch) const noexcept {
    cost_ += SearchWork::kBatch + batch.count;
    sample_each(map_, H, batch);
  }
  std::uint64_t free_chords(const Pose&, const Pose&, SampleBatch&) const noexcept { return 0; }
  double lipschitz() const noexcept { return map_.lipschitz(); }
  double assured_clearance() const noexcept { return map_.assured_clearance(); }
  double voxel_size() const noexcept { return map_.voxel_size(); }
  double band() const noexcept { return map_.band(); }

 private:
  const Voxelmap& map_;
  double& cost_;
};

static_assert(DistanceField<CountingField>);

/// Step #1 of `contact` in one direction, once for each pose, with the search radius of a cycle that steady.
template <class Direction>
class NearWork {
 public:
  NearWork(const SceneView& scene, const Direction& direction, const Pointshell& shell, const CountingField& field)
      : scene_(scene),
        direction_(direction),
        shell_(shell),
        field_(field),
        lengths_(ContactLengths::make(Parameters::make(scene))),
        longest_(std::min(lengths_.longest_search_radius, field.assured_clearance() / direction.most_stretch())),
        memory_(NearSearch::memory(shell)) {
    search_.start(memory_, shell, field.lipschitz(), direction.most_stretch() * longest_);
  }

  void visit(const Pose& H_WB) {
    const double before = odometer_.travelled();
    odometer_.move_to(H_WB, lengths_.sphere);
    const double moved = odometer_.travelled() - before;
    const double free_cut = std::min(std::max(lengths_.margin, lengths_.shortest_search_radius), longest_);
    if (search_.is_free(odometer_.travelled() + moved, free_cut)) return;
    const double reach = direction_.most_stretch() *
                         lengths_.search_radius_for(ContactLengths::kSearchRadiusOverDisplacement * moved, longest_);
    if (search_.is_free(odometer_.travelled(), reach)) return;
    search_.find(
        direction_, field_, shell_, Direction::pose(H_WB, scene_.features_origin), odometer_.travelled(), reach, reach,
        PointBudget{}, work_, [](auto&&...) noexcept {}, [](auto&&...) noexcept {}, [](double) noexcept {});
  }

 private:
  const SceneView& scene_;
  Direction direction_;
  const Pointshell& shell_;
  WorkMeter work_;
  const CountingField& field_;
  ContactLengths lengths_;
  double longest_;
  std::vector<std::uint32_t> memory_;
  NearSearch search_;
  Odometer odometer_;
};

/// Calls visit(pose) for each pose, which adds to `cost`.
template <class Visit>
SearchWork work_of(std::span<const Pose> poses, const double& cost, const Visit& visit) {
  SearchWork work;
  for (const Pose& H_WB : poses) {
    const double before = cost;
    visit(H_WB);
    work.most = std::max(work.most, cost - before);
  }
  work.mean = poses.empty() ? 0.0 : cost / static_cast<double>(poses.size());
  return work;
}

}  // namespace

std::uint32_t deepest_level(std::span<const Node> nodes) {
  std::uint32_t deepest = 0;
  for (const Node& node : nodes) deepest = std::max<std::uint32_t>(deepest, node.level);
  return deepest;
}

std::vector<Node> without_level(std::span<const Node> nodes, std::uint32_t level) {
  return Rebuilding(nodes, level).make();
}

SearchWork search_work(const SceneView& scene, Tree tree, std::span<const Pose> poses_WB) {
  double cost = 0.0;
  const CountingField field(tree == Tree::kSamples ? scene.voxelmap : scene.body_map, cost);
  const Parameters q = Parameters::make(scene);
  if (tree == Tree::kFeatures) {
    const detail::FeatureDirection direction(ContactLengths::make(q),
                                             scene.body_map.surface_radius(q.mass.sphere.center));
    NearWork search(scene, direction, scene.features, field);
    return work_of(poses_WB, cost, [&](const Pose& H_WB) { search.visit(H_WB); });
  }
  if (scene.default_solver() == format::Solver::kContact) {
    NearWork search(scene, detail::SampleDirection{}, scene.pointshell, field);
    return work_of(poses_WB, cost, [&](const Pose& H_WB) { search.visit(H_WB); });
  }
  return work_of(poses_WB, cost, [&](const Pose& H_WB) {
    penalty_contacts<DistancePenetration>(field, scene.pointshell, H_WB, q.safety_distance, 0.0);
  });
}

LeanTree lean_tree(const SceneView& scene, Tree tree, std::span<const Pose> poses_WB) {
  SceneView tried = scene;
  std::span<const Node>& nodes = tree == Tree::kSamples ? tried.pointshell.nodes : tried.features.nodes;
  LeanTree lean{{nodes.begin(), nodes.end()}};
  SearchWork work = search_work(tried, tree, poses_WB);
  const double most = kMostGrowth * work.most;
  for (bool better = true; better;) {
    better = false;
    LeanTree best = lean;
    for (std::uint32_t level = 1; level <= deepest_level(lean.nodes); ++level) {
      const std::vector<Node> fewer = without_level(lean.nodes, level);
      if (fewer.size() == lean.nodes.size()) continue;  // leaves beside other nodes
      nodes = fewer;
      const SearchWork without = search_work(tried, tree, poses_WB);
      if (without.mean > work.mean || without.most > most) continue;
      better = true;
      work = without;
      best = {fewer, lean.levels_left_out + 1};
    }
    lean = std::move(best);
  }
  return lean;
}

}  // namespace godobject::scene_compiler
