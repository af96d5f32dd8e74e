#include "toolchain/scene_compiler/trimming/leaving_out.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <random>
#include <span>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/scene_compiler/compiled_once.h"
#include "tests/scene_compiler/test_meshes.h"
#include "toolchain/command_line/failure.h"
#include "toolchain/scene_compiler/compile_scene.h"
#include "toolchain/scene_compiler/report_json.h"
#include "toolchain/scene_compiler/report_text.h"
#include "toolchain/scene_compiler/trimming/tree_levels.h"
#include "toolchain/scene_compiler/trimming/try_out.h"
#include "toolchain/session/owned_god_object.h"

namespace godobject::scene_compiler::leaving_out_test {
namespace {

constexpr const char* kFriction = "[friction]\nstatic = 0.3\n";

/// A scene file without its [workspace].
struct Bodies {
  const char* still;
  double still_scale;
  const char* moving;
  double moving_scale;
  const char* more;

  std::string text() const {
    return fmt::format(
        "[still]\nmesh = \"{}\"\nscale = {:#g}\nvoxel_size = 0.004\nfield_tolerance = 0.5\n"
        "[moving]\nmesh = \"{}\"\nscale = {:#g}\npoints = 500\nlevels = 4\n{}{}",
        mesh_file(still).string(), still_scale, mesh_file(moving).string(), moving_scale, more, kFriction);
  }
};
constexpr Bodies kBracket{"bracket", 1.0, "cube_100mm", 0.3, ""};
constexpr Bodies kPeg{"cube_100mm", 1.0, "peg_round", 1.0, ""};
constexpr Bodies kTeapot{"teapot", 0.037, "bunny_npm", 0.0161497, "[contact]\nboth_directions = false\n"};

std::string table(const format::Workspace& w) {
  return fmt::format("[workspace]\nlow = [{:#.17g}, {:#.17g}, {:#.17g}]\nhigh = [{:#.17g}, {:#.17g}, {:#.17g}]\n",
                     w.low[0], w.low[1], w.low[2], w.high[0], w.high[1], w.high[2]);
}

class LeavesOut : public testing::Test {
 protected:
  CompileReport compile(const std::string& text, const char* output, bool timed = false) {
    return compile_once(text, folder_, output, {}, timed);
  }
  files::SceneImage image(const char* name) { return files::SceneImage::read(folder_.file(name)); }

  ScratchFolder folder_;
};

class Session {
 public:
  Session(const SceneView& scene, Solver solver, bool friction) : H_BM_(scene.H_MB.inverse()) {
    EXPECT_EQ(god_object_.start(scene, solver, friction), Status::kOk);
  }
  CycleReport update(const Pose& H_WB) {
    CycleReport report;
    EXPECT_EQ(god_object_->update({H_WB * H_BM_, Motion{}}, report), Status::kOk);
    return report;
  }

