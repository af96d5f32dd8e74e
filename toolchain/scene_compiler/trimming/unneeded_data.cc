#include "toolchain/scene_compiler/trimming/unneeded_data.h"

#include <algorithm>
#include <cmath>
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

/// In the frame that X takes them to.
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
  Unneeded(const SolidSurface& still, const SolidSurface& moving, CompileReport& report, SceneParts& parts)
      : still_(still), moving_(moving), report_(report), parts_(parts), workspace_(report.config.workspace) {}

  std::uint64_t out_of_reach_points() {
    if (!workspace_ || report_.ball) return 0;
    return leave_out_samples(within_reach_of_field(parts_.field, *workspace_, samples(Eigen::Isometry3d::Identity())));
  }

  std::uint64_t sealed_points() {
    if (!knows_depth()) return 0;
    const std::vector<Vector3d> points_M = samples(body_pose(report_.body.body));
    return leave_out_samples(not_sealed_off(moving_, points_M, deepest(), least_piece(still_.mesh())));
  }

  std::uint64_t out_of_reach_features() {
    if (!workspace_ || parts_.features.points.empty()) return 0;
    return leave_out_features(within_reach_of_body(parts_.body_field, *workspace_, features()));
  }

  std::uint64_t sealed_features() {
    if (!knows_depth() || parts_.features.points.empty()) return 0;
    return leave_out_features(not_sealed_off(still_, features(), deepest(), least_piece(moving_.mesh())));
  }

  /// By a short motion.
  std::uint64_t levels() {
    if (report_.ball) return 0;
    const command::SceneImage image(make_image(lay_out(report_, parts_)), "what is left out");
    const Scene& scene = image.scene;
    const std::vector<Pose> poses = poses_along(scene, try_out_motion(scene));
    const auto leave_out = [&](Tree tree, std::vector<format::Node>& nodes, auto& header) {
      const LeanTree lean = lean_tree(scene, tree, poses);
      nodes = lean.nodes;
      header.node_count = static_cast<std::uint32_t>(nodes.size());
      header.level_count = deepest_level(nodes) + 1;
      return lean.levels_left_out;
    };
    std::uint64_t count = leave_out(Tree::kSamples, report_.body.nodes, report_.body.body);
    if (scene.has_features()) count += leave_out(Tree::kFeatures, parts_.features.nodes, parts_.features.header);
    report_.second.features = parts_.features.header;
    return count;
  }

  std::uint64_t bricks() {
    if (!workspace_) return 0;
    const double radius = look_up_radius(report_.body.body, report_.body.nodes);
    const LeftOutBricks left_out = leave_out_unreachable(parts_.field, *workspace_, radius);
    report_.grid = parts_.field.grid;
    report_.refinement.refined -= left_out.refined;
    report_.refinement.finer -= left_out.all_bricks - left_out.positions;
    report_.refinement.edges -= left_out.edges;
    for (std::size_t i = 0; i < left_out.bricks.size(); ++i) report_.refinement.bricks[i] -= left_out.bricks[i];
    return left_out.positions;
  }

  std::uint64_t core_bricks() {
    if (!workspace_ || parts_.features.points.empty()) return 0;
    const command::SceneImage image(make_image(lay_out(report_, parts_)), "what is left out");
    const Parameters q = Parameters::make(image.scene);
    const ContactLengths lengths = ContactLengths::make(q);
    const double body_radius = image.scene.body_map.surface_radius(q.mass.sphere.center);
    const godobject::detail::FeatureDirection direction(lengths, body_radius);
    // a near point's lever, and with that how far it goes
    const double lever = body_radius + direction.most_stretch() * lengths.longest_search_radius;
    const double longest_way = direction.stretch(lever) * lengths.longest_search_radius;
    const double least = least_look_up(parts_.features, *workspace_, longest_way);
    const LeftOutBricks left_out = leave_out_unreachable_core(parts_.body_field, least);
    report_.second.grid = parts_.body_field.grid;
    return left_out.positions;
  }

 private:
  /// Whether it is known how deep the bodies meet between points; only then are walls known to hold.
  bool knows_depth() const { return report_.second.sought && std::isfinite(report_.second.between.bound); }

  /// That, and a voxel for what the fields are off.
  double deepest() const {
    return report_.second.between.bound + report_.second.slack +
           std::max(report_.config.voxel_size, report_.config.body_voxel_size);
  }

  std::vector<Vector3d> samples(const Eigen::Isometry3d& X) const { return points_of(report_.body.points, X); }
  std::vector<Vector3d> features() const {
    Eigen::Isometry3d X_WF = Eigen::Isometry3d::Identity();
    X_WF.translation() = Eigen::Map<const Vector3d>(parts_.features.header.origin);
    return points_of(parts_.features.points, X_WF);
  }

  /// Not all of them: that nothing touches is for `bricks` to say.
  std::uint64_t leave_out_samples(const std::vector<bool>& stays) {
    const std::uint64_t count = count_of_left_out(stays);
    if (count == 0 || count == stays.size()) return 0;
    MovingBody& body = report_.body;
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
      report_.second.grid = {};
    } else {
      std::vector<float> no_normals;
      leave_out_points(stays, {features.points, no_normals, features.nodes}, features.header);
    }
    report_.second.features = features.header;
    return count;
  }

  const SolidSurface& still_;
  const SolidSurface& moving_;
  CompileReport& report_;
  SceneParts& parts_;
  const std::optional<format::Workspace>& workspace_;
};

}  // namespace

void leave_out_unneeded(const SolidSurface& still, const SolidSurface& moving, CompileReport& report, SceneParts& parts,
                        LeavingOut& leaving_out) {
  Unneeded unneeded(still, moving, report, parts);
  leaving_out.step("points of the moving body that touch nothing from the workspace",
                   [&] { return unneeded.out_of_reach_points(); });
  leaving_out.step("points of the moving body sealed off by its own walls", [&] { return unneeded.sealed_points(); });
  leaving_out.step("feature points that nothing touches from the workspace",
                   [&] { return unneeded.out_of_reach_features(); });
  leaving_out.step("feature points sealed off by the still body's walls", [&] { return unneeded.sealed_features(); });
  leaving_out.step("levels of the points' trees that save no look-up", [&] { return unneeded.levels(); });
  leaving_out.step("brick positions that no look-up reaches from the workspace", [&] { return unneeded.bricks(); });
  leaving_out.step("brick positions of the moving body's field that no feature point reaches from the workspace",
                   [&] { return unneeded.core_bricks(); });
}

}  // namespace godobject::scene_compiler
