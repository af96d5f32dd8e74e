// Every number of a scene image at its limits: accepted there, refused one step beyond.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

#include "core/scene/scene_view.h"
#include "tests/support/image_parts.h"
#include "tests/support/whole_image.h"

namespace godobject {

/// Prints a status in messages of GoogleTest.
inline void PrintTo(Status status, std::ostream* out) { *out << describe(status); }

namespace {

using format::SectionId;
using test::ImageParts;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLargest = 1e9;   // of gains and lengths of the settings
constexpr double kFarthest = 1e7;  // of coordinates [m]

/// The bodies as one point each, at their origins: then no sphere and no radius is too small. Every double of the
/// settings is 0 or in the middle of its range.
ImageParts point_image() {
  ImageParts image = test::whole_image({{Vector3::Zero()}, {Vector3::UnitX()}});
  image.item<format::Body>(SectionId::kBody).radius = 0.01;
  image.item<format::Features>(SectionId::kFeatures).radius = 0.01;
  return image;
}

/// The structures of an image that limits refer to.
struct Structures {
  explicit Structures(ImageParts& image, bool of_body = false)
      : settings(image.item<format::Settings>(SectionId::kSettings)),
        body(image.item<format::Body>(SectionId::kBody)),
        workspace(image.item<format::Workspace>(SectionId::kWorkspace)),
        features(image.item<format::Features>(SectionId::kFeatures)),
        grid(image.item<format::Grid>(of_body ? SectionId::kBodyGrid : SectionId::kGrid)),
        facet(image.item<format::Facet>(of_body ? SectionId::kBodyFacets : SectionId::kFacets)),
        exact(image.item<format::ExactBrick>(of_body ? SectionId::kBodyExactBricks : SectionId::kExactBricks)),
        node(image.item<format::Node>(of_body ? SectionId::kFeatureNodes : SectionId::kNodes)) {}

  /// Shrinks the surface's box to a point and the safety distance to its least, so that they fit into any grid.
  void shrink() {
    settings.safety_distance = 1e-12;
    for (int axis = 0; axis < 3; ++axis) grid.surface_min[axis] = grid.surface_max[axis] = grid.origin[axis];
  }
  /// Makes the grid so large that it holds every accepted length of the settings.
  void grow() {
    grid.voxel_size = 1e6;
    grid.band = 1e12;
  }

