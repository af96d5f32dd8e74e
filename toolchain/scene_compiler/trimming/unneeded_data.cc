#include "toolchain/scene_compiler/trimming/unneeded_data.h"

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "core/pipeline/contact/contact_directions.h"
#include "core/pipeline/contact/contact_lengths.h"
#include "toolchain/scene_compiler/trimming/pruned_tree.h"
#include "toolchain/scene_compiler/trimming/reachable_bricks.h"
#include "toolchain/scene_compiler/trimming/touchable_points.h"
#include "toolchain/scene_compiler/trimming/tree_levels.h"
#include "toolchain/scene_compiler/trimming/try_out.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;

/// Returns the points in the target frame of X.
std::vector<Vector3d> points_of(const std::vector<float>& axes, const Eigen::Isometry3d& X) {
  const std::size_t n = axes.size() / 3;
  std::vector<Vector3d> points;
  for (std::size_t i = 0; i < n; ++i)
    points.push_back(X * Eigen::Vector3f(axes[i], axes[n + i], axes[2 * n + i]).cast<double>());
  return points;
}

std::uint64_t count_of_left_out(const std::vector<bool>& stays) {
  return static_cast<std::uint64_t>(std::count(stays.begin(), stays.end(), false));
}

class Unneeded {
 public:
  Unneeded(SceneParts& parts, const TrimmingInput& input) : parts_(parts), input_(input) {}

  std::uint64_t out_of_reach_points() {
    if (!parts_.workspace || input_.moving_is_ball) return 0;
    return leave_out_samples(
        within_reach_of_field(parts_.field, *parts_.workspace, samples(Eigen::Isometry3d::Identity())));
  }

  std::uint64_t sealed_points() {
    if (!input_.deepest) return 0;
    const std::vector<Vector3d> points_M = samples(body_pose(parts_.body.body));
    return leave_out_samples(
        not_sealed_off(input_.moving, points_M, *input_.deepest, least_piece(input_.still.mesh())));
  }

  std::uint64_t out_of_reach_features() {
    if (!parts_.workspace || !has_features()) return 0;
    return leave_out_features(within_reach_of_body(parts_.body_field, *parts_.workspace, features()));
  }

  std::uint64_t sealed_features() {
    if (!input_.deepest || !has_features()) return 0;
    return leave_out_features(
        not_sealed_off(input_.still, features(), *input_.deepest, least_piece(input_.moving.mesh())));
  }

  /// Judged along try_out_motion().
  std::uint64_t levels() {
    if (input_.moving_is_ball) return 0;
    const files::SceneImage image(make_image(lay_out(parts_)), "image under trimming");
    const SceneView& scene = image.scene;
    const std::vector<Pose> poses = poses_along(scene, try_out_motion(scene));
    const auto leave_out = [&](Tree tree, std::vector<format::Node>& nodes, auto& header) {
      const LeanTree lean = lean_tree(scene, tree, poses);
      nodes = lean.nodes;
      header.node_count = static_cast<std::uint32_t>(nodes.size());
      header.level_count = deepest_level(nodes) + 1;
      return lean.levels_left_out;
    };
    std::uint64_t count = leave_out(Tree::kSamples, parts_.body.nodes, parts_.body.body);
    if (scene.has_features()) count += leave_out(Tree::kFeatures, parts_.features.nodes, parts_.features.header);
    return count;
  }

  std::uint64_t bricks(LeftOutBricks& left_out) {
    if (!parts_.workspace) return 0;
    const double radius = look_up_radius(parts_.body.body, parts_.body.nodes);
    left_out = leave_out_unreachable(parts_.field, *parts_.workspace, radius);
    return left_out.positions;
  }

  std::uint64_t core_bricks() {
    if (!parts_.workspace || !has_features()) return 0;
    const files::SceneImage image(make_image(lay_out(parts_)), "image under trimming");
    const Parameters q = Parameters::make(image.scene);
    const ContactLengths lengths = ContactLengths::make(q);
    const double body_radius = image.scene.body_map.surface_radius(q.mass.sphere.center);
    const godobject::detail::FeatureDirection direction(lengths, body_radius);
    // the lever of a near point bounds the distance that it travels
    const double lever = body_radius + direction.most_stretch() * lengths.longest_search_radius;
    const double longest_path = direction.stretch(lever) * lengths.longest_search_radius;
    const double least = least_look_up(parts_.features, *parts_.workspace, longest_path);
    return leave_out_unreachable_core(parts_.body_field, least).positions;
  }

 private:
  bool has_features() const { return !parts_.features.points.empty(); }

  std::vector<Vector3d> samples(const Eigen::Isometry3d& X) const { return points_of(parts_.body.points, X); }
  std::vector<Vector3d> features() const {
    Eigen::Isometry3d X_WF = Eigen::Isometry3d::Identity();
    X_WF.translation() = Eigen::Map<const Vector3d>(parts_.features.header.origin);
    return points_of(parts_.features.points, X_WF);
  }

  /// Never all of them: if the bodies never touch, `bricks` reports it.
  std::uint64_t leave_out_samples(const std::vector<bool>& stays) {
    const std::uint64_t count = count_of_left_out(stays);
    if (count == 0 || count == stays.size()) return 0;
    MovingBody& body = parts_.body;
    leave_out_points(stays, {body.points, body.normals, body.nodes}, body.body);
    return count;
  }

  std::uint64_t leave_out_features(const std::vector<bool>& stays) {
    const std::uint64_t count = count_of_left_out(stays);
    if (count == 0) return 0;
    StillFeatures& features = parts_.features;
    if (count == stays.size()) {
      features = {};
      parts_.body_field = {};
    } else {
      std::vector<float> no_normals;
      leave_out_points(stays, {features.points, no_normals, features.nodes}, features.header);
    }
    return count;
  }

  SceneParts& parts_;
  const TrimmingInput& input_;
};

}  // namespace

Trimmed leave_out_unneeded(SceneParts parts, const TrimmingInput& input) {
  Trimmed trimmed{std::move(parts), TrimmingSteps(input.timed), {}};
  Unneeded unneeded(trimmed.parts, input);
  const auto step = [&](const char* what, const std::function<std::uint64_t()>& work) {
    trimmed.steps.step(what, trimmed.parts, work);
  };
  step("points of the moving body that touch nothing from the workspace",
       [&] { return unneeded.out_of_reach_points(); });
  step("points of the moving body sealed off by its own walls", [&] { return unneeded.sealed_points(); });
  step("feature points that nothing touches from the workspace", [&] { return unneeded.out_of_reach_features(); });
  step("feature points sealed off by the still body's walls", [&] { return unneeded.sealed_features(); });
  step("levels of the points' trees that save no look-up", [&] { return unneeded.levels(); });
  step("brick positions that no look-up reaches from the workspace", [&] { return unneeded.bricks(trimmed.bricks); });
  step("brick positions of the moving body's field that no feature point reaches from the workspace",
       [&] { return unneeded.core_bricks(); });
  return trimmed;
}

}  // namespace godobject::scene_compiler