 private:
  OwnedGodObject god_object_;
  Pose H_BM_;
};

/// Moves devices in the workspace and a little outside, with all solvers. Both scenes must give the same bits. Returns
/// the number of cycles with contact.
int expect_same_bits(const SceneView& all, const SceneView& less, int sessions, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const auto vector = [&] { return Vector3(normal(random), normal(random), normal(random)); };
  const WorkspaceBox& box = less.workspace;
  const Vector3 size = box.high - box.low;
  int touching = 0;
  for (int k = 0; k < sessions; ++k) {
    for (const Solver solver : {Solver::kPaper, Solver::kCorrected, Solver::kContact}) {
      const bool friction = share(random) < 0.5;
      Session a(all, solver, friction);
      Session b(less, solver, friction);
      Pose device;
      device.translation = box.low + Vector3(share(random), share(random), share(random)).cwiseProduct(size);
      device.rotation = Quaternion(normal(random), normal(random), normal(random), normal(random)).normalized();
      Motion velocity;
      for (int cycle = 0; cycle < 300; ++cycle) {
        if (cycle % 40 == 0) {
          const Vector3 goal =
              box.low - 0.05 * size + 1.1 * Vector3(share(random), share(random), share(random)).cwiseProduct(size);
          velocity.translation = (goal - device.translation) / 40.0;
          velocity.rotation = 0.02 * vector();
        }
        device.translation += velocity.translation;
        device.rotation = exp_rotation(velocity.rotation) * device.rotation;
        const CycleReport x = a.update(device);
        const CycleReport y = b.update(device);
        EXPECT_TRUE(x.H_WS == y.H_WS) << format::kSolverNames[static_cast<int>(solver)] << ", cycle " << cycle;
        EXPECT_EQ(x.force.total_W.force, y.force.total_W.force);
        EXPECT_EQ(x.force.total_W.torque, y.force.total_W.torque);
        EXPECT_EQ(x.contacts, y.contacts);
        if (x.contacts > 0) {  // otherwise it is a bound from the spheres
          EXPECT_EQ(x.penetration, y.penetration);
        }
        EXPECT_EQ(x.outcome, y.outcome);
        if (x.contacts > 0) ++touching;
        if (testing::Test::HasFailure()) return touching;
      }
    }
  }
  return touching;
}

/// Returns the item of the report; null if there is none.
const LeftOut* item(const CompileReport& report, const char* words) {
  for (const LeftOut& left_out : report.left_out) {
    if (left_out.what.find(words) != std::string::npos) return &left_out;
  }
  return nullptr;
}

/// Returns the complete scene, limited to the workspace.
SceneView limited(const SceneView& scene, const format::Workspace& workspace) {
  SceneView all = scene;
  all.workspace.limited = true;
  all.workspace.low = Vector3(workspace.low[0], workspace.low[1], workspace.low[2]);
  all.workspace.high = Vector3(workspace.high[0], workspace.high[1], workspace.high[2]);
  return all;
}

struct Limited {
  Bodies bodies;
  format::Workspace workspace;
  int least_touching;
};

/// Sides, corners and middles of the still body.
std::vector<Limited> limited_scenes() {
  return {{kBracket, {{-0.01, 0.02, -0.05}, {0.03, 0.08, 0.05}}, 300},
          {kBracket, {{0.06, -0.02, -0.03}, {0.06, 0.05, 0.08}}, 0},
          {kPeg, {{-0.01, -0.01, 0.095}, {0.01, 0.01, 0.12}}, 300},
          {kTeapot, {{0.08, 0.0, -0.05}, {0.16, 0.09, 0.05}}, 300}};
}

TEST_F(LeavesOut, NothingThatChangesAResultInTheWorkspace) {
  const char* done = nullptr;
  std::uint32_t seed = 1;
  for (const Limited& scene : limited_scenes()) {
    if (done != scene.bodies.still) compile(scene.bodies.text(), "all.scene");
    done = scene.bodies.still;
    const CompileReport report = compile(scene.bodies.text() + table(scene.workspace), "less.scene");
    ASSERT_FALSE(report.left_out.empty());
    const files::SceneImage all = image("all.scene");
    const files::SceneImage less = image("less.scene");
    EXPECT_LT(less.bytes.span().size(), all.bytes.span().size());
    EXPECT_EQ(less.scene.body.radius, all.scene.body.radius);
    const int touching = expect_same_bits(limited(all.scene, scene.workspace), less.scene, 6, seed++);
    EXPECT_GE(touching, scene.least_touching) << "the test looks at nothing";
    if (HasFailure()) return;
  }
}

/// A peg upright above a cube: only its ends and the cube's upper edges can touch.
TEST_F(LeavesOut, PointsThatTouchNothing) {
  const Limited scene = limited_scenes()[2];
  const CompileReport all = compile(scene.bodies.text(), "all.scene");
  const CompileReport less = compile(scene.bodies.text() + table(scene.workspace), "less.scene");
  const LeftOut* const points = item(less, "points of the moving body");
  const LeftOut* const features = item(less, "feature points");
  ASSERT_TRUE(points != nullptr && features != nullptr && item(less, "brick positions") != nullptr);
  EXPECT_LT(less.points.body.point_count, 0.9 * all.points.body.point_count);
  EXPECT_EQ(points->count, all.points.body.point_count - less.points.body.point_count);
  EXPECT_LT(less.second.features.point_count, 0.9 * all.second.features.point_count);
  EXPECT_GT(less.second.features.point_count, 0u);
  EXPECT_EQ(features->count, all.second.features.point_count - less.second.features.point_count);
  EXPECT_NE(report_text(less).find(" of these left out"), std::string::npos);
}

std::string obj(const TriangleMesh& mesh) {
  std::string text;
  for (const Eigen::Vector3d& v : mesh.vertices) text += fmt::format("v {} {} {}\n", v.x(), v.y(), v.z());
  for (const auto& t : mesh.triangles) text += fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return text;
}

/// A hollow cube and a cube no smaller than the hollow, and the reverse with a loose piece in the hollow: edges of the
/// hollow itself are re-entrant, so they have no features.
TEST_F(LeavesOut, PointsInACavity) {
  using Eigen::Vector3d;
  const TriangleMesh hollow = joined(box(Vector3d::Constant(-0.05), Vector3d::Constant(0.05)),
                                     turned_inside_out(box(Vector3d::Constant(-0.015), Vector3d::Constant(0.015))));
  const std::string hollow_file = folder_.write("hollow.obj", obj(hollow)).string();
  const std::string cube_file = mesh_file("cube_100mm").string();
  const auto text = [](const std::string& still, const std::string& moving) {
    return fmt::format(
        "[still]\nmesh = \"{}\"\nvoxel_size = 0.004\nfield_tolerance = 0.5\n"
        "[moving]\nmesh = \"{}\"\npoints = 1000\nlevels = 4\n",
        still, moving);
  };
  const CompileReport moving = compile(text(cube_file, hollow_file), "moving.scene");
  const LeftOut* const of_moving = item(moving, "own walls");
  ASSERT_NE(of_moving, nullptr);
  EXPECT_GT(of_moving->count, 30u);
  const files::SceneImage image_of_moving = image("moving.scene");
  const Pointshell& shell = image_of_moving.scene.pointshell;
  EXPECT_EQ(shell.size + of_moving->count, 1000u + moving.second.added_points);
  for (std::size_t i = 0; i < shell.size; ++i)
    ASSERT_NEAR((image_of_moving.scene.H_MB * shell.point(i)).cwiseAbs().maxCoeff(), 0.05, 1e-6);

  const TriangleMesh rattle = joined(hollow, box(Vector3d::Constant(-0.008), Vector3d::Constant(0.008)));
  const std::string rattle_file = folder_.write("rattle.obj", obj(rattle)).string();
  const CompileReport still = compile(text(rattle_file, cube_file), "still.scene");
  const LeftOut* const of_still = item(still, "still body's walls");
  ASSERT_NE(of_still, nullptr);
  EXPECT_EQ(still.second.features.point_count + of_still->count, still.second.found());
  const files::SceneImage image_of_still = image("still.scene");
  const Pointshell& features = image_of_still.scene.features;
  for (std::size_t i = 0; i < features.size; ++i)
    ASSERT_NEAR((image_of_still.scene.features_origin + features.point(i)).cwiseAbs().maxCoeff(), 0.05, 1e-6);
}

/// The scene of an image with more points in a sphere about `center` (in M), as the last leaf.
class WithMorePoints {
 public:
  WithMorePoints(const SceneView& scene, std::span<const Vector3> more_M, const Vector3& center_M) : scene_(scene) {
    const Pointshell& shell = scene.pointshell;
    const std::array<const float*, 6> from = {shell.x,        shell.y,        shell.z,
                                              shell.normal_x, shell.normal_y, shell.normal_z};
    for (std::size_t axis = 0; axis < 6; ++axis) axes_[axis].assign(from[axis], from[axis] + shell.size);
    const Pose H_BM = scene.H_MB.inverse();
    const Vector3 center = H_BM * center_M;
    format::Node leaf{};
    for (const Vector3& p_M : more_M) {
      const Vector3 p = H_BM * p_M;
      const Vector3 into = H_BM.rotation * (p_M - center_M).normalized();
      for (int axis = 0; axis < 3; ++axis) {
        axes_[static_cast<std::size_t>(axis)].push_back(static_cast<float>(p[axis]));
        axes_[static_cast<std::size_t>(axis + 3)].push_back(static_cast<float>(into[axis]));
        leaf.center[axis] = static_cast<float>(center[axis]);
      }
      leaf.radius = std::max(leaf.radius, static_cast<float>((p - center).norm() * 1.001));
    }
    nodes_.assign(shell.nodes.begin(), shell.nodes.end());
    leaf.first_point = static_cast<std::uint32_t>(shell.size);
    leaf.point_count = static_cast<std::uint32_t>(more_M.size());
    leaf.level = 1;
    leaf.leaf = 1;
    nodes_.push_back(leaf);
    nodes_.back().skip = nodes_.front().skip = static_cast<std::uint32_t>(nodes_.size());
    nodes_.front().point_count += leaf.point_count;
    scene_.pointshell = {axes_[0].size(), axes_[0].data(), axes_[1].data(), axes_[2].data(),
                         axes_[3].data(), axes_[4].data(), axes_[5].data(), nodes_};
  }
  const SceneView& scene() const { return scene_; }