  format::Settings& settings;
  format::Body& body;
  format::Workspace& workspace;
  format::Features& features;
  format::Grid& grid;
  format::Facet& facet;
  format::ExactBrick& exact;
  format::Node& node;
};

/// A number with its range.
struct Limits {
  std::string name;
  std::function<void(Structures& s, double value)> set;
  double low, high;
};

#define LIMITS(LOW, HIGH, SET)                              \
  Limits {                                                  \
#SET, [=](Structures & s, double v) { SET; }, LOW, HIGH \
  }

Status status_of(const ImageParts& image) {
  const test::SceneImage bytes = image.assemble();
  SceneView scene;
  return SceneView::open(bytes.bytes(), scene);
}

void expect_limits(const ImageParts& valid, const std::vector<Limits>& table, bool of_body = false) {
  ASSERT_EQ(status_of(valid), Status::kOk);
  const auto status_at = [&](const Limits& limits, double value) {
    ImageParts image = valid;
    Structures structures(image, of_body);
    limits.set(structures, value);
    return status_of(image);
  };
  for (const Limits& limits : table) {
    SCOPED_TRACE(limits.name);
    EXPECT_EQ(status_at(limits, limits.low), Status::kOk) << "at " << limits.low;
    EXPECT_EQ(status_at(limits, limits.high), Status::kOk) << "at " << limits.high;
    EXPECT_EQ(status_at(limits, std::nextafter(limits.low, -kInfinity)), Status::kImageValue) << "below " << limits.low;
    EXPECT_EQ(status_at(limits, std::nextafter(limits.high, kInfinity)), Status::kImageValue)
        << "above " << limits.high;
    for (const double value : {kNaN, kInfinity, -kInfinity})
      EXPECT_EQ(status_at(limits, value), Status::kImageValue) << value;
  }
}

TEST(SceneLimits, OfTheSettingsHoldToTheLastBit) {
  expect_limits(point_image(), {
    LIMITS(1e-12, kLargest, s.grow(); s.settings.safety_distance = v), LIMITS(1e-12, kLargest, s.settings.margin = v),
        LIMITS(1e-12, kLargest, s.settings.stiffness = v), LIMITS(0.0, kLargest, s.settings.damping = v),
        LIMITS(1e-12, kLargest, s.settings.coupling_translation = v),
        LIMITS(1e-18, kLargest, s.settings.coupling_rotation = v), LIMITS(0.0, 10.0, s.settings.friction_static = v),
        LIMITS(0.0, 3.0, s.settings.friction_static = 3.0; s.settings.friction_kinetic = v),
        LIMITS(0.25, 10.0, s.settings.friction_kinetic = 0.25; s.settings.friction_static = v),
        LIMITS(0.0, kLargest, s.settings.friction_viscous = v), LIMITS(1.25e-4, 1e-2, s.settings.period = v),
        LIMITS(0.0, 10.0, s.settings.paper_rotation_static = v),
        LIMITS(0.0, 3.0, s.settings.paper_rotation_static = 3.0; s.settings.paper_rotation_kinetic = v),
        LIMITS(0.25, 10.0, s.settings.paper_rotation_kinetic = 0.25; s.settings.paper_rotation_static = v),
        LIMITS(0.0, 10.0, s.settings.paper_viscous = v),
  });
}

/// Contacts begin at the safety distance: there the field must be known.
TEST(SceneLimits, OfTheSafetyDistanceIsTheBand) {
  expect_limits(point_image(), { LIMITS(1e-12, 0.0125, s.grid.band = 0.0125; s.settings.safety_distance = v) });
}

std::vector<Limits> grid_limits() {
  const double steepest = 2.0 + 2.0 * 8.0 * 0.01 * 16.0;  // a brick's slope and the rounding of the coarsest nodes
  std::vector<Limits> table = {
    LIMITS(1e-9, 1e6, s.shrink(); s.grid.voxel_size = v; s.grid.band = 2.0 * v;
           s.grid.quantum = std::min(1e-3, 1e-2 * v)),
    LIMITS(0.03125, 0.03125 * 1e6, s.settings.safety_distance = 1e-3; s.grid.voxel_size = 0.03125; s.grid.band = v),
    LIMITS(0.0, steepest, s.grid.lipschitz_seam = 1e6; s.grid.lipschitz = v),
    LIMITS(0.75, 1e6, s.grid.lipschitz = 0.75; s.grid.lipschitz_seam = v),
    LIMITS(1.0, 1e6, s.grid.clearance_slope = v),
    LIMITS(0.0, kFarthest, s.grid.outside_loss = v),
    LIMITS(-kFarthest, kFarthest, s.grid.facet_offset = v),
    LIMITS(1e-15, 0.03125 * 1e-2, s.grid.voxel_size = 0.03125; s.grid.band = 1.0; s.grid.quantum = v),
  };
  for (int axis = 0; axis < 3; ++axis) {
    const double low = -0.25;
    const double edge = 1.0;  // of a brick: four voxels of 1/4 m
    table.push_back(LIMITS(-kFarthest, kFarthest, s.grid.origin[axis] = v; s.shrink()));
    table.push_back(LIMITS(low, 0.5, s.shrink(); s.grid.voxel_size = 0.25; s.grid.band = 0.25;
                           s.grid.origin[axis] = low; s.grid.surface_max[axis] = 0.5; s.grid.surface_min[axis] = v));
    table.push_back(LIMITS(-0.125, low + 2.0 * edge, s.shrink(); s.grid.voxel_size = 0.25; s.grid.band = 0.25;
                           s.grid.origin[axis] = low; s.grid.surface_min[axis] = -0.125; s.grid.surface_max[axis] = v));
  }
  return table;
}

TEST(SceneLimits, OfTheGridHoldToTheLastBit) {
  const ImageParts image = point_image();
  expect_limits(image, grid_limits());
  expect_limits(image, grid_limits(), true);
}

TEST(SceneLimits, OfAFacetHoldToTheLastBit) {
  std::vector<Limits> table;
  for (int k = 0; k < 3; ++k) {
    for (int axis = 0; axis < 3; ++axis) table.push_back(LIMITS(-1e7, 1e7, s.facet.vertex[k][axis] = v));
  }
  const ImageParts image = point_image();
  expect_limits(image, table);
  expect_limits(image, table, true);
}

TEST(SceneLimits, OfTheBodyHoldToTheLastBit) {
  std::vector<Limits> table = {
    LIMITS(0.0, 2.0, s.body.inertia[1] = 2.0; s.body.inertia[2] = 3.0; s.body.inertia[0] = v),
    LIMITS(1.0, 3.0, s.body.inertia[0] = 1.0; s.body.inertia[2] = 3.0; s.body.inertia[1] = v),
    LIMITS(2.0, 1e12, s.body.inertia[0] = 1.0; s.body.inertia[1] = 2.0; s.body.inertia[2] = v),
    LIMITS(0.0, 1e12, std::fill_n(s.body.inertia, 3, v)),
    LIMITS(0.0, 1e12, s.body.inertia[1] = s.body.inertia[2] = 1e12; s.body.inertia[0] = v),
    LIMITS(1e-12, 1e6, s.body.radius = v),
    LIMITS(1e-12, 1e6, s.body.sphere_radius = v),
    LIMITS(0.0, 1e18, s.body.volume = v),
  };
  for (int axis = 0; axis < 3; ++axis) {
    table.push_back(LIMITS(-kFarthest, kFarthest, s.body.translation_MB[axis] = v));
    table.push_back(LIMITS(-1e6, 1e6, s.body.sphere_radius = 1e6; s.body.sphere_center[axis] = v));
  }
  expect_limits(point_image(), table);
}

/// The sphere's centre has a limit of its own, also where the points are far enough for it.
TEST(SceneLimits, OfTheSpheresCentreHoldWhereverThePointsAre) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double end : {-1e6, 1e6}) {
      ImageParts image = point_image();
      Structures s(image);
      image.item<float>(SectionId::kPoints, static_cast<std::size_t>(axis)) = static_cast<float>(end);
      s.node.center[axis] = static_cast<float>(end);
      s.body.radius = s.body.sphere_radius = 1e6;
      s.body.sphere_center[axis] = end;
      EXPECT_EQ(status_of(image), Status::kOk) << axis;
      s.body.sphere_center[axis] = std::nextafter(end, 2.0 * end);
      EXPECT_EQ(status_of(image), Status::kImageValue) << axis;
    }
  }
}

