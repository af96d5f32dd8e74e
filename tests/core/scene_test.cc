#include "core/scene/scene_view.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <ostream>
#include <string>
#include <utility>

#include "tests/support/analytic_shapes.h"
#include "tests/support/scene_image_builder.h"
#include "tests/support/whole_image.h"

namespace godobject {
namespace {

using format::SectionId;
using test::SceneImage;
using test::section_item;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Returns a ball of two voxels' diameter, and a box of 26 points under a tree of seven nodes: 7 KiB in all.
SceneImage small_image() {
  test::SceneDescription description;
  description.distance = [](const Vector3& p) { return test::ball_distance(p, 0.01); };
  description.surface_min = Vector3::Constant(-0.01);
  description.surface_max = Vector3::Constant(0.01);
  description.voxel_size = 0.01;
  description.band = 0.01;
  description.settings.safety_distance = 0.005;
  const test::SurfaceSamples box = test::sample_box(Vector3(0.01, 0.02, 0.03), 3);
  description.points = box.points;
  description.normals = box.normals;
  description.level_count = 3;
  description.H_MB.rotation = Quaternion(0.5, 0.5, -0.5, 0.5);
  description.H_MB.translation = Vector3(0.1, 0.2, 0.3);
  description.workspace = format::Workspace{{-1.0, -2.0, -3.0}, {1.0, 2.0, -3.0}};
  description.provenance = R"({"still": "ball"})";
  return test::build_scene_image(description);
}

/// Returns the same ball with refinements at two positions, 0 and 2, and in the first one's last octant, 1. The lowest
/// octant of the second position is coarse.
SceneImage refined_image(std::optional<format::Facet> facet = {}) {
  test::SceneDescription description;
  description.distance = [](const Vector3& p) { return test::ball_distance(p, 0.01); };
  description.surface_min = Vector3::Constant(-0.01);
  description.surface_max = Vector3::Constant(0.01);
  description.voxel_size = 0.01;
  description.band = 0.01;
  description.settings.safety_distance = 0.005;
  description.points = {Vector3(0.01, 0.0, 0.0)};
  description.refined = [](const Vector3& center, double size) {
    if (size > 0.03) return center.y() < 0.0 && center.z() < 0.0;  // two positions, side by side along x
    return size > 0.015 && center.norm() < 0.001;                  // the last octant of the first
  };
  description.coarse = [](const Vector3& center, double) {
    return (center - Vector3(0.02, -0.02, -0.02)).norm() < 1e-6;
  };
  description.facet = facet;
  return test::build_scene_image(description);
}

/// Returns the bytes of the view.
std::array<std::byte, sizeof(SceneView)> bytes_of(const SceneView& scene) {
  std::array<std::byte, sizeof(SceneView)> bytes{};
  std::memcpy(bytes.data(), static_cast<const void*>(&scene), sizeof(SceneView));
  return bytes;
}

/// Opens `image` over another scene. A refused image must leave that scene unchanged.
Status open_over_another(std::span<const std::byte> image) {
  static const SceneImage another = small_image();
  static const SceneView opened = test::open_scene(another);
  SceneView scene = opened;
  const auto before = bytes_of(scene);
  const Status status = SceneView::open(image, scene);
  if (status != Status::kOk) {
    EXPECT_EQ(bytes_of(scene), before) << "a refused image has changed the scene";
  }
  return status;
}

TEST(Scene, ShowsWhatTheImageHolds) {
  const SceneImage image = small_image();
  const SceneView scene = test::open_scene(image);
  EXPECT_EQ(scene.pointshell.size, 26u);
  EXPECT_EQ(scene.pointshell.nodes.size(), 7u);
  EXPECT_EQ(scene.body.level_count, 3u);
  EXPECT_TRUE(scene.holds(format::Solver::kPaper));
  EXPECT_TRUE(scene.holds(format::Solver::kCorrected));
  EXPECT_DOUBLE_EQ(scene.settings.safety_distance, 0.005);
  EXPECT_EQ(scene.voxelmap.voxel_size(), 0.01);
  EXPECT_EQ(scene.voxelmap.band(), 0.01);
  EXPECT_NEAR(scene.voxelmap.sample(Vector3(0.01, 0.0, 0.0)).distance, 0.0, 1e-9);  // a node, rounded to float
  EXPECT_TRUE(scene.workspace.limited);
  EXPECT_EQ(scene.workspace.low, Vector3(-1.0, -2.0, -3.0));
  EXPECT_EQ(scene.workspace.high, Vector3(1.0, 2.0, -3.0));
  EXPECT_EQ(scene.H_MB.translation, Vector3(0.1, 0.2, 0.3));
  EXPECT_EQ(scene.H_MB.rotation.coeffs(), Quaternion(0.5, 0.5, -0.5, 0.5).coeffs());
  EXPECT_EQ(scene.provenance.size(), std::strlen(R"({"still": "ball"})"));
  // R_max is the corner's distance, and each normal points towards the centre
  EXPECT_NEAR(scene.body.radius, Vector3(0.01, 0.02, 0.03).norm(), 1e-8);
  for (std::size_t i = 0; i < scene.pointshell.size; ++i) {
    EXPECT_LT(scene.pointshell.point(i).dot(scene.pointshell.normal(i)), 0.0);
  }
}

TEST(Scene, OpensWithoutNormalsWhenPaperIsNotHeld) {
  test::SceneDescription description;
  description.distance = [](const Vector3& p) { return test::ball_distance(p, 0.01); };
  description.surface_min = Vector3::Constant(-0.01);
  description.surface_max = Vector3::Constant(0.01);
  description.points = test::sample_ball(0.02, 40).points;
  const SceneImage image = test::build_scene_image(description);
  const SceneView scene = test::open_scene(image);
  EXPECT_EQ(scene.pointshell.normal_x, nullptr);
  EXPECT_FALSE(scene.workspace.limited);
  EXPECT_TRUE(scene.workspace.contains(Vector3(1e7, -1e7, 0.0)));
  EXPECT_FALSE(scene.holds(format::Solver::kPaper));
}

TEST(Scene, RefusesEveryTruncation) {
  const SceneImage image = small_image();
  for (std::size_t bytes = 0; bytes < image.bytes().size(); ++bytes) {
    ASSERT_EQ(open_over_another(image.bytes().first(bytes)), Status::kImageTruncated) << bytes << " bytes";
  }
}

TEST(Scene, RefusesBytesTooMany) {
  const SceneImage image = small_image();
  SceneImage longer(image.bytes().size() + format::kAlignment);
  std::ranges::copy(image.bytes(), longer.bytes().begin());
  EXPECT_EQ(open_over_another(longer.bytes()), Status::kImageTruncated);
  EXPECT_EQ(open_over_another(longer.bytes().first(image.bytes().size() + 1)), Status::kImageTruncated);
}

TEST(Scene, RefusesEverySingleBitFlip) {
  SceneImage image = small_image();
  for (std::size_t bit = 0; bit < 8 * image.bytes().size(); ++bit) {
    const std::byte mask{static_cast<unsigned char>(1u << (bit % 8))};
    image.bytes()[bit / 8] ^= mask;
    ASSERT_NE(open_over_another(image.bytes()), Status::kOk) << "byte " << bit / 8 << " bit " << bit % 8;
    image.bytes()[bit / 8] ^= mask;
  }
  EXPECT_EQ(open_over_another(image.bytes()), Status::kOk);
}

/// An image with a flipped bit and a correct checksum may open or not. If it opens, it must be safe: the sanitizers
/// judge.
TEST(Scene, SurvivesEverySingleBitFlipBehindRightChecksums) {
  const SceneImage whole = small_image();
  std::size_t refused = 0;
  for (std::size_t bit = 0; bit < 8 * whole.bytes().size(); ++bit) {
    SceneImage image = whole;
    image.bytes()[bit / 8] ^= std::byte{static_cast<unsigned char>(1u << (bit % 8))};
    auto& header = *reinterpret_cast<format::Header*>(image.bytes().data());
    const std::uint32_t header_bytes = reinterpret_cast<const format::Header*>(whole.bytes().data())->header_bytes;
    if (bit / 8 >= header_bytes) {
      test::seal(image);
    } else {
      header.checksum = 0;
      header.checksum = format::checksum(image.bytes().data(), header_bytes);
    }
    SceneView scene;
    if (SceneView::open(image.bytes(), scene) != Status::kOk) {
      ++refused;
      continue;
    }
    for (const Vector3& p : {Vector3(0.0, 0.0, 0.0), Vector3(0.012, 0.001, -0.009), Vector3(-0.029, 0.029, 0.02)}) {
      ASSERT_FALSE(std::isnan(scene.voxelmap.sample(p).distance)) << "byte " << bit / 8 << " bit " << bit % 8;
      ASSERT_FALSE(std::isnan(scene.voxelmap.lower_bound(p, 0.001))) << "byte " << bit / 8 << " bit " << bit % 8;
    }
    for (std::size_t i = 0; i < scene.pointshell.size; ++i) ASSERT_TRUE(scene.pointshell.point(i).allFinite());
  }
  EXPECT_GT(refused, whole.bytes().size());
}

TEST(Scene, RefusesAMisalignedBuffer) {
  const SceneImage image = small_image();
  const std::size_t bytes = image.bytes().size();
  SceneImage room(bytes + format::kAlignment);
  for (const std::size_t shift : {1u, 8u, 16u, 32u, 63u}) {
    std::ranges::copy(image.bytes(), room.bytes().begin() + static_cast<std::ptrdiff_t>(shift));
    EXPECT_EQ(open_over_another(room.bytes().subspan(shift, bytes)), Status::kImageLayout) << shift;
  }
}

struct Spoiled {
  const char* what;
  Status status;
  void (*spoil)(SceneImage& image);
};

void PrintTo(const Spoiled& spoiled, std::ostream* out) { *out << spoiled.what; }

class SceneRefuses : public ::testing::TestWithParam<Spoiled> {};

TEST_P(SceneRefuses, EvenWithRightChecksums) {
  SceneImage image = small_image();
  GetParam().spoil(image);
  EXPECT_EQ(describe(open_over_another(image.bytes())), std::string(describe(GetParam().status)));
}

format::Header& header_of(SceneImage& image) { return *reinterpret_cast<format::Header*>(image.bytes().data()); }

format::Section& section_of(SceneImage& image, SectionId id) {
  auto* sections = reinterpret_cast<format::Section*>(image.bytes().data() + sizeof(format::Header));
  while (sections->id != id) ++sections;
  return *sections;
}

/// Writes the checksum of the header alone. A spoiled table does not lead to the sections.
void seal_header(SceneImage& image, std::uint32_t header_bytes) {
  header_of(image).checksum = 0;
  header_of(image).checksum = format::checksum(image.bytes().data(), header_bytes);
}

template <class Change>
void change_header(SceneImage& image, Change change) {
  const std::uint32_t header_bytes = header_of(image).header_bytes;
  change(header_of(image));
  seal_header(image, header_bytes);
}

template <SectionId kId, class Change>
void change_section(SceneImage& image, Change change) {
  change(section_of(image, kId));
  seal_header(image, header_of(image).header_bytes);
}

template <class T, SectionId kId, std::size_t kItem = 0, class Change>
void change(SceneImage& image, Change change) {
  change(section_item<T>(image, kId, kItem));
  test::seal(image);
}

template <SectionId kId>
void leave_out(SceneImage& image) {
  change_section<kId>(image, [](format::Section& section) { section.id = static_cast<SectionId>(15); });
}

#define HEADER(CHANGE) [](SceneImage& i) { change_header(i, [](format::Header& x) { CHANGE; }); }
#define SECTION(ID, CHANGE) [](SceneImage& i) { change_section<SectionId::ID>(i, [](format::Section& x) { CHANGE; }); }
#define ITEM(T, ID, N, CHANGE) [](SceneImage& i) { change<T, SectionId::ID, N>(i, [](T& x) { CHANGE; }); }
#define SETTINGS(CHANGE) ITEM(format::Settings, kSettings, 0, CHANGE)
#define GRID(CHANGE) ITEM(format::Grid, kGrid, 0, CHANGE)
#define BODY(CHANGE) ITEM(format::Body, kBody, 0, CHANGE)
#define BRICK(CHANGE) ITEM(format::Brick, kBricks, 1, CHANGE)
#define WORKSPACE(CHANGE) ITEM(format::Workspace, kWorkspace, 0, CHANGE)
#define NODE(N, CHANGE) ITEM(format::Node, kNodes, N, CHANGE)

constexpr Spoiled kLayouts[] = {
    {"magic", Status::kImageForeign, HEADER(x.magic[5] = 'X')},
    {"big-endian", Status::kImageForeign, HEADER(x.byte_order = 0x04030201)},
    {"older version", Status::kImageVersion, HEADER(x.version = format::kVersion - 1)},
    {"newer version", Status::kImageVersion, HEADER(x.version = format::kVersion + 1)},
    {"claims more bytes", Status::kImageTruncated, HEADER(x.total_bytes += 64)},
    {"claims fewer bytes", Status::kImageTruncated, HEADER(x.total_bytes -= 64)},
    {"header size", Status::kImageLayout, HEADER(x.header_bytes += 64)},
    {"no section", Status::kImageLayout, HEADER(x.section_count = 0)},
    {"sections too many", Status::kImageLayout, HEADER(x.section_count = 16)},
    {"sections without end", Status::kImageLayout, HEADER(x.section_count = 0xffffffff)},
    {"reserved words of the header", Status::kImageLayout, HEADER(x.reserved[2] = 1)},
    {"section id 0", Status::kImageLayout, SECTION(kGrid, x.id = static_cast<SectionId>(0))},
    {"section id 16", Status::kImageLayout, SECTION(kGrid, x.id = static_cast<SectionId>(16))},
    {"section twice", Status::kImageLayout, SECTION(kGrid, x.id = SectionId::kSettings)},
    {"reserved word of a section", Status::kImageLayout, SECTION(kGrid, x.reserved = 1)},
    {"hole", Status::kImageLayout, SECTION(kBricks, x.offset += 64)},
    {"overlap", Status::kImageLayout, SECTION(kBricks, x.offset -= 64)},
    {"offset beyond the end", Status::kImageLayout, SECTION(kBricks, x.offset = ~0ull - 63)},
    {"size beyond the end", Status::kImageLayout, SECTION(kNodes, x.bytes = 1u << 20)},
    {"size that overflows", Status::kImageLayout, SECTION(kNodes, x.bytes = ~0ull)},
    {"checksum of a section", Status::kImageChecksum, SECTION(kNodes, x.checksum ^= 1)},
    {"no settings", Status::kImageLayout, leave_out<SectionId::kSettings>},
    {"no grid", Status::kImageLayout, leave_out<SectionId::kGrid>},
    {"no brick index", Status::kImageLayout, leave_out<SectionId::kBrickIndex>},
    {"no bricks", Status::kImageLayout, leave_out<SectionId::kBricks>},
    {"no body", Status::kImageLayout, leave_out<SectionId::kBody>},
    {"no points", Status::kImageLayout, leave_out<SectionId::kPoints>},
    {"no normals for paper", Status::kImageLayout, leave_out<SectionId::kNormals>},
    {"no nodes", Status::kImageLayout, leave_out<SectionId::kNodes>},
    {"short settings", Status::kImageLayout, SECTION(kSettings, x.bytes -= 8)},
    {"short workspace", Status::kImageLayout, SECTION(kWorkspace, x.bytes -= 8)},
    {"short points", Status::kImageLayout, SECTION(kPoints, x.bytes -= 4)},
    {"short normals", Status::kImageLayout, SECTION(kNormals, x.bytes -= 4)},
    {"brick count", Status::kImageLayout, GRID(x.brick_count += 1)},
    {"brick positions", Status::kImageLayout, GRID(x.bricks[0] += 1)},
    {"point count", Status::kImageLayout, BODY(x.point_count += 1)},
    {"node count", Status::kImageLayout, BODY(x.node_count -= 1)},
};
INSTANTIATE_TEST_SUITE_P(Layout, SceneRefuses, ::testing::ValuesIn(kLayouts));

constexpr Spoiled kNumbers[] = {
    {"unknown solver", Status::kImageValue, SETTINGS(x.default_solver = format::kSolverCount)},
    {"default solver not held", Status::kImageValue, SETTINGS(x.solvers = 1)},
    {"solver bits", Status::kImageValue, SETTINGS(x.solvers |= 1u << format::kSolverCount)},
    {"friction flag", Status::kImageValue, SETTINGS(x.friction = 2)},
    {"no stiffness", Status::kImageValue, SETTINGS(x.stiffness = 0.0)},
    {"infinite stiffness", Status::kImageValue, SETTINGS(x.stiffness = kInfinity)},
    {"negative damping", Status::kImageValue, SETTINGS(x.damping = -1.0)},
    {"kinetic over static", Status::kImageValue, SETTINGS(x.friction_kinetic = x.friction_static + 0.1)},
    {"negative kinetic", Status::kImageValue, SETTINGS(x.friction_kinetic = -0.1)},
    {"workspace inside out", Status::kImageValue, WORKSPACE(x.low[1] = x.high[1] + 1e-9)},
    {"workspace without end", Status::kImageValue, WORKSPACE(x.high[2] = 1e8)},
    {"no voxel", Status::kImageValue, GRID(x.voxel_size = 0.0)},
    {"negative voxel", Status::kImageValue, GRID(x.voxel_size = -0.01)},
    {"band under a voxel", Status::kImageValue, GRID(x.band = 0.5 * x.voxel_size)},
    {"band without end", Status::kImageValue, GRID(x.band = 1e7)},
    {"band below the safety distance", Status::kImageValue, SETTINGS(x.safety_distance = 0.1)},
    {"no brick position", Status::kImageValue, GRID(x.bricks[1] = 0)},
    {"negative brick positions", Status::kImageValue, GRID(x.bricks[1] = -2)},
    {"brick positions too many", Status::kImageValue, GRID(x.bricks[2] = format::kMaxBricksPerAxis + 1)},
    {"surface before the grid", Status::kImageValue, GRID(x.surface_min[0] = x.origin[0] - 1.0)},
    {"surface behind the grid", Status::kImageValue, GRID(x.surface_max[0] = 10.0)},
    {"surface inside out", Status::kImageValue, GRID(x.surface_max[0] = x.surface_min[0] - 1e-3)},
    {"steep field", Status::kImageValue, GRID(x.lipschitz = 4.6; x.lipschitz_seam = 4.6)},
    {"seams flatter than the rest", Status::kImageValue, GRID(x.lipschitz_seam = 0.5 * x.lipschitz)},
    {"brick number", Status::kImageValue, ITEM(std::uint32_t, kBrickIndex, 3, x = 8)},
    {"clearance NaN", Status::kImageValue, ITEM(std::uint32_t, kBrickIndex, 3, x = 0xbfffffff)},
    {"no unit of distances", Status::kImageValue, GRID(x.quantum = 0.0)},
    {"unit of distances NaN", Status::kImageValue, GRID(x.quantum = std::numeric_limits<double>::quiet_NaN())},
    {"unit of distances of a voxel", Status::kImageValue, GRID(x.quantum = x.voxel_size)},
    {"slope of clearances under one", Status::kImageValue, GRID(x.clearance_slope = 0.999)},
    {"loss outside below zero", Status::kImageValue, GRID(x.outside_loss = -1e-9)},
    {"rotation not unit", Status::kImageValue, BODY(x.rotation_MB[0] = 0.51)},
    {"inertia not ascending", Status::kImageValue, BODY(x.inertia[0] = 2.0 * x.inertia[1])},
    {"inertia negative", Status::kImageValue, BODY(x.inertia[0] = -1e-9)},
    {"no radius", Status::kImageValue, BODY(x.radius = 0.0)},
    {"no point", Status::kImageValue, BODY(x.point_count = 0)},
    {"points without end", Status::kImageValue, BODY(x.point_count = format::kMaxPoints + 1)},
    {"no node", Status::kImageValue, BODY(x.node_count = 0)},
    {"no level", Status::kImageValue, BODY(x.level_count = 0)},
    {"levels too many", Status::kImageValue, BODY(x.level_count = format::kMaxLevels + 1)},
    {"point outside R_max", Status::kImageValue, BODY(x.radius *= 0.999)},
    {"sphere without radius", Status::kImageValue, BODY(x.sphere_radius = 0.0)},
    {"sphere nowhere", Status::kImageValue, BODY(x.sphere_center[1] = std::numeric_limits<double>::quiet_NaN())},
    {"point outside the sphere", Status::kImageValue, BODY(x.sphere_center[0] += 0.1 * x.sphere_radius)},
    {"point NaN", Status::kImageValue, ITEM(float, kPoints, 7, x = std::numeric_limits<float>::quiet_NaN())},
    {"point outside its sphere", Status::kImageValue, ITEM(float, kPoints, 7, x = -1.5f * x + 0.005f)},
    {"normal NaN", Status::kImageValue, ITEM(float, kNormals, 7, x = std::numeric_limits<float>::quiet_NaN())},
    {"normal not unit", Status::kImageValue, ITEM(float, kNormals, 7, x += 1.5f)},
};
INSTANTIATE_TEST_SUITE_P(Number, SceneRefuses, ::testing::ValuesIn(kNumbers));

// Nodes in pre-order: 0 root, 1 and 4 its children, 2, 3 and 5, 6 the leaves.
constexpr Spoiled kTrees[] = {
    {"a subtree that ends where it begins", Status::kImageValue, NODE(2, x.skip = 2)},
    {"a cycle back to the root", Status::kImageValue, NODE(3, x.skip = 0)},
    {"a subtree longer than its parent's", Status::kImageValue, NODE(3, x.skip = 5)},
    {"a skip beyond the end", Status::kImageValue, NODE(6, x.skip = 8)},
    {"a root that ends early: a second root", Status::kImageValue, NODE(0, x.skip = 4)},
    {"a root without all points", Status::kImageValue, NODE(0, x.point_count -= 1)},
    {"a root that starts late", Status::kImageValue, NODE(0, x.first_point = 1)},
    {"siblings that overlap", Status::kImageValue, NODE(4, x.first_point -= 1; x.point_count += 1)},
    {"siblings with a gap", Status::kImageValue, NODE(4, x.first_point += 1; x.point_count -= 1)},
    {"a last child that ends early", Status::kImageValue, NODE(6, x.point_count -= 1)},
    {"a child with more points than its parent", Status::kImageValue, NODE(5, x.point_count += 1000)},
    {"points that overflow", Status::kImageValue, NODE(5, x.point_count = 0xffffffff)},
    {"a node without points", Status::kImageValue, NODE(5, x.point_count = 0)},
    {"a wrong level", Status::kImageValue, NODE(5, x.level = 1)},
    {"more levels than announced", Status::kImageValue, BODY(x.level_count = 2)},
    {"a leaf with children", Status::kImageValue, NODE(1, x.leaf = 1)},
    {"an inner node without children", Status::kImageValue, NODE(2, x.leaf = 0)},
    {"a leaf flag of two", Status::kImageValue, NODE(2, x.leaf = 2)},
    {"a sphere that shrank", Status::kImageValue, NODE(2, x.radius *= 0.99f)},
    {"a sphere that moved", Status::kImageValue, NODE(0, x.center[1] += 1e-4f)},
    {"a radius NaN", Status::kImageValue, NODE(4, x.radius = std::numeric_limits<float>::quiet_NaN())},
    {"a radius below zero", Status::kImageValue, NODE(4, x.radius = -x.radius)},
    {"a centre NaN", Status::kImageValue, NODE(4, x.center[2] = std::numeric_limits<float>::quiet_NaN())},
};
INSTANTIATE_TEST_SUITE_P(Tree, SceneRefuses, ::testing::ValuesIn(kTrees));

class SceneRefusesRefinements : public ::testing::TestWithParam<Spoiled> {};

TEST_P(SceneRefusesRefinements, EvenWithRightChecksums) {
  SceneImage image = refined_image();
  EXPECT_EQ(open_over_another(image.bytes()), Status::kOk);
  GetParam().spoil(image);
  EXPECT_EQ(describe(open_over_another(image.bytes())), std::string(describe(GetParam().status)));
}

#define REFINED(N, CHANGE) ITEM(format::Refined, kRefined, N, CHANGE)
constexpr std::uint32_t kToRefined = format::index_entry::kRefined;

constexpr Spoiled kRefinements[] = {
    {"a section cut short", Status::kImageLayout, SECTION(kRefined, x.bytes -= 4)},
    {"no refinements", Status::kImageValue, SECTION(kRefined, x.id = static_cast<SectionId>(20))},
    {"a brick number of its own nodes", Status::kImageValue, REFINED(0, x.brick = 1000)},
    {"a position without nodes of its own", Status::kImageValue, REFINED(0, x.brick = format::kNoBrick)},
    {"an octant's own nodes that none reads", Status::kImageValue, REFINED(1, x.brick = 1)},
    {"a coarse octant without own nodes", Status::kImageValue, REFINED(1, x.child[7] = format::index_entry::kCoarse)},
    {"a coarse octant with a clearance", Status::kImageValue, REFINED(2, x.child[0] |= 1u)},
    {"a coarse octant that is inside", Status::kImageValue, REFINED(2, x.child[0] |= format::index_entry::kInside)},
    {"a brick number of an octant", Status::kImageValue, REFINED(2, x.child[7] = 1000)},
    {"a refinement's number of an octant", Status::kImageValue, REFINED(2, x.child[7] = kToRefined | 3u)},
    {"an octant that is not stored", Status::kImageValue, REFINED(2, x.child[1] |= format::index_entry::kFar)},
    {"an octant with an unknown bit", Status::kImageValue, REFINED(0, x.child[0] |= format::index_entry::kInside)},
    {"a refinement of itself", Status::kImageValue, REFINED(0, x.child[7] = kToRefined)},
    {"a cycle of two", Status::kImageValue, REFINED(1, x.child[3] = kToRefined)},
    {"a refinement shared by two octants", Status::kImageValue, REFINED(0, x.child[6] = kToRefined | 1u)},
    {"a refinement that none leads to", Status::kImageValue, REFINED(0, x.child[7] = 1)},
    {"the second position before the first", Status::kImageValue,
     [](SceneImage& i) {
       auto* index = &section_item<std::uint32_t>(i, SectionId::kBrickIndex);
       std::swap(index[0], index[1]);
       test::seal(i);
     }},
};
INSTANTIATE_TEST_SUITE_P(Refinement, SceneRefusesRefinements, ::testing::ValuesIn(kRefinements));

class SceneRefusesFacets : public ::testing::TestWithParam<Spoiled> {};

TEST_P(SceneRefusesFacets, EvenWithRightChecksums) {
  SceneImage image = refined_image(test::facet_along_z());
  EXPECT_EQ(open_over_another(image.bytes()), Status::kOk);
  GetParam().spoil(image);
  EXPECT_EQ(describe(open_over_another(image.bytes())), std::string(describe(GetParam().status)));
}

#define FACET(CHANGE) ITEM(format::Facet, kFacets, 0, CHANGE)
#define EXACT(CHANGE) ITEM(format::ExactBrick, kExactBricks, 0, CHANGE)

constexpr Spoiled kFacets[] = {
    {"a section of facets cut short", Status::kImageLayout, SECTION(kFacets, x.bytes -= 8)},
    {"a section of exact bricks cut short", Status::kImageLayout, SECTION(kExactBricks, x.bytes -= 8)},
    {"no facets", Status::kImageValue, SECTION(kFacets, x.id = static_cast<SectionId>(22))},
    {"no exact bricks", Status::kImageValue, SECTION(kExactBricks, x.id = static_cast<SectionId>(31))},
    {"no sets of facets", Status::kImageValue, SECTION(kFacetSets, x.id = static_cast<SectionId>(31))},
    {"no numbers of facets", Status::kImageValue, SECTION(kFacetNumbers, x.id = static_cast<SectionId>(31))},
    {"a brick that names one too many", Status::kImageValue, BRICK(x.exact = 2)},
    {"a brick whose entry does not know", Status::kImageValue,
     ITEM(std::uint32_t, kBrickIndex, 2, x &= ~format::index_entry::kExact)},
    {"an entry whose brick does not know", Status::kImageValue, ITEM(format::Brick, kBricks, 2, x.exact = 0)},
    {"a vertex NaN", Status::kImageValue, FACET(x.vertex[2][1] = std::numeric_limits<double>::quiet_NaN())},
    {"a normal that is not unit", Status::kImageValue, FACET(x.plane[2][0] = 1.1)},
    {"a normal NaN", Status::kImageValue, FACET(x.plane[0][0] = std::numeric_limits<double>::quiet_NaN())},
    {"an edge's plane NaN", Status::kImageValue, FACET(x.plane[3][3] = std::numeric_limits<double>::quiet_NaN())},
    {"an edge's normal that is not unit", Status::kImageValue, FACET(x.edge_normal[2][2] = 0.9f)},
    {"a vertex's normal that is not unit", Status::kImageValue, FACET(x.vertex_normal[0][1] = 0.9f)},
    {"a facet that is not there", Status::kImageValue, ITEM(std::uint32_t, kFacetNumbers, 0, x = 1)},
    {"a set without facets", Status::kImageValue, ITEM(format::FacetSet, kFacetSets, 0, x.count = 0)},
    {"a set with too many numbers", Status::kImageValue, ITEM(format::FacetSet, kFacetSets, 0, x.count = 2)},
    {"a first part that is longer than its set", Status::kImageValue,
     ITEM(format::FacetSet, kFacetSets, 0, x.plane_count = 2)},
    {"a cell without a set", Status::kImageValue, EXACT(x.cell[63] = 0)},
    {"a cell with a set that is not there", Status::kImageValue, EXACT(x.cell[0] = 2)},
    {"a cell that is not whole", Status::kImageValue, EXACT(x.cell[0] |= format::cell_facets::kWhole)},
    {"a weight above 1", Status::kImageValue, EXACT(x.weight[124] = 40000)},
    {"reserved words", Status::kImageValue, EXACT(x.reserved[2] = 1)},
};
INSTANTIATE_TEST_SUITE_P(Facet, SceneRefusesFacets, ::testing::ValuesIn(kFacets));

/// Returns a scene that halves the first position's first octant again and again, `depth` times in all, and also the
/// position beside it. `last_coarse`: the last octant of each refinement is coarse.
SceneImage chain_image(int depth, bool last_coarse) {
  test::SceneDescription description;
  description.distance = [](const Vector3& p) { return test::ball_distance(p, 0.01); };
  description.surface_min = Vector3::Constant(-0.01);
  description.surface_max = Vector3::Constant(0.05);  // large enough that some positions are far
  description.voxel_size = 0.01;
  description.points = {Vector3(0.01, 0.0, 0.0)};
  const Vector3 low = description.surface_min - Vector3::Constant(0.05);  // band of four voxels, plus one voxel
  description.refined = [depth, low](const Vector3& center, double edge) {
    if (edge > 0.03 && (center - low - 0.04 * Vector3::UnitX()).cwiseAbs().maxCoeff() < 0.51 * edge) return true;
    return edge > 0.045 * std::exp2(-depth) && (center - low).cwiseAbs().maxCoeff() < 0.51 * edge;
  };
  description.coarse = [low, last_coarse](const Vector3& center, double edge) {
    return last_coarse && (center - low - Vector3::Constant(1.5 * edge)).cwiseAbs().maxCoeff() < 0.01 * edge;
  };
  return test::build_scene_image(description);
}

TEST(Scene, TakesRefinementsOfRefinements) {
  for (int depth = 1; depth <= format::kMaxRefinement; ++depth) {
    for (const bool last_coarse : {false, true}) {
      SceneImage image = chain_image(depth, last_coarse);
      EXPECT_EQ(open_over_another(image.bytes()), Status::kOk) << depth;
      const auto refined = static_cast<std::size_t>(depth) + 1;
      ASSERT_EQ(test::section_bytes(image, SectionId::kRefined).size(), refined * sizeof(format::Refined));
      const std::uint32_t own = section_item<format::Refined>(image, SectionId::kRefined, refined - 2).brick;
      EXPECT_EQ(own == format::kNoBrick, depth > 1 && !last_coarse);
    }
  }
}

TEST(Scene, RefusesRefinementsTooDeep) {
  SceneImage image = chain_image(format::kMaxRefinement, false);
  auto* index = &section_item<std::uint32_t>(image, SectionId::kBrickIndex);
  auto* refined = &section_item<format::Refined>(image, SectionId::kRefined);
  // the fifth becomes an octant of the fourth, and each brick keeps a reference
  std::uint32_t* far = index;
  while ((*far & format::index_entry::kFar) == 0) ++far;
  *far = refined[3].child[7];
  index[1] = std::exchange(refined[4].brick, format::kNoBrick);
  refined[3].child[7] = kToRefined | 4u;
  test::seal(image);
  EXPECT_EQ(open_over_another(image.bytes()), Status::kImageValue);
  // as an octant of the third it is not too deep
  refined[3].child[7] = *far;
  *far = refined[2].child[7];
  refined[2].child[7] = kToRefined | 4u;
  test::seal(image);
  EXPECT_EQ(open_over_another(image.bytes()), Status::kOk);
}

/// An image with a flipped bit and a correct checksum may open or not; if it opens, it must be safe. Sanitizers judge.
TEST(Scene, SurvivesEverySingleBitFlipInRefinements) {
  SceneImage image = refined_image(test::facet_along_z());
  const auto bytes = test::section_bytes(image, SectionId::kRefined);
  for (std::size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    const std::byte mask{static_cast<unsigned char>(1u << (bit % 8))};
    bytes[bit / 8] ^= mask;
    test::seal(image);
    SceneView scene;
    if (SceneView::open(image.bytes(), scene) == Status::kOk) {
      for (int corner = 0; corner < 64; ++corner) {
        const Vector3 p = 0.019 * (Vector3(corner & 3, corner >> 2 & 3, corner >> 4) - Vector3::Constant(1.5));
        ASSERT_FALSE(std::isnan(scene.voxelmap.sample(p).distance)) << "bit " << bit;
        ASSERT_FALSE(std::isnan(scene.voxelmap.lower_bound(p, 0.001))) << "bit " << bit;
      }
    }
    bytes[bit / 8] ^= mask;
  }
}

/// Sets every double from `first` on to each bad value, one at a time, and expects a refusal.
template <class T, SectionId kId>
void expect_each_double_is_checked(std::size_t first, std::size_t count) {
  for (const double value : {kNaN, kInfinity, -kInfinity}) {
    for (std::size_t i = 0; i < count; ++i) {
      SceneImage image = small_image();
      std::memcpy(test::section_bytes(image, kId).data() + first + i * sizeof(double), &value, sizeof(double));
      test::seal(image);
      EXPECT_EQ(open_over_another(image.bytes()), Status::kImageValue) << "double " << i << " = " << value;
    }
  }
}

TEST(Scene, RefusesWhatIsNotFinite) {
  constexpr std::size_t kSettingsFirst = offsetof(format::Settings, safety_distance);
  expect_each_double_is_checked<format::Settings, SectionId::kSettings>(
      kSettingsFirst, (sizeof(format::Settings) - kSettingsFirst) / sizeof(double));
  expect_each_double_is_checked<format::Workspace, SectionId::kWorkspace>(0,
                                                                          sizeof(format::Workspace) / sizeof(double));
  expect_each_double_is_checked<format::Grid, SectionId::kGrid>(0, offsetof(format::Grid, bricks) / sizeof(double));
  expect_each_double_is_checked<format::Body, SectionId::kBody>(
      0, offsetof(format::Body, inertia_from_points) / sizeof(double));
}

}  // namespace
}  // namespace godobject