 private:
  SceneView scene_;
  std::array<std::vector<float>, 6> axes_;
  std::vector<format::Node> nodes_;
};

/// A hollow cube, pressed on a cube of the same size from all sides, also with the other cube in its hollow: it moves
/// as if nothing had been left out.
TEST_F(LeavesOut, PointsInACavityThatChangeNoMotion) {
  using Eigen::Vector3d;
  constexpr double kHollow = 0.015;
  const TriangleMesh hollow = joined(box(Vector3d::Constant(-0.05), Vector3d::Constant(0.05)),
                                     turned_inside_out(box(Vector3d::Constant(-kHollow), Vector3d::Constant(kHollow))));
  const std::string hollow_file = folder_.write("hollow.obj", obj(hollow)).string();
  const CompileReport report =
      compile(fmt::format("[still]\nmesh = \"{}\"\nvoxel_size = 0.004\nfield_tolerance = 0.5\n"
                          "[moving]\nmesh = \"{}\"\npoints = 1000\nlevels = 4\n[friction]\nstatic = 0.3\n",
                          mesh_file("cube_100mm").string(), hollow_file),
              "less.scene");
  ASSERT_NE(item(report, "own walls"), nullptr);
  const files::SceneImage less = image("less.scene");
  std::mt19937 random(8);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto vector = [&] { return Vector3(uniform(random), uniform(random), uniform(random)); };
  std::vector<Vector3> of_hollow;
  for (int i = 0; i < 200; ++i) {
    Vector3 p = kHollow * vector();
    p[i % 3] = i % 2 == 0 ? kHollow : -kHollow;
    of_hollow.push_back(p);
  }
  const WithMorePoints all(less.scene, of_hollow, Vector3::Zero());
  int touching = 0;
  int through = 0;  // the device's hollow is in the other cube
  for (int session = 0; session < 8; ++session) {
    const bool friction = session % 2 == 1;
    Session a(all.scene(), Solver::kContact, friction);
    Session b(less.scene, Solver::kContact, friction);
    Pose device;
    device.translation = 0.2 * vector().normalized();
    Motion velocity;
    for (int cycle = 0; cycle < 600; ++cycle) {
      if (cycle % 60 == 0) {
        velocity.translation = (0.06 * vector() - device.translation) / 60.0;
        velocity.rotation = 0.01 * vector();
      }
      device.translation += velocity.translation;
      device.rotation = exp_rotation(velocity.rotation) * device.rotation;
      const CycleReport x = a.update(device);
      const CycleReport y = b.update(device);
      ASSERT_TRUE(x.H_WS == y.H_WS) << "session " << session << ", cycle " << cycle;
      ASSERT_EQ(x.force.total_W.force, y.force.total_W.force);
      ASSERT_EQ(x.force.total_W.torque, y.force.total_W.torque);
      ASSERT_EQ(x.contacts, y.contacts);
      if (x.contacts > 0) ++touching;
      const Vector3 at = (device * less.scene.H_MB.inverse()).translation;
      if ((at.cwiseAbs().maxCoeff() < 0.05)) ++through;
    }
  }
  EXPECT_GT(touching, 2000);
  EXPECT_GT(through, 500);
}

/// Far above the middle of a face no edge of the cube is met: no second direction.
TEST_F(LeavesOut, TheSecondDirectionWhereNoFeatureIsMet) {
  const Bodies bodies{"cube_100mm", 2.0, "cube_100mm", 0.3, ""};
  const format::Workspace workspace{{-0.02, -0.02, 0.1}, {0.02, 0.02, 0.15}};
  compile(bodies.text(), "all.scene");
  const CompileReport report = compile(bodies.text() + table(workspace), "less.scene");
  EXPECT_GT(report.second.found(), 0u);
  const files::SceneImage all = image("all.scene");
  const files::SceneImage less = image("less.scene");
  EXPECT_TRUE(all.scene.has_features());
  EXPECT_FALSE(less.scene.has_features());
  EXPECT_GT(expect_same_bits(limited(all.scene, workspace), less.scene, 6, 9), 300);
  EXPECT_NE(report_text(report).find("all left out"), std::string::npos);
}

/// Every kind of look-up within R_max of the box.
TEST_F(LeavesOut, NoBrickThatALookUpMeets) {
  const Limited scene = limited_scenes().front();
  compile(scene.bodies.text(), "all.scene");
  const CompileReport report = compile(scene.bodies.text() + table(scene.workspace), "less.scene");
  const files::SceneImage all = image("all.scene");
  const files::SceneImage less = image("less.scene");
  const LeftOut* const bricks = item(report, "positions that no look-up");
  ASSERT_NE(bricks, nullptr);
  EXPECT_GT(bricks->count, 10u);
  EXPECT_LT(less.scene.grid.brick_count, all.scene.grid.brick_count);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const WorkspaceBox& box = less.scene.workspace;
  const double radius = less.scene.body.radius;
  int known = 0;
  int lost = 0;
  for (int k = 0; k < 200000; ++k) {
    const Vector3 at = box.low + Vector3(share(random), share(random), share(random)).cwiseProduct(box.high - box.low);
    const Vector3 way = Vector3(normal(random), normal(random), normal(random)).normalized();
    const Vector3 p = at + radius * (k % 2 == 0 ? 1.0 : share(random)) * way;
    const FieldSample x = all.scene.voxelmap.sample(p);
    const FieldSample y = less.scene.voxelmap.sample(p);
    ASSERT_EQ(x.distance, y.distance) << p.transpose();
    ASSERT_EQ(x.clearance, y.clearance);
    ASSERT_EQ(x.gradient, y.gradient);
    ASSERT_EQ(x.known, y.known);
    ASSERT_EQ(all.scene.voxelmap.lower_bound(p, 0.01), less.scene.voxelmap.lower_bound(p, 0.01));
    ASSERT_EQ(all.scene.voxelmap.layer(p).layer, less.scene.voxelmap.layer(p).layer);
    if (x.known) ++known;
    // farther away: unchanged, or held
    const Vector3 q = at + 4.0 * radius * way;
    const FieldSample there = less.scene.voxelmap.sample(q);
    if (there.distance == all.scene.voxelmap.sample(q).distance) continue;
    ++lost;
    ASSERT_FALSE(there.known);
    ASSERT_LT(there.distance, 0.0);
    ASSERT_LE(there.clearance, 0.0);
  }
  EXPECT_GT(known, 10000);
  EXPECT_GT(lost, 100);
}

/// A large cube whose centre stays well above a small one's edges: its core meets none of them.
TEST_F(LeavesOut, NoBrickOfTheMovingBodyThatAFeatureMeets) {
  const Bodies bodies{"cube_100mm", 0.3, "cube_100mm", 1.0, ""};
  const format::Workspace workspace{{-0.02, -0.02, 0.09}, {0.02, 0.02, 0.1}};
  compile(bodies.text(), "all.scene");
  const CompileReport report = compile(bodies.text() + table(workspace), "less.scene");
  const LeftOut* const bricks = item(report, "moving body's field");
  ASSERT_NE(bricks, nullptr);
  EXPECT_GT(bricks->count, 10u);
  EXPECT_GT(bricks->bytes, 10u * sizeof(format::Brick));
  const files::SceneImage all = image("all.scene");
  const files::SceneImage less = image("less.scene");
  const Pointshell& features = all.scene.features;
  std::mt19937 random(6);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const WorkspaceBox& box = less.scene.workspace;
  int known = 0;
  for (int k = 0; k < 200000; ++k) {
    const Vector3 at = box.low + Vector3(share(random), share(random), share(random)).cwiseProduct(box.high - box.low);
    const Vector3 feature = all.scene.features_origin + features.point(random() % features.size);
    // and up to a quarter of the longest search radius, 1.5 voxels, nearer: a place on a path
    const double radius = (feature - at).norm() - (k % 2 == 0 ? 0.0 : 0.25 * 1.5 * 0.004 * share(random));
    const Vector3 p = radius * Vector3(normal(random), normal(random), normal(random)).normalized();
    const FieldSample x = all.scene.body_map.sample(p);
    const FieldSample y = less.scene.body_map.sample(p);
    ASSERT_EQ(x.distance, y.distance) << p.transpose();
    ASSERT_EQ(x.clearance, y.clearance);
    ASSERT_EQ(x.gradient, y.gradient);
    if (x.known) ++known;
  }
  EXPECT_GT(known, 10000);
  EXPECT_GT(expect_same_bits(limited(all.scene, workspace), less.scene, 6, 17), 100);
}

TEST_F(LeavesOut, NothingWithoutAWorkspaceThatIsReachableEverywhere) {
  const CompileReport report = compile(kBracket.text() + table({{-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0}}), "less.scene");
  EXPECT_EQ(item(report, "workspace"), nullptr);
  EXPECT_TRUE(image("less.scene").scene.workspace.limited);
}

/// Leaves out any level of either tree, and all.
TEST_F(LeavesOut, LevelsThatChangeNoResult) {
  compile(kBracket.text(), "all.scene");
  const files::SceneImage whole = image("all.scene");
  const SceneView& all = whole.scene;
  const SceneView limited_all = limited(all, {{-0.06, -0.06, -0.06}, {0.16, 0.12, 0.14}});
  const std::uint32_t deepest = deepest_level(all.pointshell.nodes);
  ASSERT_GE(deepest, 2u);
  std::vector<format::Node> fewer(all.pointshell.nodes.begin(), all.pointshell.nodes.end());
  for (std::uint32_t level = deepest; level > 0; --level) {
    fewer = without_level(fewer, level);
    const auto features = without_level(all.features.nodes, 1 + level % deepest_level(all.features.nodes));
    SceneView scene = limited_all;
    scene.pointshell.nodes = fewer;
    scene.features.nodes = features;
    EXPECT_GT(expect_same_bits(limited_all, scene, 2, level), 100);
    if (HasFailure()) return;
  }
  EXPECT_EQ(fewer.size(), 1u);
}

TEST_F(LeavesOut, LevelsOnlyWhereNoMoreIsLookedUp) {
  for (const char* solver : {"contact", "corrected"}) {
    Bodies bodies = kBracket;
    const std::string more = fmt::format("[contact]\nsolver = \"{}\"\n", solver);
    bodies.more = more.c_str();
    compile(bodies.text(), "all.scene");
    const files::SceneImage whole = image("all.scene");
    const std::vector<Pose> poses = poses_along(whole.scene, try_out_motion(whole.scene));
    ASSERT_GT(poses.size(), 1000u);
    for (const Tree tree : {Tree::kSamples, Tree::kFeatures}) {
      // the compiler removed useless levels; a tree with one more level, a node over each leaf, needs more look-ups
      SceneView scene = whole.scene;
      std::span<const format::Node>& nodes = tree == Tree::kSamples ? scene.pointshell.nodes : scene.features.nodes;
      EXPECT_EQ(lean_tree(scene, tree, poses).levels_left_out, 0u);
      std::vector<format::Node> more_nodes;
      std::vector<std::uint32_t> number;  // of the old nodes
      for (const format::Node& node : nodes) {
        number.push_back(static_cast<std::uint32_t>(more_nodes.size()));
        more_nodes.push_back(node);
        if (node.leaf == 0) continue;
        more_nodes.back().leaf = 0;
        more_nodes.push_back(node);
        ++more_nodes.back().level;
      }
      number.push_back(static_cast<std::uint32_t>(more_nodes.size()));
      for (format::Node& node : more_nodes) node.skip = number[node.skip];
      const SearchWork before = search_work(scene, tree, poses);
      nodes = more_nodes;
      EXPECT_GT(search_work(scene, tree, poses).mean, before.mean);
      const LeanTree lean = lean_tree(scene, tree, poses);
      EXPECT_GE(lean.levels_left_out, 1u);
      nodes = lean.nodes;
      EXPECT_LE(search_work(scene, tree, poses).mean, before.mean);
    }
  }
}

TEST_F(LeavesOut, NamesTheCureWhereTheBodiesNeverMeet) {
  try {
    compile(kBracket.text() + table({{1.0, 1.0, 1.0}, {1.1, 1.1, 1.1}}), "none.scene");
    FAIL() << "took a workspace that is out of reach";
  } catch (const command::Failure& failure) {
    EXPECT_EQ(failure.exit_code(), command::ExitCode::kBadConfig);
    EXPECT_NE(std::string(failure.what()).find("set low and high"), std::string::npos) << failure.what();
  }
  EXPECT_FALSE(std::filesystem::exists(folder_.file("none.scene")));
}

TEST_F(LeavesOut, AndTellsBytesAndTimesButKeepsTimesOutOfTheImage) {
  const Limited scene = limited_scenes().front();
  const std::string text = scene.bodies.text() + table(scene.workspace);
  const CompileReport all = compile(scene.bodies.text(), "all.scene");
  const CompileReport plain = compile(text, "plain.scene");
  const CompileReport timed = compile(text, "timed.scene", true);
  ASSERT_EQ(plain.left_out.size(), timed.left_out.size());
  ASSERT_FALSE(timed.left_out.empty());
  EXPECT_FALSE(plain.left_out.front().cycle);
  EXPECT_FALSE(plain.cycle_ns);
  ASSERT_TRUE(timed.left_out.front().cycle);
  ASSERT_TRUE(timed.cycle_ns);
  EXPECT_GT(*timed.cycle_ns, 0.0);
  EXPECT_TRUE(std::isfinite(timed.left_out.front().cycle->ns));
  EXPECT_GE(timed.left_out.front().cycle->uncertainty, 0.0);
  const auto with_what_is_left_out = [](const CompileReport& report) {
    std::uint64_t sum = 0;
    for (const auto& [id, bytes] : report.sections) sum += bytes;
    for (const LeftOut& item : report.left_out) sum += item.bytes;
    return sum;
  };
  EXPECT_EQ(with_what_is_left_out(plain), with_what_is_left_out(all) + sizeof(format::Workspace));
  EXPECT_GT(plain.left_out.size(), all.left_out.size());
  const Json json = full_report_json(timed);
  EXPECT_EQ(json["left_out"][0]["bytes_saved"], timed.left_out.front().bytes);
  EXPECT_TRUE(json["left_out"][0].contains("nanoseconds_saved"));
  EXPECT_EQ(json["workspace"]["low"][1], scene.workspace.low[1]);
  EXPECT_NE(report_text(timed).find("ns a cycle"), std::string::npos);
  EXPECT_NE(report_text(timed).find(" +- "), std::string::npos);
  EXPECT_EQ(report_text(plain).find(" +- "), std::string::npos);
  const files::SceneImage a = image("plain.scene");
  const files::SceneImage b = image("timed.scene");
  EXPECT_TRUE(std::ranges::equal(a.bytes.span(), b.bytes.span()));
}

}  // namespace
}  // namespace godobject::scene_compiler::leaving_out_test