TEST(SceneLimits, OfWorkspaceAndFeaturesHoldToTheLastBit) {
  std::vector<Limits> table = {LIMITS(1e-12, 1e6, s.features.radius = v)};
  for (int axis = 0; axis < 3; ++axis) {
    table.push_back(LIMITS(-kFarthest, 0.5, s.workspace.high[axis] = 0.5; s.workspace.low[axis] = v));
    table.push_back(LIMITS(-kFarthest, kFarthest, s.workspace.high[axis] = kFarthest; s.workspace.low[axis] = v));
    table.push_back(LIMITS(-0.5, kFarthest, s.workspace.low[axis] = -0.5; s.workspace.high[axis] = v));
    table.push_back(LIMITS(-kFarthest, kFarthest, s.features.origin[axis] = v));
  }
  expect_limits(point_image(), table);
}

/// Returns the value one step of single precision beyond `limit`, away from 0.
float beyond(float limit) { return std::nextafter(limit, limit < 0.0f ? -HUGE_VALF : HUGE_VALF); }

TEST(SceneLimits, OfANodesSphereHoldToTheLastBit) {
  const ImageParts valid = point_image();
  const auto status_at = [&valid](bool of_body, auto set) {
    ImageParts image = valid;
    set(Structures(image, of_body).node);
    return status_of(image);
  };
  for (const bool of_body : {false, true}) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto at = [&](float center) {
        return status_at(of_body, [=](format::Node& node) { node.radius = 1e7f, node.center[axis] = center; });
      };
      for (const float end : {-1e7f, 1e7f}) {
        EXPECT_EQ(at(end), Status::kOk) << axis;
        EXPECT_EQ(at(beyond(end)), Status::kImageValue) << axis;
      }
      EXPECT_EQ(at(std::numeric_limits<float>::quiet_NaN()), Status::kImageValue) << axis;
    }
    const auto at = [&](float radius) { return status_at(of_body, [=](format::Node& node) { node.radius = radius; }); };
    EXPECT_EQ(at(0.0f), Status::kOk);
    EXPECT_EQ(at(1e7f), Status::kOk);
    EXPECT_EQ(at(beyond(1e7f)), Status::kImageValue);
    EXPECT_EQ(at(-1e-30f), Status::kImageValue);
    EXPECT_EQ(at(std::numeric_limits<float>::quiet_NaN()), Status::kImageValue);
  }
}

