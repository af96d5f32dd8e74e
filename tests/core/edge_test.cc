#include "core/scene/edge.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "godobject/pose.h"
#include "tests/support/random.h"

namespace godobject {
namespace {

using Eigen::Map;

void store(const Vector3& v, double (&out)[3]) { std::copy(v.data(), v.data() + 3, out); }

/// Returns the edge of a solid that fills `angle` [rad] between its faces. The edge is along z. The first face is in
/// the plane x = 0 towards -y. The body is at x < 0 or, for a re-entrant edge, around the empty wedge there.
format::Edge edge_of(double angle, double side) {
  format::Edge edge{};
  store(Vector3::UnitZ(), edge.along);
  store(Vector3::UnitX(), edge.normal[0]);
  store(-Vector3::UnitY(), edge.face[0]);
  const Eigen::AngleAxisd turn(-angle, Vector3::UnitZ());  // turn of the face, into the wedge
  const Vector3 face = turn * -Vector3::UnitY();
  store(face, edge.face[1]);
  store(Vector3(face.y(), -face.x(), 0.0), edge.normal[1]);
  edge.side = side;
  edge.begin = -1.0;
  edge.end = 3.0;
  edge.ramp = 0.5;
  edge.radius = 0.8;
  edge.end_radius = 0.4;
  edge.slope = 0.2;
  return edge;
}

format::Edge moved(const format::Edge& edge, const Pose& pose) {
  format::Edge turned = edge;
  store(pose * Vector3(Map<const Vector3>(edge.point)), turned.point);
  store(pose.rotation * Map<const Vector3>(edge.along), turned.along);
  for (int i = 0; i < 2; ++i) {
    store(pose.rotation * Map<const Vector3>(edge.normal[i]), turned.normal[i]);
    store(pose.rotation * Map<const Vector3>(edge.face[i]), turned.face[i]);
  }
  return turned;
}

Pose any_pose(test::Random& random) {
  return {Quaternion(Eigen::AngleAxisd(random.between(0.0, 3.1), random.direction())), random.in_cube(2.0)};
}

/// Returns the distance to the two half planes by a search along each of them; negative inside the wedge.
double slow_distance(const format::Edge& edge, const Vector3& p) {
  const Vector3 from = p - Map<const Vector3>(edge.point);
  const Vector3 across = from - Map<const Vector3>(edge.along).dot(from) * Map<const Vector3>(edge.along);
  double nearest = across.norm();
  bool inside = true;
  for (int i = 0; i < 2; ++i) {
    const Map<const Vector3> face(edge.face[i]);
    double low = 0.0;
    double high = 10.0;
    for (int k = 0; k < 200; ++k) {  // along the face the distance first falls, then rises
      const double a = low + (high - low) / 3.0;
      const double b = high - (high - low) / 3.0;
      if ((across - a * face).norm() < (across - b * face).norm()) {
        high = b;
      } else {
        low = a;
      }
    }
    nearest = std::min(nearest, (across - low * face).norm());
    inside = inside && Map<const Vector3>(edge.normal[i]).dot(across) < 0.0;
  }
  return edge.side * (inside ? -nearest : nearest);
}

TEST(Edge, KnowsTheDistanceToASquareOneByHand) {
  const format::Edge edge = edge_of(0.5 * std::numbers::pi, 1.0);  // the body is x < 0, y < 0
  const auto expect = [&edge](const Vector3& p, double distance, const Vector3& gradient) {
    const ValueAndGradient g = wedge_distance(edge, p);
    EXPECT_DOUBLE_EQ(g.value, distance) << p.transpose();
    EXPECT_TRUE(g.gradient.isApprox(gradient, 1e-15)) << p.transpose() << ": " << g.gradient.transpose();
  };
  expect({0.3, -2.0, 7.0}, 0.3, Vector3::UnitX());
  expect({-2.0, 0.3, 7.0}, 0.3, Vector3::UnitY());
  expect({0.3, 0.4, -7.0}, 0.5, Vector3(0.6, 0.8, 0.0));
  expect({-0.1, -0.3, 0.0}, -0.1, Vector3::UnitX());
  expect({-0.3, -0.1, 0.0}, -0.1, Vector3::UnitY());
}

TEST(Edge, KnowsTheDistanceToAReentrantOneByHand) {
  const format::Edge edge = edge_of(0.5 * std::numbers::pi, -1.0);  // free space is x < 0, y < 0
  EXPECT_DOUBLE_EQ(wedge_distance(edge, {-0.1, -0.3, 0.0}).value, 0.1);
  EXPECT_TRUE(wedge_distance(edge, {-0.1, -0.3, 0.0}).gradient.isApprox(-Vector3::UnitX()));
  EXPECT_DOUBLE_EQ(wedge_distance(edge, {0.3, 0.4, 0.0}).value, -0.5);
  EXPECT_TRUE(wedge_distance(edge, {0.3, 0.4, 0.0}).gradient.isApprox(Vector3(-0.6, -0.8, 0.0)));
}

/// On the faces the distance is 0, and at the edge the gradient stays finite.
TEST(Edge, KnowsItsFacesAndItself) {
  format::Edge edge = edge_of(0.5 * std::numbers::pi, 1.0);
  store(-Vector3::UnitX(), edge.face[1]);  // without the rounding of pi
  store(Vector3::UnitY(), edge.normal[1]);
  EXPECT_EQ(wedge_distance(edge, {0.0, -0.5, 0.25}).value, 0.0);
  EXPECT_EQ(wedge_distance(edge, {-0.5, 0.0, 0.25}).value, 0.0);
  EXPECT_EQ(wedge_distance(edge, {0.0, 0.0, 0.25}).value, 0.0);
  for (const double tiny : {0.0, 1e-300, 1e-200, 1e-160, 1e-20}) {
    const ValueAndGradient g = wedge_distance(edge, {tiny, tiny, 0.25});
    EXPECT_LE(g.value, 2.0 * tiny);
    EXPECT_LE(g.gradient.norm(), 1.001) << tiny;  // of numbers whose squares have few digits
  }
}

TEST(Edge, AgreesWithASlowSearchAndItsOwnDifferences) {
  test::Random random(1);
  for (int i = 0; i < 3000; ++i) {
    const Pose pose = any_pose(random);
    format::Edge edge = moved(edge_of(random.between(0.1, 3.0), random.between(-1.0, 1.0) < 0.0 ? -1.0 : 1.0), pose);
    const Vector3 p = pose * random.in_cube(1.5);
    const double distance = wedge_distance(edge, p).value;
    EXPECT_NEAR(distance, slow_distance(edge, p), 1e-12);
    const double step = 1e-6;
    const Vector3 direction = random.direction();
    const double ahead = wedge_distance(edge, p + step * direction).value;
    EXPECT_LE(std::abs(ahead - distance), step * (1.0 + 1e-9));  // the slope of a distance is at most 1
    const double behind = wedge_distance(edge, p - step * direction).value;
    if (std::abs(ahead - 2.0 * distance + behind) > 1e-9) continue;  // across a crease
    EXPECT_NEAR(wedge_distance(edge, p).gradient.dot(direction), (ahead - behind) / (2.0 * step), 1e-5);
    edge.offset = 0.25;
    EXPECT_DOUBLE_EQ(wedge_distance(edge, p).value, distance + 0.25);
  }
}

TEST(Edge, CountsByHand) {
  const format::Edge edge = edge_of(1.0, 1.0);
  EXPECT_EQ(edge_weight(edge, {0.0, 0.0, 1.0}).value, 1.0);
  EXPECT_EQ(edge_weight(edge, {0.3, 0.0, 1.0}).value, 1.0);                 // R = 0.8 in the middle
  EXPECT_DOUBLE_EQ(edge_weight(edge, {0.0, 0.6, 1.0}).value, 0.5);          // 2 (1 - 0.6 / 0.8)
  EXPECT_DOUBLE_EQ(edge_weight(edge, {0.0, 0.375, -0.5}).value, 0.5);       // R = 0.4 + 0.2 * 0.5
  EXPECT_DOUBLE_EQ(edge_weight(edge, {0.0, 0.0, -0.9}).value, 0.1 / 0.5);   // the ramp
  EXPECT_DOUBLE_EQ(edge_weight(edge, {0.0, 0.0, 2.75}).value, 0.25 / 0.5);  // the same ramp at the other end
  for (const Vector3& p :
       {Vector3(0.8, 0.0, 1.0), Vector3(0.0, 0.0, -1.0), Vector3(0.0, 0.0, 3.0), Vector3(0.0, 0.0, 9.0)}) {
    EXPECT_EQ(edge_weight(edge, p).value, 0.0);
    EXPECT_EQ(edge_weight(edge, p).gradient, Vector3::Zero());
  }
}

TEST(Edge, CountsWithoutAJumpAndAsItsGradientSays) {
  test::Random random(2);
  int between = 0;
  for (int i = 0; i < 20000; ++i) {
    const Pose pose = any_pose(random);
    const format::Edge edge = moved(edge_of(1.0, 1.0), pose);
    const Vector3 p = pose * Vector3(random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-1.2, 3.2));
    const ValueAndGradient w = edge_weight(edge, p);
    EXPECT_GE(w.value, 0.0);
    EXPECT_LE(w.value, 1.0);
    const double step = 1e-7;
    const Vector3 direction = random.direction();
    const double ahead = edge_weight(edge, p + step * direction).value;
    const double behind = edge_weight(edge, p - step * direction).value;
    const double steepest = std::max(1.0 / edge.ramp, 2.0 / edge.end_radius * std::hypot(1.0, edge.slope));
    EXPECT_LE(std::abs(ahead - behind), 2.0 * step * steepest * (1.0 + 1e-6));
    if (std::abs(ahead - 2.0 * w.value + behind) > 1e-10) continue;  // across a crease of w
    EXPECT_NEAR(w.gradient.dot(direction), (ahead - behind) / (2.0 * step), 1e-6);
    if (w.value > 0.0 && w.value < 1.0) ++between;
  }
  EXPECT_GT(between, 2000);
}

}  // namespace
}  // namespace godobject
