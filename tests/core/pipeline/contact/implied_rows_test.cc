// Which rows of points the rows of edge pairs imply, by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "core/pipeline/contact/implied_rows.h"
#include "tests/support/edge_set.h"

namespace godobject::detail {
namespace {

constexpr double kMargin = 2e-5;
constexpr double kHeight = 2e-5;

void set_faces(format::SharpEdge& edge, const Vector3& first, const Vector3& second) {
  for (int axis = 0; axis < 3; ++axis) {
    edge.normal[0][axis] = static_cast<float>(first[axis]);
    edge.normal[1][axis] = static_cast<float>(second[axis]);
  }
}

/// The lower face of a box, 20 mm wide, lies over an edge of the still body along y. The edges of the face that cross
/// it, 0 and 1, are 10 mm apart. Points are given for the pose H.
struct FaceOverAnEdge {
  Pose H;
  test::EdgeSet moving{
      {{Vector3(-0.01, -0.005, 0), Vector3(0.01, -0.005, 0)}, {Vector3(-0.01, 0.005, 0), Vector3(0.01, 0.005, 0)}}};
  test::EdgeSet still{{{Vector3(0, -0.1, 0), Vector3(0, 0.1, 0)}}};
  EdgeContacts edges;
  NearEdges near;
  std::unique_ptr<ContactRows> rows = std::make_unique<ContactRows>();

  FaceOverAnEdge() {
    const Vector3 down = -Vector3::UnitZ();
    set_faces(moving.edges()[0], down, -Vector3::UnitY());
    set_faces(moving.edges()[1], Vector3::UnitY(), down);
    set_faces(still.edges()[0], Vector3::UnitZ(), Vector3::UnitX());
    edges = {moving.view(), still.view()};
    H.translation = Vector3(0.002, 0.001, kHeight);
    for (const std::uint32_t k : {0u, 1u}) {
      near.push({k, 0}, gap_at(edges, {k, 0}, H));
      rows->push(id_of({k, 0}), Vector3::UnitZ(), Vector3::Zero(), 0.0);
    }
  }

  /// A point of the face, given in the box's frame.
  bool implies(double x, double y, double z = 0.0) const {
    const Vector3 p = H * Vector3(x, y, z);
    return implies_at(p, std::hypot(p.x(), p.z()));
  }
  bool implies_at(const Vector3& p, double distance) const {
    return is_implied({p, distance, false}, edges, near, H, *rows, kMargin, 0.1 * kMargin);
  }
};

TEST(ImpliedRows, AreThoseOfPointsOnAnEdgeOfAPair) {
  const FaceOverAnEdge scene;
  EXPECT_TRUE(scene.implies(-0.002, 0.005));
  EXPECT_TRUE(scene.implies(-0.0021, -0.005)) << "0.1 mm before the still edge";
  EXPECT_FALSE(scene.implies(-0.002, 0.005, 1e-5)) << "a point 10 um beside the edge";
}

TEST(ImpliedRows, AreThoseOfPointsOnAFaceBetweenTwoPairs) {
  const FaceOverAnEdge scene;
  EXPECT_TRUE(scene.implies(-0.002, 0.0));
  EXPECT_TRUE(scene.implies(-0.00205, 0.0045));
  EXPECT_FALSE(scene.implies(-0.002, 0.006)) << "beyond the face";
  EXPECT_FALSE(scene.implies(-0.002, 0.0, -1e-5)) << "a point below the face";
}

TEST(ImpliedRows, AreNotThoseOfPointsNearAnotherPartOfTheSurface) {
  const FaceOverAnEdge scene;
  const Vector3 p = scene.H * Vector3(-0.002, 0.0, 0.0);
  EXPECT_TRUE(scene.implies_at(p, kHeight));
  EXPECT_FALSE(scene.implies_at(p, 0.5 * kHeight)) << "something is nearer than the edge";
}

TEST(ImpliedRows, NeedBothPairsAndTheirRows) {
  FaceOverAnEdge scene;
  scene.rows->remove(0);
  EXPECT_FALSE(scene.implies(-0.002, 0.0)) << "one pair has no row";
  EXPECT_FALSE(scene.implies(-0.002, -0.005)) << "the edge of that pair";
  EXPECT_TRUE(scene.implies(-0.002, 0.005)) << "the other pair has its row";
  FaceOverAnEdge over_a_face;
  over_a_face.near.gap[0].is_nearest = false;
  EXPECT_FALSE(over_a_face.implies(-0.002, 0.0));
  FaceOverAnEdge other_faces;
  set_faces(other_faces.moving.edges()[1], Vector3::UnitY(), -Vector3(0.1, 0, 1).normalized());
  EXPECT_FALSE(other_faces.implies(-0.002, 0.0)) << "the two edges share no face";
  FaceOverAnEdge stepped;
  for (auto& end : stepped.moving.edges()[1].end) end[2] = 1e-4;
  EXPECT_FALSE(stepped.implies(-0.002, 0.0)) << "parallel faces at different heights";
}

/// The same with the roles of the bodies exchanged: a feature point of the still body under an edge of the moving one.
TEST(ImpliedRows, AreThoseOfFeaturePointsToo) {
  const FaceOverAnEdge scene;
  EdgeContacts edges{scene.edges.still, scene.edges.moving};
  NearEdges near;
  auto rows = std::make_unique<ContactRows>();
  Pose H;
  H.translation = Vector3(0.0, 0.0, -kHeight);
  for (const std::uint32_t k : {0u, 1u}) {
    near.push({0, k}, gap_at(edges, {0, k}, H));
    rows->push(id_of({0, k}), Vector3::UnitZ(), Vector3::Zero(), 0.0);
  }
  const auto implies = [&](const Vector3& p_W, bool is_feature) {
    const double distance = std::hypot(p_W.x(), p_W.z() + kHeight);
    return is_implied({p_W, distance, is_feature}, edges, near, H, *rows, kMargin, 0.1 * kMargin);
  };
  EXPECT_TRUE(implies(Vector3(1e-5, 0.005, 0.0), true)) << "on an edge of the still face";
  EXPECT_TRUE(implies(Vector3(1e-5, 0.002, 0.0), true)) << "on the still face";
  EXPECT_FALSE(implies(Vector3(1e-5, 0.007, 0.0), true)) << "beyond the still face";
  EXPECT_FALSE(implies(Vector3(1e-5, 0.002, 0.0), false)) << "no point of the moving body";
}

}  // namespace
}  // namespace godobject::detail