/// Of the still body: an edge of the moving body must lie in its sphere, too, which is smaller.
TEST(SceneLimits, OfASharpEdgeHoldToTheLastBit) {
  const ImageParts valid = point_image();
  const auto status_at = [&valid](auto set) {
    ImageParts image = valid;
    auto& edge = image.item<format::SharpEdge>(SectionId::kSharpEdges);
    auto& node = image.item<format::Node>(SectionId::kSharpEdgeNodes);
    node.radius = 1e7f;
    set(edge, node);
    return status_of(image);
  };
  using Edge = format::SharpEdge;
  using Node = format::Node;
  for (int end = 0; end < 2; ++end) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const double limit : {-kFarthest, kFarthest}) {
        const auto at = [&](double x) {
          return status_at([=](Edge& edge, Node& node) {
            edge.end[end][axis] = x;
            node.center[axis] = static_cast<float>(0.5 * limit);  // the other end stays at the origin
          });
        };
        EXPECT_EQ(at(limit), Status::kOk) << end << ' ' << axis;
        EXPECT_EQ(at(std::nextafter(limit, 2.0 * limit)), Status::kImageValue) << end << ' ' << axis;
      }
      for (const float limit : {-1.001f, 1.001f}) {
        const auto at = [&](float x) { return status_at([=](Edge& edge, Node&) { edge.normal[end][axis] = x; }); };
        EXPECT_EQ(at(limit), Status::kOk) << end << ' ' << axis;
        EXPECT_EQ(at(beyond(limit)), Status::kImageValue) << end << ' ' << axis;
      }
    }
  }
  const auto at = [&](float radius) { return status_at([=](Edge& edge, Node&) { edge.radius = radius; }); };
  EXPECT_EQ(at(0.0f), Status::kOk);
  EXPECT_EQ(at(1e6f), Status::kOk);
  EXPECT_EQ(at(beyond(1e6f)), Status::kImageValue);
}

/// A count at its limit passes the check of values. Then the sections do not have the size that it says.
TEST(SceneLimits, OfCountsComeBeforeTheSizesOfSections) {
  const ImageParts valid = point_image();
  const auto status_with = [&valid](auto set, bool of_body = false) {
    ImageParts image = valid;
    Structures structures(image, of_body);
    set(structures);
    return status_of(image);
  };
  for (const bool of_body : {false, true}) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto bricks = [&](std::int32_t count) {
        return status_with([=](Structures& s) { s.shrink(), s.grid.bricks[axis] = count; }, of_body);
      };
      EXPECT_EQ(bricks(-1), Status::kImageValue);
      EXPECT_EQ(bricks(0), Status::kImageValue);
      EXPECT_EQ(bricks(1), Status::kImageLayout);
      EXPECT_EQ(bricks(2), Status::kOk);
      EXPECT_EQ(bricks(3), Status::kImageLayout);
      EXPECT_EQ(bricks(4096), Status::kImageLayout);
      EXPECT_EQ(bricks(4097), Status::kImageValue);
    }
  }
  const auto expect_tree = [&](std::uint32_t points, std::uint32_t nodes, std::uint32_t levels, Status expected) {
    const auto set = [=](auto& tree) {
      tree.point_count = points;
      tree.node_count = nodes;
      tree.level_count = levels;
    };
    SCOPED_TRACE(std::to_string(points) + " points, " + std::to_string(nodes) + " nodes, " + std::to_string(levels));
    EXPECT_EQ(status_with([&](Structures& s) { set(s.body); }), expected);
    EXPECT_EQ(status_with([&](Structures& s) { set(s.features); }), expected);
  };
  expect_tree(1, 1, 1, Status::kOk);
  expect_tree(1, 1, 16, Status::kOk);
  expect_tree(1, 1, 17, Status::kImageValue);
  expect_tree(1, 1, 0, Status::kImageValue);
  expect_tree(1, 0, 1, Status::kImageValue);
  expect_tree(0, 0, 1, Status::kImageValue);
  expect_tree(0, 1, 1, Status::kImageValue);
  expect_tree(1, 2, 1, Status::kImageLayout);
  expect_tree(1, 3, 1, Status::kImageValue);
  expect_tree(2, 1, 1, Status::kImageLayout);
  expect_tree(2, 1, 0, Status::kImageValue);
  expect_tree(2, 4, 1, Status::kImageLayout);
  expect_tree(2, 5, 1, Status::kImageValue);
  expect_tree(4194304, 1, 1, Status::kImageLayout);
  expect_tree(4194305, 1, 1, Status::kImageValue);
}

