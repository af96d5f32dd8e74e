// Step #1 by the sphere tree, against all points, and what it may look up.

#include "core/pipeline/penalty/penalty_contacts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "tests/support/analytic_worlds.h"
#include "tests/support/random.h"

namespace godobject::test::penalty_contacts_test {
namespace {

constexpr double kVoxel = 0.002;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Random points with normals, and a sphere tree over halves of the list with leaves of up to four points.
class TreeBody {
 public:
  TreeBody(Random& random, int count, double size) {
    for (int i = 0; i < count; ++i) {
      // neighbours in the list are neighbours in space: a spiral
      const double t = 0.1 * i;
      const Vector3 p = size * Vector3(std::cos(t), std::sin(t), 2.0 * i / count - 1.0) + random.in_cube(0.1 * size);
      const Vector3 n = random.direction();
      for (int axis = 0; axis < 3; ++axis) {
        points_[axis].push_back(static_cast<float>(p[axis]));
        normals_[axis].push_back(static_cast<float>(n[axis]));
      }
    }
    split(0, static_cast<std::uint32_t>(count));
  }

  Pointshell shell() const {
    return {points_[0].size(),  points_[0].data(),  points_[1].data(),  points_[2].data(),
            normals_[0].data(), normals_[1].data(), normals_[2].data(), {nodes_.data(), nodes_.size()}};
  }

 private:
  void split(std::uint32_t first, std::uint32_t count) {
    const std::size_t at = nodes_.size();
    nodes_.push_back({});
    Vector3 low = Vector3::Constant(kInfinity);
    Vector3 high = -low;
    for (std::uint32_t i = first; i < first + count; ++i) {
      const Vector3 p = point(i);
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    const Vector3 center = (0.5 * (low + high)).cast<float>().cast<double>();
    double radius = 0.0;
    for (std::uint32_t i = first; i < first + count; ++i) radius = std::max(radius, (point(i) - center).norm());
    const bool is_leaf = count <= 4;
    if (!is_leaf) {
      split(first, count / 2);
      split(first + count / 2, count - count / 2);
    }
    format::Node& node = nodes_[at];
    for (int axis = 0; axis < 3; ++axis) node.center[axis] = static_cast<float>(center[axis]);
    node.radius = static_cast<float>(radius * (1.0 + 1e-6));
    node.skip = static_cast<std::uint32_t>(nodes_.size());
    node.first_point = first;
    node.point_count = count;
    node.leaf = is_leaf ? 1 : 0;
  }
  Vector3 point(std::uint32_t i) const {
    return {static_cast<double>(points_[0][i]), static_cast<double>(points_[1][i]), static_cast<double>(points_[2][i])};
  }

  std::vector<float> points_[3];
  std::vector<float> normals_[3];
  std::vector<format::Node> nodes_;
};

/// Counts the look-ups of a ball.
class CountingField : public AnalyticField {
 public:
  CountingField() : AnalyticField(Ball{Vector3::Zero(), 0.1}, kVoxel) {}
  FieldSample sample(const Vector3& p) const noexcept {
    ++sample_count;
    return AnalyticField::sample(p);
  }
  LayerSample layer(const Vector3& p) const noexcept {
    ++sample_count;
    return AnalyticField::layer(p);
  }
  double lower_bound(const Vector3& center, double radius) const noexcept {
    ++bound_count;
    return AnalyticField::lower_bound(center, radius);
  }
  double distance(const Vector3& p) const noexcept { return AnalyticField::sample(p).distance; }
  /// Returns the layer without counting it.
  LayerSample plain_layer(const Vector3& p) const noexcept { return AnalyticField::layer(p); }

