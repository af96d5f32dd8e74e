#include "toolchain/live/contact_points.h"

#include <gtest/gtest.h>

#include "tests/support/random.h"
#include "tests/support/small_scenes.h"

namespace godobject::live::contact_points_test {
namespace {

std::vector<ContactPoint> corners(double half_edge) {
  std::vector<ContactPoint> points;
  for (const double x : {-half_edge, half_edge}) {
    for (const double y : {-half_edge, half_edge}) points.push_back({Vector3(x, y, 0.0), Vector3::UnitZ(), 0.0});
  }
  return points;
}

TEST(SetLoads, SpreadsAPressureEvenlyOverFourCorners) {
  std::vector<ContactPoint> points = corners(0.02);
  set_loads(points, Vector3(0.0, 0.0, 0.03), {Vector3(0.0, 0.0, 8.0), Vector3::Zero()}, 0.02);
  for (const ContactPoint& point : points) EXPECT_NEAR(point.load, 2.0, 0.01);
}

/// A force of 8 N with a lever of 10 mm towards +x: 3 N on each corner there, 1 N on the others.
TEST(SetLoads, ExplainsATorqueByUnequalLoads) {
  std::vector<ContactPoint> points = corners(0.02);
  set_loads(points, Vector3::Zero(), {Vector3(0.0, 0.0, 8.0), Vector3(0.0, -0.01 * 8.0, 0.0)}, 0.02);
  for (const ContactPoint& point : points) EXPECT_NEAR(point.load, point.p_W.x() > 0.0 ? 3.0 : 1.0, 0.02);
}

/// A force that pulls cannot come from contacts.
TEST(SetLoads, NeverPulls) {
  std::vector<ContactPoint> points = corners(0.02);
  set_loads(points, Vector3::Zero(), {Vector3(1.0, 0.0, -8.0), Vector3::Zero()}, 0.02);
  for (const ContactPoint& point : points) EXPECT_EQ(point.load, 0.0);
}

/// Three points are never ambiguous: the loads that made the wrench come back.
TEST(SetLoads, FindsTheLoadsOfThreePoints) {
  test::Random random(11);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<ContactPoint> points;
    std::vector<double> loads;
    Wrench wrench;
    const Vector3 c_W = random.in_cube(0.1);
    for (int i = 0; i < 3; ++i) {
      const Vector3 normal = exp_rotation(random.motion(0.0, 3.0).rotation) * Vector3::UnitX();
      points.push_back({c_W + random.in_cube(0.02), normal, 7.0});
      loads.push_back(random.between(0.0, 5.0));
      wrench.force += loads.back() * normal;
      wrench.torque += (points.back().p_W - c_W).cross(loads.back() * normal);
    }
    set_loads(points, c_W, wrench, 0.02);
    Wrench found;
    for (const ContactPoint& point : points) {
      ASSERT_GE(point.load, 0.0);
      found.force += point.load * point.normal_W;
      found.torque += (point.p_W - c_W).cross(point.load * point.normal_W);
    }
    EXPECT_LT((found.force - wrench.force).norm(), 0.05 * (1.0 + wrench.force.norm())) << trial;
    EXPECT_LT((found.torque - wrench.torque).norm(), 0.02 * 0.05 * (1.0 + wrench.force.norm())) << trial;
  }
}

class ContactPoints : public testing::Test {
 protected:
  test::SceneImage image_ = test::ball_over_plate();
  SceneView scene_ = test::open_scene(image_);
};

/// The ball of 20 mm rests on a plate whose top is at 10 mm.
TEST_F(ContactPoints, AreBelowABallThatRestsOnAPlate) {
  const Wrench wrench{Vector3(0.0, 0.0, 5.0), Vector3::Zero()};
  const std::vector<ContactPoint> points =
      contact_points(scene_, {Quaternion::Identity(), Vector3(0.01, 0.005, 0.03 + scene_.settings.margin)}, wrench);
  ASSERT_FALSE(points.empty());
  double load = 0.0;
  for (const ContactPoint& point : points) {
    EXPECT_NEAR(point.p_W.z(), 0.01, 1e-3);
    EXPECT_LT((point.p_W - Vector3(0.01, 0.005, 0.01)).norm(), 3e-3);
    EXPECT_GT(point.normal_W.z(), 0.999);
    load += point.load;
  }
  EXPECT_NEAR(load, 5.0, 0.05);
}

TEST_F(ContactPoints, AreAtMostAsManyAsAPictureShows) {
  scene_.settings.margin = 0.006;  // hundreds of points
  const Pose H_WS{Quaternion::Identity(), Vector3(0.0, 0.0, 0.03)};
  const std::vector<ContactPoint> points = contact_points(scene_, H_WS, {});
  EXPECT_LE(points.size(), kMostContactPoints);
  EXPECT_GT(points.size(), kMostContactPoints / 3);
  Vector3 middle = Vector3::Zero();
  for (const ContactPoint& point : points) middle += point.p_W / static_cast<double>(points.size());
  EXPECT_LT(middle.head<2>().norm(), 0.003) << "they lie on one side";
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) EXPECT_GT((points[i].p_W - points[k].p_W).norm(), 0.02 * 0.02);
  }
}

TEST_F(ContactPoints, AreNoneFarAway) {
  EXPECT_TRUE(contact_points(scene_, {Quaternion::Identity(), Vector3(0.0, 0.0, 0.5)}, {}).empty());
}

}  // namespace
}  // namespace godobject::live::contact_points_test