TEST(SceneLimits, OfFlagsAndSolversAreChecked) {
  const ImageParts valid = point_image();
  const auto status_with = [&valid](auto set) {
    ImageParts image = valid;
    Structures structures(image);
    set(structures);
    return status_of(image);
  };
  for (std::uint32_t solvers = 0; solvers < 16; ++solvers) {
    for (const std::uint32_t chosen : {0u, 1u, 2u, 3u, 4u, 31u, 32u, 33u, 34u, 64u, 0xffffffffu}) {
      const bool held = chosen < 3 && (solvers >> chosen & 1) != 0;
      EXPECT_EQ(status_with([=](Structures& s) {
                  s.settings.solvers = solvers;
                  s.settings.default_solver = chosen;
                }),
                held && solvers < 8 ? Status::kOk : Status::kImageValue)
          << solvers << ", default " << chosen;
    }
  }
  for (const std::uint32_t flag : {0u, 1u, 2u, 0xffffffffu}) {
    const Status expected = flag <= 1 ? Status::kOk : Status::kImageValue;
    EXPECT_EQ(status_with([=](Structures& s) { s.settings.friction = flag; }), expected) << flag;
    EXPECT_EQ(status_with([=](Structures& s) { s.body.inertia_from_points = flag; }), expected) << flag;
  }
  EXPECT_EQ(status_with([](Structures& s) { s.features.reserved = 1; }), Status::kImageValue);
}

TEST(SceneLimits, OfTheQuaternionsLengthAreAMillionthOfItsSquare) {
  const ImageParts valid = point_image();
  for (const Quaternion& q :
       {Quaternion(1.0, 0.0, 0.0, 0.0), Quaternion(0.5, 0.5, -0.5, 0.5), Quaternion(0.0, 0.6, 0.0, 0.8)}) {
    for (const double excess : {-1.1e-6, -0.9e-6, 0.0, 0.9e-6, 1.1e-6}) {
      ImageParts image = valid;
      const double length = std::sqrt(1.0 + excess);
      const double rotation[4] = {length * q.w(), length * q.x(), length * q.y(), length * q.z()};
      std::copy_n(rotation, 4, Structures(image).body.rotation_MB);
      const test::SceneImage bytes = image.assemble();
      SceneView scene;
      const Status status = SceneView::open(bytes.bytes(), scene);
      EXPECT_EQ(status, std::fabs(excess) < 1e-6 ? Status::kOk : Status::kImageValue) << excess;
      if (status != Status::kOk) continue;
      EXPECT_TRUE(scene.has_features()) << "one point suffices";
      EXPECT_NEAR(scene.H_MB.rotation.norm(), 1.0, 1e-15) << "the view has the rotation itself";
      EXPECT_NEAR(scene.H_MB.rotation.angularDistance(q), 0.0, 1e-7);
    }
  }
}