  mutable int sample_count = 0;
  mutable int bound_count = 0;
};

Pose draw_pose(Random& random) {
  Pose pose = set_matrix(random.motion(0.0, 3.0));
  pose.translation = random.between(0.1, 0.2) * random.direction();
  return pose;
}

/// Returns the contacts by (1) and (2) of all points; `value` and `normal` of point i at p_W.
template <class Value>
PenaltyContacts of_all_points(const Pointshell& shell, const Pose& H_WS, Value value) {
  PenaltyContacts contacts;
  contacts.depth = -kInfinity;
  const Matrix3 R = H_WS.rotation.toRotationMatrix();
  for (std::size_t i = 0; i < shell.size; ++i) {
    Vector3 normal_W;
    const double V = value(i, R * shell.point(i) + H_WS.translation, R, normal_W);
    contacts.depth = std::max(contacts.depth, V);
    if (V <= 0.0) continue;
    ++contacts.count;
    contacts.wrench_S.force += V * R.transpose() * normal_W;
    contacts.wrench_S.torque += V * shell.point(i).cross(R.transpose() * normal_W);
  }
  return contacts;
}

TEST(PenaltyContacts, AreThoseOfAllPoints) {
  Random random(1);
  int touching = 0;
  for (int i = 0; i < 2000; ++i) {
    const TreeBody body(random, random.integer(1, 60), random.between(0.01, 0.05));
    const Pointshell shell = body.shell();
    const CountingField field;
    const Pose H_WS = draw_pose(random);
    const double d = random.between(0.0005, 0.005);
    const double travel = random.integer(0, 1) == 0 ? 0.0 : random.between(0.0, 0.05);
    const auto check = [&](const PenaltyContacts& got, const PenaltyContacts& expected) {
      ASSERT_EQ(got.count, expected.count) << i;
      touching += expected.count > 0 ? 1 : 0;
      ASSERT_LT((got.wrench_S.force - expected.wrench_S.force).norm(), 1e-13) << i;
      ASSERT_LT((got.wrench_S.torque - expected.wrench_S.torque).norm(), 1e-14) << i;
      // in region C a bound, which is exact for a motion that may reach a contact
      if (expected.depth > 0.0 || -expected.depth < travel) {
        ASSERT_NEAR(got.depth, expected.depth, 1e-15) << i;
      } else {
        ASSERT_GE(got.depth, expected.depth) << i;
        ASSERT_LE(got.depth, std::max(-travel, expected.depth) + 1e-15) << i;
      }
    };
    check(penalty_contacts<DistancePenetration>(field, shell, H_WS, d, travel),
          of_all_points(shell, H_WS, [&](std::size_t, const Vector3& p, const Matrix3&, Vector3& normal) {
            normal = p.normalized();
            return d - field.distance(p);
          }));
    // layers are integers: a bound of the distance says less about V, by up to a layer and a diagonal
    const PenaltyContacts expected =
        of_all_points(shell, H_WS, [&](std::size_t k, const Vector3& p, const Matrix3& R, Vector3& normal) {
          normal = R * shell.normal(k);
          const LayerSample layer = field.plain_layer(p);
          return layer.layer * kVoxel + normal.dot(layer.to_center) + d;
        });
    const PenaltyContacts got = penalty_contacts<LayerPenetration>(field, shell, H_WS, d, 0.0);
    ASSERT_EQ(got.count, expected.count) << i;
    ASSERT_LT((got.wrench_S.force - expected.wrench_S.force).norm(), 1e-13) << i;
    ASSERT_LT((got.wrench_S.torque - expected.wrench_S.torque).norm(), 1e-14) << i;
    ASSERT_GE(got.depth, expected.depth) << i;
    if (expected.count > 0) {
      ASSERT_EQ(got.depth, expected.depth) << i;
    }
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(touching, 300);
}

/// The points that a visit leaves out are no nearer than it says, and it visits no leaf that is farther than the
/// cutoff.
TEST(VisitPointsBelow, FindsAllNearPointsAndBoundsTheOthers) {
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const TreeBody body(random, random.integer(1, 60), random.between(0.01, 0.05));
    const Pointshell shell = body.shell();
    const CountingField field;
    const Pose H_WS = draw_pose(random);
    const double cutoff = random.between(0.0, 0.1);
    std::set<std::size_t> visited;
    const double of_others =
        visit_points_below(cutoff, field, shell, H_WS, [&](std::size_t p, const Vector3& p_W) noexcept {
          EXPECT_LT((p_W - H_WS * shell.point(p)).norm(), 1e-15);
          EXPECT_TRUE(visited.insert(p).second) << "visited twice";
          return cutoff;
        });
    double nearest_other = kInfinity;
    std::set<std::size_t> allowed;
    for (const format::Node& node : shell.nodes) {
      if (node.leaf == 0) continue;
      const Vector3 center(static_cast<double>(node.center[0]), static_cast<double>(node.center[1]),
                           static_cast<double>(node.center[2]));
      if (field.distance(H_WS * center) - static_cast<double>(node.radius) >= cutoff + 1e-15) continue;
      for (std::uint32_t p = node.first_point; p < node.first_point + node.point_count; ++p) allowed.insert(p);
    }
    for (std::size_t p = 0; p < shell.size; ++p) {
      if (visited.count(p) > 0) {
        ASSERT_TRUE(allowed.count(p) > 0) << i;
      } else {
        nearest_other = std::min(nearest_other, field.distance(H_WS * shell.point(p)));
      }
    }
    ASSERT_GE(nearest_other, cutoff) << i;
    ASSERT_LE(of_others, nearest_other) << i;
    ASSERT_EQ(of_others == kInfinity, visited.size() == shell.size) << i;
    if (of_others < kInfinity) {
      ASSERT_GE(of_others, cutoff) << i;
    }
  }
}

/// A visit may lower its own cutoff: what is farther than that is not looked up any more.
TEST(VisitPointsBelow, LooksUpNothingBeyondACutoffThatAVisitHasLowered) {
  Random random(3);
  const TreeBody body(random, 64, 0.03);
  const CountingField field;
  const Pose H_WS = draw_pose(random);
  const auto visits = [&](double lowered) {
    int count = 0;
    visit_points_below(1.0, field, body.shell(), H_WS, [&](std::size_t, const Vector3&) noexcept {
      ++count;
      return lowered;
    });
    return count;
  };
  EXPECT_EQ(visits(1.0), 64);
  EXPECT_LE(visits(-1.0), 4) << "only the first leaf";
  EXPECT_GE(visits(-1.0), 1);
}

TEST(PenaltyContacts, CostOneLookUpFarFromEverything) {
  Random random(4);
  const TreeBody body(random, 60, 0.03);
  const CountingField field;
  Pose far;
  far.translation.x() = 10.0;
  penalty_contacts<DistancePenetration>(field, body.shell(), far, 0.003, 0.01);
  EXPECT_EQ(field.sample_count, 0);
  EXPECT_EQ(field.bound_count, 1);
}

/// In region C a search for a long motion stops at the nearest point so far, give or take its leaf.
TEST(PenaltyContacts, LookUpNoPointBeyondTheNearestSoFar) {
  Random random(5);
  for (int i = 0; i < 500; ++i) {
    const TreeBody body(random, 60, 0.02);
    const Pointshell shell = body.shell();
    CountingField field;
    Pose H_WS = draw_pose(random);
    H_WS.translation = random.between(0.13, 0.3) * random.direction();
    const double d = 0.003;
    // leaves, in the order of the tree, that may hold a point nearer than all points before
    double nearest = kInfinity;
    int allowed = 0;
    for (const format::Node& node : shell.nodes) {
      if (node.leaf == 0) continue;
      const Vector3 center(static_cast<double>(node.center[0]), static_cast<double>(node.center[1]),
                           static_cast<double>(node.center[2]));
      const double bound = field.distance(H_WS * center) - static_cast<double>(node.radius);
      if (bound >= std::max(d, nearest) + 1e-12) continue;
      allowed += static_cast<int>(node.point_count);
      for (std::uint32_t p = node.first_point; p < node.first_point + node.point_count; ++p) {
        nearest = std::min(nearest, field.distance(H_WS * shell.point(p)));
      }
    }
    field.sample_count = 0;
    penalty_contacts<DistancePenetration>(field, shell, H_WS, d, 1.0);
    ASSERT_LE(field.sample_count, allowed) << i;
  }
}

/// By hand, for s = 2 mm and d = 3 mm: half a layer, and half a diagonal of 1.732 mm each for e and for phi(C).
TEST(PenaltyContacts, CannotTouchBeyondTheContactDistance) {
  EXPECT_NEAR(LayerPenetration::contact_distance(0.003, 0.002), 0.003 + 0.001 + 2.0 * 0.0017320508, 1e-9);
  EXPECT_EQ(DistancePenetration::contact_distance(0.003, 0.002), 0.003);
}

/// A still body whose stored gradient has any length.
struct AnyGradient {
  Vector3 of = Vector3::Zero();
  double distance(const Vector3& p) const noexcept { return p.x(); }
  Vector3 gradient(const Vector3&) const noexcept { return of; }
};

TEST(PenaltyContacts, HaveNoNormalWhereTheFieldIsFlat) {
  const Vector3 direction(0.0, 0.6, 0.8);
  for (const double length : {0.0, 0.9e-3, 1.1e-3, 0.5, 2.0}) {
    const AnalyticField field(AnyGradient{length * direction}, kVoxel);
    const Vector3 p_W(0.001, 5.0, 7.0);
    const PointPenetration point = DistancePenetration::at(field, Pointshell{}, 0, p_W, Matrix3::Identity(), 0.003);
    EXPECT_NEAR(point.value, 0.002, 1e-15);
    EXPECT_LT((point.normal_W - (length > 1e-3 ? 1.0 : 0.0) * direction).norm(), 1e-15) << length;
  }
}

/// A point exactly on the safety layer does not touch. All numbers are exact in binary.
TEST(PenaltyContacts, BeginWithinTheLayer) {
  const AnalyticField floor(HalfSpace{}, kVoxel);
  const SampledBody point({{Vector3::Zero()}, {Vector3::UnitZ()}}, Vector3::Zero());
  Pose pose;
  pose.translation.z() = 0.25;
  const auto contacts = [&](double d) {
    return penalty_contacts<DistancePenetration>(floor, point.pointshell(), pose, d, 1.0);
  };
  EXPECT_EQ(contacts(0.25).count, 0u);
  EXPECT_EQ(contacts(0.25).depth, 0.0);
  EXPECT_EQ(contacts(std::nextafter(0.25, 1.0)).count, 1u);
  EXPECT_EQ(PointPenetration{}.value, 0.0);
}

TEST(SmallestDistance, IsThatOfAllPoints) {
  Random random(6);
  for (int i = 0; i < 500; ++i) {
    const TreeBody body(random, random.integer(1, 200), random.between(0.01, 0.05));
    const Pointshell shell = body.shell();
    CountingField field;
    const Pose H_WS = draw_pose(random);
    double smallest = field.band();
    const Matrix3 R = H_WS.rotation.toRotationMatrix();
    for (std::size_t p = 0; p < shell.size; ++p) {
      smallest = std::min(smallest, field.distance(R * shell.point(p) + H_WS.translation));
    }
    field.sample_count = 0;
    ASSERT_EQ(smallest_distance(field, shell, H_WS), smallest) << i;
  }
  const CountingField field;
  TreeBody body(random, 5, 0.01);
  Pose beyond;
  beyond.translation.x() = 5000.0;
  EXPECT_EQ(smallest_distance(field, body.shell(), beyond), field.band());
}

}  // namespace
}  // namespace godobject::test::penalty_contacts_test
