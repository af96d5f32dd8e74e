// The gap of two edges: by hand, and against places tried all along both edges.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/pipeline/contact/edges/edge_gap.h"
#include "tests/support/random.h"

namespace godobject::edge_gap_test {
namespace {

/// An edge of a sheet without thickness.
EdgeInW bare(const Vector3& from, const Vector3& to) { return {{from, to}, {Vector3::Zero(), Vector3::Zero()}, 0.0}; }

/// The upper edge of a roof along x, whose faces fall by 45 degrees, and the lower edge of a keel along y.
EdgeInW roof() {
  return {{{-1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}, {Vector3(0, 1, 1).normalized(), Vector3(0, -1, 1).normalized()}, 0.0};
}
EdgeInW keel(const Vector3& at) {
  return {{at - Vector3::UnitY(), at + Vector3::UnitY()},
          {Vector3(1, 0, -1).normalized(), Vector3(-1, 0, -1).normalized()},
          0.0};
}

TEST(EdgeGap, IsTheDistanceOfCrossingEdgesAlongTheirCommonPerpendicular) {
  const EdgeGap gap = edge_gap(keel({0.25, 0.5, 0.001}), roof());
  EXPECT_NEAR(gap.distance, 0.001, 1e-15);
  EXPECT_TRUE(gap.normal.isApprox(Vector3::UnitZ(), 1e-12));
  EXPECT_TRUE(gap.on_moving.isApprox(Vector3(0.25, 0.0, 0.001), 1e-12));
  EXPECT_NEAR((gap.on_still - Vector3(0.25, 0.0, 0.0)).norm(), 0.0, 1e-15);
  EXPECT_NEAR(gap.place, 0.25, 1e-12);
}

/// Edges that meet have no direction between their nearest points. The normal is at right angles to both.
TEST(EdgeGap, HasANormalAcrossBothEdgesWhereTheyMeet) {
  test::Random random(3);
  for (int i = 0; i < 200; ++i) {
    const Vector3 meet = random.in_cube(0.1);
    const Vector3 along = random.direction();
    const Vector3 other = random.direction();
    if (along.cross(other).norm() < 0.1) continue;
    const auto edge = [&](const Vector3& direction, const Vector3& out) {
      const double before = random.between(0.2, 1.0);
      return EdgeInW{{meet - before * direction, meet + 0.5 * direction}, {out, out}, 0.0};
    };
    const Vector3 across = along.cross(other).normalized();
    const EdgeGap gap = edge_gap(edge(along, -across), edge(other, across));
    EXPECT_NEAR(gap.distance, 0.0, 1e-12);
    EXPECT_TRUE(gap.normal.isApprox(across, 1e-9)) << gap.normal.transpose() << ", not " << across.transpose();
  }
}

TEST(EdgeGap, IsNegativeWhereEachEdgeLiesInTheOthersWedge) {
  const EdgeGap gap = edge_gap(keel({0.25, 0.5, -0.001}), roof(), 0.002);
  EXPECT_NEAR(gap.distance, -0.001, 1e-15);
  EXPECT_TRUE(gap.normal.isApprox(Vector3::UnitZ(), 1e-12)) << "the way out";
  EXPECT_NEAR(edge_gap(keel({0.25, 0.5, -0.001}), roof(), 0.0005).distance, 0.001, 1e-15) << "too deep to count";
  EXPECT_NEAR(edge_gap(keel({0.25, 0.5, 0.001}), roof(), 0.002).distance, 0.001, 1e-15) << "apart";
}

/// Edges of bodies that are apart may lie in each other's wedges, but only at an end. So do those of two boxes, corner
/// beside corner, and edges end to end on one line.
TEST(EdgeGap, IsPositiveBeyondTheEndOfAnEdge) {
  EdgeInW moving = keel({0.0, 0.0, -0.001});
  EdgeInW still = roof();
  const Vector3 before = still.end[0].x() < still.end[1].x() ? still.end[0] : still.end[1];
  for (Vector3& end : moving.end) end.x() += before.x() - 0.0005;  // before the beginning of the still edge
  EXPECT_NEAR(edge_gap(moving, still, 0.002).distance, std::hypot(0.001, 0.0005), 1e-12);
  const EdgeInW along = {{roof().end[0] - 0.0003 * Vector3::UnitX() - (still.end[1] - still.end[0]), before},
                         {roof().normal[0], roof().normal[1]},
                         0.0};
  EXPECT_GE(edge_gap(along, still, 0.002).distance, 0.0);
}

/// Each face of either edge can tell that the other edge is not inside: then the face is nearer, however deep the body
/// of the face lies in that of the other edge. A nose has its tip towards y or -y.
TEST(EdgeGap, IsNotNegativeWhereAFaceParts) {
  const auto at = [](EdgeInW edge, double y) {
    edge.end[0].y() += y;
    edge.end[1].y() += y;
    return edge;
  };
  for (const double side : {1.0, -1.0}) {
    EdgeInW nose = roof();
    nose.normal[0] = Vector3(0.0, side, 1.0).normalized();
    nose.normal[1] = Vector3(0.0, side, -1.0).normalized();
    const EdgeGap over_the_still_face = edge_gap(at(nose, 0.001 * side), roof(), 0.002);
    EXPECT_NEAR(over_the_still_face.distance, 0.001, 1e-15) << side;
    EXPECT_FALSE(over_the_still_face.is_nearest) << side;
    const EdgeGap under_the_moving_face = edge_gap(at(roof(), -0.001 * side), nose, 0.002);
    EXPECT_NEAR(under_the_moving_face.distance, 0.001, 1e-15) << side;
    EXPECT_FALSE(under_the_moving_face.is_nearest) << side;
  }
}

/// An edge over a face of the other edge is nearer to the face.
TEST(EdgeGap, IsNotTheNearestOverAFace) {
  EXPECT_TRUE(edge_gap(keel({0.25, 0.5, 0.001}), roof()).is_nearest);
  const EdgeInW shelf{{{-1.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}, {Vector3::UnitZ(), Vector3::UnitY()}, 0.0};
  const auto along_x = [](double y, double z) {  // the lower edge of a box
    return EdgeInW{{{-1.0, y, z}, {1.0, y, z}}, {-Vector3::UnitZ(), Vector3::UnitY()}, 0.0};
  };
  EXPECT_FALSE(edge_gap(along_x(-0.01, 0.001), shelf).is_nearest) << "over the shelf's upper face";
  EXPECT_FALSE(edge_gap(along_x(0.001, -0.01), shelf).is_nearest) << "before its front";
  EXPECT_TRUE(edge_gap(along_x(0.0, 0.001), shelf).is_nearest) << "at the border";
  const EdgeInW behind{{{-1.0, 0.01, 0.001}, {1.0, 0.01, 0.001}}, {-Vector3::UnitZ(), -Vector3::UnitY()}, 0.0};
  EXPECT_TRUE(edge_gap(behind, shelf).is_nearest) << "beyond the edge, with its own faces turned to it";
  EXPECT_FALSE(edge_gap(along_x(0.01, 0.001), shelf).is_nearest) << "the still edge lies under the moving face";
}

TEST(EdgeGap, HasADirectionWhereEdgesMeet) {
  const EdgeGap gap = edge_gap(keel({0.25, 0.5, 0.0}), roof());
  EXPECT_EQ(gap.distance, 0.0);
  EXPECT_TRUE(gap.normal.isApprox(Vector3::UnitZ(), 1e-12));
  const EdgeGap on_each_other =
      edge_gap({{roof().end[0], roof().end[1]}, {Vector3::UnitY(), -Vector3::UnitZ()}, 0.0}, roof());
  EXPECT_NEAR(on_each_other.normal.norm(), 1.0, 1e-12) << "parallel";
}

/// Two wedges on either side of a plane touch in it with their edges. The normal is that of the plane, away from the
/// still wedge, however the wedges lean: also a sharp one that almost lies on the plane.
TEST(EdgeGap, HasTheNormalOfThePlaneBetweenWedgesThatMeet) {
  test::Random random(7);
  for (int k = 0; k < 300; ++k) {
    const Matrix3 R = exp_rotation(3.0 * random.direction()).toRotationMatrix();
    // faces of a wedge whose edge leaves the origin at an angle in the plane; they tilt by less than 3 rad together
    const auto wedge = [&](double side, double angle) {
      const Vector3 along(std::cos(angle), std::sin(angle), 0.0);
      const Vector3 up = side * Vector3::UnitZ();
      const Vector3 across = up.cross(along);
      const double first = random.between(0.0, 3.0), second = random.between(0.0, 3.0 - first);
      EdgeInW edge{{R * (-random.between(0.5, 2.0) * along), R * (random.between(0.5, 2.0) * along)},
                   {R * (std::cos(first) * up + std::sin(first) * across),
                    R * (std::cos(second) * up - std::sin(second) * across)},
                   0.0};
      if (k % 2 == 0) std::swap(edge.normal[0], edge.normal[1]);
      return edge;
    };
    const double angle = random.between(-3.0, 3.0);
    const EdgeInW still = wedge(1.0, angle);
    const EdgeInW moving = wedge(-1.0, angle + random.between(0.1, 3.0));
    const EdgeGap gap = edge_gap(moving, still);
    EXPECT_NEAR(gap.distance, 0.0, 1e-12) << k;
    EXPECT_LT((gap.normal - R * Vector3::UnitZ()).norm(), 1e-9) << k;
  }
}

TEST(EdgeGap, OfSheetsIsLessByTheirRadii) {
  EdgeInW moving = bare({0.0, -1.0, 0.3}, {0.0, 1.0, 0.3});
  EdgeInW still = bare({-1.0, 0.0, 0.0}, {1.0, 0.0, 0.0});
  moving.radius = 0.05;
  still.radius = 0.1;
  EXPECT_NEAR(edge_gap(moving, still).distance, 0.15, 1e-15);
  EXPECT_NEAR(edge_distance(moving, still), 0.15, 1e-15);
  moving.end[0].z() = moving.end[1].z() = -0.3;
  EXPECT_NEAR(edge_gap(moving, still).distance, 0.15, 1e-15) << "a sheet has two outer sides";
  EXPECT_NEAR(edge_distance(moving, still), 0.15, 1e-15) << "a sheet has two outer sides";
}

TEST(EdgeGap, EndsAtTheEndsOfTheEdges) {
  const EdgeInW still = bare({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0});
  EXPECT_NEAR(edge_gap(bare({4.0, 4.0, 0.0}, {9.0, 4.0, 0.0}), still).distance, 5.0, 1e-12) << "end to end";
  EXPECT_NEAR(edge_gap(bare({0.5, 2.0, 0.0}, {0.5, 9.0, 0.0}), still).distance, 2.0, 1e-12) << "end to middle";
  EXPECT_NEAR(edge_gap(bare({-1.0, 3.0, 0.0}, {2.0, 3.0, 0.0}), still).distance, 3.0, 1e-12) << "parallel";
}

/// Edges that cross at a hundred-thousandth of a right angle are no parallel ones: their crossing counts, not a place
/// in their middle, where they are a thousand gaps apart.
TEST(EdgeGap, OfEdgesThatAreNearlyParallelIsThatOfTheirCrossing) {
  for (const double angle : {3e-6, 1e-5, -1e-4}) {
    const auto at = [angle](double x) { return Vector3(x, angle * x, 1e-9); };
    const EdgeInW still = bare({-0.9, 0.0, 0.0}, {0.1, 0.0, 0.0});
    const EdgeInW moving = bare(at(-0.3), at(0.7));
    const EdgeGap gap = edge_gap(moving, still);
    EXPECT_NEAR(gap.distance, 1e-9, 1e-11) << angle;
    EXPECT_NEAR(gap.place, 0.3, 1e-4) << angle;
  }
}

TEST(EdgeGap, IsTheLeastDistanceOfAllPlaces) {
  test::Random random(3);
  for (int k = 0; k < 300; ++k) {
    const auto point = [&] { return Vector3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)); };
    const EdgeInW moving = bare(point(), point());
    EdgeInW still = bare(point(), point());
    if (k % 3 == 0) still.end[1] = still.end[0] + 0.7 * (moving.end[1] - moving.end[0]);  // parallel
    const EdgeGap gap = edge_gap(moving, still);
    double least = std::numeric_limits<double>::infinity();
    constexpr int kPlaces = 200;
    for (int i = 0; i <= kPlaces; ++i) {
      for (int j = 0; j <= kPlaces; ++j) {
        const Vector3 p = moving.end[0] + i * (moving.end[1] - moving.end[0]) / kPlaces;
        const Vector3 q = still.end[0] + j * (still.end[1] - still.end[0]) / kPlaces;
        least = std::min(least, (p - q).norm());
      }
    }
    EXPECT_LE(gap.distance, least + 1e-12);
    EXPECT_GE(gap.distance, least - 0.03) << "no place between the tried ones is that much nearer";
    EXPECT_NEAR((gap.on_moving - gap.on_still).norm(), gap.distance, 1e-12);
    EXPECT_EQ(edge_distance(moving, still), gap.distance);
    EXPECT_NEAR((moving.end[0] + gap.place * (moving.end[1] - moving.end[0]) - gap.on_moving).norm(), 0.0, 1e-12);
  }
}

TEST(EdgeGap, StartsAtNoDistanceInNoDirection) {
  const EdgeGap gap;
  EXPECT_EQ(gap.distance, 0.0);
  EXPECT_EQ(gap.normal, Vector3::Zero());
  EXPECT_EQ(gap.on_moving, Vector3::Zero());
  EXPECT_EQ(gap.on_still, Vector3::Zero());
  EXPECT_EQ(gap.place, 0.0);
  EXPECT_TRUE(gap.is_nearest);
}

TEST(EdgeInW, TurnsNormalsAndMovesEnds) {
  format::SharpEdge edge{};
  edge.end[0][0] = 1.0;
  edge.end[1][1] = 2.0;
  edge.normal[0][0] = edge.normal[1][1] = 1.0f;
  edge.radius = 0.5f;
  Pose H_WB;
  H_WB.rotation = Quaternion(Eigen::AngleAxisd(0.5 * M_PI, Vector3::UnitZ()));
  H_WB.translation = Vector3(10.0, 20.0, 30.0);
  const EdgeInW in_W = EdgeInW::at(edge, H_WB);
  EXPECT_TRUE(in_W.end[0].isApprox(Vector3(10.0, 21.0, 30.0), 1e-12));
  EXPECT_TRUE(in_W.end[1].isApprox(Vector3(8.0, 20.0, 30.0), 1e-12));
  EXPECT_TRUE(in_W.normal[0].isApprox(Vector3::UnitY(), 1e-12));
  EXPECT_TRUE(in_W.normal[1].isApprox(-Vector3::UnitX(), 1e-12));
  EXPECT_EQ(in_W.radius, 0.5);
  EXPECT_EQ(EdgeInW::of_still(edge).end[1].y(), 2.0);
  EXPECT_EQ(EdgeInW::of_still(edge).normal[1].y(), 1.0);
  EXPECT_EQ(EdgeInW::of_still(edge).radius, 0.5);
}

}  // namespace
}  // namespace godobject::edge_gap_test