/// Unit vectors of an edge in any direction: each component counts, and so does each pair.
TEST(SceneLimits, OfAFacetsNormalsAreTheirRounding) {
  const ImageParts valid = point_image();
  const auto status_with = [&valid](auto change) {
    ImageParts image = valid;
    Structures structures(image);
    change(structures.facet);
    return status_of(image);
  };
  for (const double off : {-1.1, -0.9, 0.9, 1.1}) {
    const Status expected = std::fabs(off) < 1.0 ? Status::kOk : Status::kImageValue;
    for (int i = 0; i < 4; ++i) {
      const auto lengthen = [=](format::Facet& f) {
        for (int axis = 0; axis < 3; ++axis) f.plane[axis][i] *= std::sqrt(1.0 + off * 1e-9);
      };
      EXPECT_EQ(status_with(lengthen), expected) << off;
    }
    const auto single = static_cast<float>(std::sqrt(1.0 + off * 1e-5));
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(status_with([=](format::Facet& f) { f.edge_normal[k][2] = single; }), expected) << off;
      EXPECT_EQ(status_with([=](format::Facet& f) { f.vertex_normal[k][2] = single; }), expected) << off;
    }
  }
  for (int i = 0; i < 4; ++i) {
    for (const double c : {2e7, -2e7}) {
      EXPECT_EQ(status_with([=](format::Facet& f) { f.plane[3][i] = c; }), Status::kOk);
      EXPECT_EQ(status_with([=](format::Facet& f) { f.plane[3][i] = c * (1.0 + 1e-12); }), Status::kImageValue);
    }
  }
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(status_with([=](format::Facet& f) { std::copy_n(f.vertex[k], 3, f.vertex[(k + 1) % 3]); }),
              Status::kImageValue)
        << "an edge without length";
  }
}

TEST(SceneLimits, OfAnExactBrickAreItsWeightsAndSets) {
  const ImageParts valid = point_image();
  const auto status_with = [&valid](auto change) {
    ImageParts image = valid;
    change(image.item<format::ExactBrick>(SectionId::kExactBricks));
    return status_of(image);
  };
  const auto weigh = [](format::ExactBrick& exact, std::uint16_t weight) {
    std::fill(std::begin(exact.weight), std::end(exact.weight), weight);
  };
  const auto fill = [](format::ExactBrick& exact, std::uint32_t word) {
    std::fill(std::begin(exact.cell), std::end(exact.cell), word);
  };
  constexpr std::uint32_t kWhole = 1u << 31;
  EXPECT_EQ(status_with([&](format::ExactBrick& e) { e.cell[5] = 0; }), Status::kImageValue) << "a cell without a set";
  EXPECT_EQ(status_with([&](format::ExactBrick& e) { e.cell[5] = 2; }), Status::kImageValue) << "one that is not there";
  EXPECT_EQ(status_with([&](format::ExactBrick& e) { e.cell[5] |= kWhole; }), Status::kImageValue);
  EXPECT_EQ(status_with([&](format::ExactBrick& e) { weigh(e, 0), fill(e, 0); }), Status::kOk);
  EXPECT_EQ(status_with([&](format::ExactBrick& e) { weigh(e, 0); }), Status::kImageValue) << "sets without weights";
  EXPECT_EQ(status_with([&](format::ExactBrick& e) { weigh(e, 0), fill(e, 0), e.cell[63] = kWhole; }),
            Status::kImageValue);
  EXPECT_EQ(status_with([&](format::ExactBrick& e) { weigh(e, 1 << 14), fill(e, kWhole | 1); }), Status::kOk);
  EXPECT_EQ(status_with([&](format::ExactBrick& e) { weigh(e, 1 << 14); }), Status::kImageValue);
  EXPECT_EQ(status_with([&](format::ExactBrick& e) { weigh(e, 1 << 14), fill(e, kWhole); }), Status::kImageValue);
  EXPECT_EQ(status_with([&](format::ExactBrick& e) { e.weight[124] = 1 << 14; }), Status::kOk);
  EXPECT_EQ(status_with([&](format::ExactBrick& e) { e.weight[124] = (1 << 14) + 1; }), Status::kImageValue);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(status_with([&](format::ExactBrick& e) { e.reserved[i] = 1; }), Status::kImageValue);
  }
}

TEST(SceneLimits, OfAFacetSetAreItsNumbers) {
  ImageParts valid = point_image();
  const format::Facet facet = Structures(valid).facet;
  valid.set<format::Facet>(SectionId::kFacets, std::vector<format::Facet>(70, facet));
  const auto status_with = [&valid](const format::FacetSet& set, const std::vector<std::uint32_t>& numbers) {
    ImageParts image = valid;
    image.set<format::FacetSet>(SectionId::kFacetSets, {set});
    image.set<std::uint32_t>(SectionId::kFacetNumbers, numbers);
    return status_of(image);
  };
  EXPECT_EQ(status_with({0, 2, 0}, {0, 69}), Status::kOk);
  EXPECT_EQ(status_with({0, 2, 0}, {0, 70}), Status::kImageValue) << "one that is not there";
  EXPECT_EQ(status_with({0, 2, 0}, {2, 1}), Status::kImageValue) << "not ascending";
  EXPECT_EQ(status_with({0, 2, 2}, {2, 1}), Status::kImageValue);
  EXPECT_EQ(status_with({0, 2, 0}, {1, 1}), Status::kImageValue) << "twice";
  EXPECT_EQ(status_with({0, 2, 1}, {2, 1}), Status::kOk) << "in two parts";
  EXPECT_EQ(status_with({0, 4, 2}, {2, 5, 1, 4}), Status::kOk);
  EXPECT_EQ(status_with({0, 4, 3}, {2, 5, 1, 4}), Status::kImageValue);
  EXPECT_EQ(status_with({0, 2, 3}, {2, 5, 6}), Status::kImageValue) << "a first part that is longer";
  EXPECT_EQ(status_with({0, 0, 0}, {2, 5}), Status::kImageValue) << "an empty set";
  EXPECT_EQ(status_with({1, 2, 0}, {7, 1, 2}), Status::kOk);
  EXPECT_EQ(status_with({2, 2, 0}, {7, 1, 2}), Status::kImageValue) << "beyond the numbers";
  EXPECT_EQ(status_with({4, 1, 0}, {7, 1, 2}), Status::kImageValue);
  EXPECT_EQ(status_with({0xffffffff, 1, 0}, {7, 1, 2}), Status::kImageValue);
  std::vector<std::uint32_t> many;
  for (std::uint32_t i = 0; i < 65; ++i) many.push_back(i);
  EXPECT_EQ(status_with({1, 64, 0}, many), Status::kOk);
  EXPECT_EQ(status_with({1, 64, 64}, many), Status::kOk);
  EXPECT_EQ(status_with({0, 65, 0}, many), Status::kImageValue);
}

/// Sample points may leave R_max and the spheres of their nodes by the rounding of single precision, a millionth.
TEST(SceneLimits, OfPointsAreTheirSpheres) {
  const ImageParts valid = test::whole_image({{Vector3(0.0, 0.0, 0.5)}, {Vector3::UnitX()}});
  const auto status_with = [&valid](auto set, bool of_body = false) {
    ImageParts image = valid;
    Structures structures(image, of_body);
    structures.body.radius = structures.features.radius = structures.body.sphere_radius = 1.0;
    set(structures);
    return status_of(image);
  };
  EXPECT_EQ(status_with([](Structures&) {}), Status::kOk);
  const double slight = 0.5 / (1.0 + 0.9e-6);
  const double much = 0.5 / (1.0 + 1.1e-6);
  EXPECT_EQ(status_with([=](Structures& s) { s.body.radius = slight; }), Status::kOk);
  EXPECT_EQ(status_with([=](Structures& s) { s.body.radius = much; }), Status::kImageValue);
  EXPECT_EQ(status_with([=](Structures& s) { s.features.radius = slight; }), Status::kOk);
  EXPECT_EQ(status_with([=](Structures& s) { s.features.radius = much; }), Status::kImageValue);
  // the bound on a body's displacement uses this sphere without any allowance
  EXPECT_EQ(status_with([](Structures& s) { s.body.sphere_center[2] = 0.25, s.body.sphere_radius = 0.25; }),
            Status::kOk);
  EXPECT_EQ(status_with([](Structures& s) {
              s.body.sphere_center[2] = 0.25, s.body.sphere_radius = std::nextafter(0.25, 0.0);
            }),
            Status::kImageValue);
  for (const bool of_body : {false, true}) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto at = [&](float reach) {
        return status_with(
            [=](Structures& s) {
              std::fill_n(s.node.center, 3, 0.0f);
              s.node.center[2] = 0.5f;
              s.node.center[axis] += 0.25f;
              s.node.radius = reach;
            },
            of_body);
      };
      EXPECT_EQ(at(0.25f), Status::kOk);
      EXPECT_EQ(at(static_cast<float>(0.25 / (1.0 + 0.9e-6))), Status::kOk);
      EXPECT_EQ(at(static_cast<float>(0.25 / (1.0 + 1.1e-6))), Status::kImageValue);
    }
  }
}

/// The body's sphere holds each of its points: the bound on a body's displacement requires it.
TEST(SceneLimits, OfTheBodysSphereHoldForEachPoint) {
  ImageParts valid = test::whole_image();
  valid.item<format::Body>(SectionId::kBody).radius = 1.0;
  const std::size_t nodes = valid.count<format::Node>(SectionId::kNodes);
  for (std::size_t i = 0; i < nodes; ++i) valid.item<format::Node>(SectionId::kNodes, i).radius = 1.0f;
  const format::Body body = valid.item<format::Body>(SectionId::kBody);
  ASSERT_EQ(status_of(valid), Status::kOk);
  ASSERT_GT(body.point_count, 2u);
  for (std::uint32_t i = 0; i < body.point_count; ++i) {
    ImageParts image = valid;
    float& x = image.item<float>(SectionId::kPoints, i);
    x = static_cast<float>(body.sphere_center[0] + 1.01 * body.sphere_radius);
    EXPECT_EQ(status_of(image), Status::kImageValue) << "point " << i;
    x = static_cast<float>(body.sphere_center[0]);
    EXPECT_EQ(status_of(image), Status::kOk) << "point " << i;
  }
}

TEST(SceneLimits, OfANormalsLengthAreAThousandth) {
  ImageParts image = point_image();
  const Vector3 directions[] = {Vector3::UnitX(), Vector3::UnitY(), Vector3::UnitZ(), Vector3(0.48, -0.6, 0.64)};
  for (const Vector3& direction : directions) {
    for (const double squared : {0.9979, 0.9981, 1.0, 1.0019, 1.0021}) {
      const Vector3 normal = std::sqrt(squared) * direction;
      for (int axis = 0; axis < 3; ++axis) {
        image.item<float>(SectionId::kNormals, static_cast<std::size_t>(axis)) = static_cast<float>(normal[axis]);
      }
      EXPECT_EQ(status_of(image), std::fabs(squared - 1.0) < 0.002 ? Status::kOk : Status::kImageValue) << squared;
    }
  }
}

TEST(SceneLimits, OfAFarClearanceIsAHundredThousandKilometres) {
  const auto status_at = [](bool inside, float clearance, std::uint32_t more) {
    ImageParts image = point_image();
    // a grid of one position, which is far, and no brick
    Structures s(image);
    s.shrink();
    std::fill_n(s.grid.bricks, 3, 1);
    s.grid.brick_count = 0;
    image.set<std::uint32_t>(SectionId::kBrickIndex, {format::index_entry::encode_far(inside, clearance) + more});
    image[SectionId::kBricks].clear();
    image[SectionId::kRefined].clear();
    return status_of(image);
  };
  for (const bool inside : {false, true}) {
    EXPECT_EQ(status_at(inside, 0.0f, 0), Status::kOk);
    EXPECT_EQ(status_at(inside, 1e8f, 0), Status::kOk);
    EXPECT_EQ(status_at(inside, 1e8f, 1), Status::kImageValue);
    EXPECT_EQ(status_at(inside, HUGE_VALF, 0), Status::kImageValue);
    EXPECT_EQ(status_at(inside, HUGE_VALF, 1), Status::kImageValue) << "NaN";
  }
}

}  // namespace
}  // namespace godobject
