// One projection of `corrected`, against mechanics: forces at one contact, in six-vectors and 6 x 6 matrices.

#include "core/pipeline/corrected/projection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "tests/support/decompositions.h"
#include "tests/support/random.h"

namespace godobject::test::projection_test {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr double kSafety = 3e-3;
constexpr double kGain = 0.2;

Vector6 stacked(const Vector3& a, const Vector3& b) {
  Vector6 v;
  v << a, b;
  return v;
}
Vector6 stacked(const Motion& xi) { return stacked(xi.translation, xi.rotation); }

/// A body, its contact and the motion that it wants to make.
struct Problem {
  MassModel mass;
  PenaltyContacts contacts;
  Motion wanted;

  double p() const { return contacts.depth - kSafety; }
  Vector3 u() const { return contacts.wrench_S.force.normalized(); }
  Vector3 tau() const { return contacts.wrench_S.torque / contacts.wrench_S.force.norm(); }
  Vector6 row() const { return stacked(u(), tau()); }
  double required() const { return p() > 0.0 ? kGain * p() : p(); }  // row . xi must not be less
  Matrix6 inverse_mass() const {
    Matrix6 inverse = Matrix6::Identity();
    inverse.bottomRightCorner<3, 3>() = mass.inertia.cwiseInverse().asDiagonal();
    return inverse;
  }
};

/// Motions so small that nothing is shortened.
Problem draw(Random& random) {
  Problem problem;
  const Vector3 second(random.between(0.1, 1.0), random.between(0.1, 1.0), random.between(0.1, 1.0));
  problem.mass = MassModel::make(1e-3 * (Vector3::Constant(second.sum()) - second), 0.05, 0.05);
  problem.contacts.depth = kSafety * random.between(0.9, 1.3);
  problem.contacts.count = 1;
  problem.contacts.wrench_S.force = random.between(0.001, 0.1) * random.direction();
  problem.contacts.wrench_S.torque =
      random.between(0.0, 0.05) * problem.contacts.wrench_S.force.norm() * random.direction();
  problem.wanted = {random.in_cube(1e-4), random.in_cube(1e-3)};
  return problem;
}

TEST(Projection, PushesAlongTheRowAloneAndOnlyAsFarAsItMust) {
  Random random(1);
  int pushed = 0;
  for (int i = 0; i < 5000; ++i) {
    const Problem problem = draw(random);
    const Projection out = project(problem.wanted, problem.contacts, kSafety, kGain, problem.mass, nullptr, {});
    const Vector6 row = problem.row();
    const double missing = problem.required() - row.dot(stacked(problem.wanted));
    Vector6 expected = stacked(problem.wanted);
    if (missing > 0.0) {
      const Vector6 direction = problem.inverse_mass() * row;
      expected += missing / row.dot(direction) * direction;
      ++pushed;
      ASSERT_LT((stacked(out.next.wanted) - expected).norm(), 1e-14) << "the next motion is compared with it";
    } else {
      EXPECT_TRUE(out.next.wanted.translation.isZero(0.0));
    }
    ASSERT_LT((stacked(out.motion) - expected).norm(), 1e-14) << i;
    ASSERT_FALSE(out.cut) << i;
    ASSERT_FALSE(out.next.slipping);
    ASSERT_EQ(out.next.relaxation, 1.0);
  }
  EXPECT_GT(pushed, 1000);
  EXPECT_LT(pushed, 4000);
}

/// Sticking, against 6 x 6 matrices: forces along the normal and two tangents at one point bring the normal to its row
/// and the tangents to rest, and nothing else acts. It sticks exactly if these forces lie in the cone.
TEST(Projection, SticksByTheForcesThatHoldTheContact) {
  Random random(8);
  int sticks = 0, slips = 0;
  for (int i = 0; i < 5000; ++i) {
    const Problem problem = draw(random);
    const double missing = problem.required() - problem.row().dot(stacked(problem.wanted));
    if (missing <= 0.0) continue;
    const ProjectionFriction friction{random.between(0.3, 3.0), 0.3, 0.0};
    const Vector3 u = problem.u(), place = u.cross(problem.tau());
    const Vector3 first = u.cross(random.direction()).normalized(), second = u.cross(first);
    Eigen::Matrix<double, 3, 6> rows;
    rows.row(0) = problem.row().transpose();
    rows.row(1) = stacked(first, place.cross(first)).transpose();
    rows.row(2) = stacked(second, place.cross(second)).transpose();
    const Vector3 target(problem.required(), 0.0, 0.0);
    const Vector3 force =
        test::least_squares(rows * problem.inverse_mass() * rows.transpose(), target - rows * stacked(problem.wanted));
    const double ratio = force.tail<2>().norm() / force.x();
    if (std::fabs(ratio / friction.static_ratio - 1.0) < 1e-9) continue;
    const bool holds = force.x() > 0.0 && ratio < friction.static_ratio;
    const Projection out = project(problem.wanted, problem.contacts, kSafety, kGain, problem.mass, &friction, {});
    ASSERT_EQ(out.next.slipping, !holds) << i;
    ++(holds ? sticks : slips);
    if (!holds) continue;
    const Vector6 expected = stacked(problem.wanted) + problem.inverse_mass() * rows.transpose() * force;
    ASSERT_LT((stacked(out.next.wanted) - expected).norm(), 1e-13) << i;
    if (!out.cut) {
      ASSERT_LT((stacked(out.motion) - expected).norm(), 1e-13) << i;
    }
  }
  EXPECT_GT(sticks, 500);
  EXPECT_GT(slips, 500);
}

/// A ball on a floor by hand: pressed 0.4 mm and pushed 0.3 mm along it. The force line goes through the centre of
/// mass, so the friction does not turn the ball. Sticking takes 0.3 mm against 0.4 mm: a ratio of 0.75.
TEST(Projection, SlipsBeyondTheConeOfABallByHand) {
  constexpr double kRadius = 0.02;
  const MassModel mass = MassModel::make(Vector3::Constant(0.4 * kRadius * kRadius), kRadius, kRadius);
  PenaltyContacts contacts;
  contacts.depth = kSafety;  // p = 0
  contacts.wrench_S.force = 0.003 * Vector3::UnitZ();
  const Motion wanted{{3e-4, 0.0, -4e-4}, Vector3::Zero()};
  const double ratio = 0.75;
  ProjectionFriction friction{ratio * 1.01, 0.5, 0.0};
  Projection out = project(wanted, contacts, kSafety, kGain, mass, &friction, {});
  EXPECT_FALSE(out.next.slipping);
  EXPECT_LT(out.motion.translation.norm(), 1e-16);
  friction.static_ratio = ratio * 0.99;
  out = project(wanted, contacts, kSafety, kGain, mass, &friction, {});
  EXPECT_TRUE(out.next.slipping);
  EXPECT_NEAR(out.motion.translation.x(), 3e-4 - 0.5 * 4e-4, 1e-15);
  // viscous: |l| = mu nu + c slip, slip = 3e-4 - |l|
  friction.viscous_step = 0.25;
  out = project(wanted, contacts, kSafety, kGain, mass, &friction, {});
  EXPECT_NEAR(out.motion.translation.x(), (3e-4 - 0.5 * 4e-4) / 1.25, 1e-15);
}

/// The largest displacement of a point of a body with this radius.
double displacement(const Motion& xi, double radius) { return xi.translation.norm() + radius * xi.rotation.norm(); }

PenaltyContacts contact_of_depth(double depth) {
  PenaltyContacts contacts;
  contacts.depth = depth;
  contacts.wrench_S.force = std::max(depth, 0.0) * Vector3::UnitZ();
  return contacts;
}

TEST(Projection, MovesNoPointFartherThanHalfTheLayer) {
  Random random(3);
  const MassModel mass = MassModel::make(Vector3::Constant(1e-4), 0.05, 0.05);
  for (int i = 0; i < 3000; ++i) {
    const Motion wanted = random.motion(0.01, 0.1);
    PenaltyContacts contacts = contact_of_depth(kSafety * random.between(0.1, 1.0));  // nothing to remove
    contacts.wrench_S.torque = 0.01 * contacts.depth * random.direction();
    const Motion& got = project(wanted, contacts, kSafety, kGain, mass, nullptr, {}).motion;
    ASSERT_LE(displacement(got, mass.radius), 0.5 * kSafety * (1.0 + 1e-9)) << i;
    // a motion away is only shortened, as a whole
    const Projection out = project(wanted, contacts, kSafety, kGain, mass, nullptr, {});
    if (out.next.wanted.translation.isZero(0.0)) {
      const double share = std::min(1.0, 0.5 * kSafety / displacement(wanted, mass.radius));
      ASSERT_LT((stacked(out.motion) - share * stacked(wanted)).norm(), 1e-12) << i;
      ASSERT_EQ(out.cut, share < 1.0) << i;
    }
  }
}

/// By hand: d = 3 mm. In region C a point may move by 1.5 mm plus its distance from the layer.
TEST(Projection, FollowsInFreeAirAsFarAsTheLayerAllows) {
  const MassModel mass = MassModel::make(Vector3::Constant(1e-4), 0.05, 0.05);
  const auto travelled = [&](const PenaltyContacts& contacts, double wanted, bool& cut) {
    const Projection out = project({{0.0, 0.6 * wanted, 0.0}, {0.4 * wanted / 0.05, 0.0, 0.0}}, contacts, kSafety,
                                   kGain, mass, nullptr, {});
    cut = out.cut;
    EXPECT_NEAR(out.motion.translation.y() * 0.4, out.motion.rotation.x() * 0.05 * 0.6, 1e-15) << "not as a whole";
    EXPECT_FALSE(out.next.slipping);
    EXPECT_EQ(out.next.relaxation, 1.0);
    return displacement(out.motion, mass.radius);
  };
  bool cut = false;
  EXPECT_NEAR(travelled(contact_of_depth(-0.010), 0.1, cut), 0.0115, 1e-15);
  EXPECT_TRUE(cut);
  EXPECT_NEAR(travelled(contact_of_depth(-0.010), 0.0114, cut), 0.0114, 1e-15);
  EXPECT_FALSE(cut);
  EXPECT_NEAR(travelled(contact_of_depth(0.0), 0.1, cut), 0.0015, 1e-15);
  EXPECT_TRUE(cut);

  // opposing contacts: half of the rest of the layer, but a hundredth of the layer at least
  PenaltyContacts opposed = contact_of_depth(0.001);
  opposed.wrench_S.force.setZero();
  EXPECT_NEAR(travelled(opposed, 0.1, cut), 0.001, 1e-15);
  EXPECT_TRUE(cut);
  for (const double depth : {0.00295, 0.003, 0.010}) {
    opposed.depth = depth;
    EXPECT_NEAR(travelled(opposed, 0.1, cut), 0.00003, 1e-15);
    EXPECT_TRUE(cut);
    EXPECT_NEAR(travelled(opposed, 0.00002, cut), 0.00002, 1e-15);
    EXPECT_FALSE(cut);
  }
}

/// The share that is taken: halved when the wanted motion reverses, down to 1/64; otherwise a quarter more, up to 1.
TEST(Projection, TakesLessWhenTheMotionReversesAndGrowsBack) {
  const MassModel mass = MassModel::make(Vector3(1e-4, 2e-4, 3e-4), 0.05, 0.05);
  const PenaltyContacts contacts = contact_of_depth(kSafety);  // p = 0: motions along the floor are free
  const auto after = [&](const Motion& wanted, const Motion& last, double relaxation) {
    ProjectionState before;
    before.wanted = last;
    before.relaxation = relaxation;
    Motion into = wanted;
    into.translation.z() = -1e-5;  // violates the row, which takes it away
    const Projection out = project(into, contacts, kSafety, kGain, mass, nullptr, before);
    EXPECT_LT((stacked(out.next.wanted) - stacked(wanted)).norm(), 1e-18);
    EXPECT_LT((stacked(out.motion) - out.next.relaxation * stacked(wanted)).norm(), 1e-18);
    return out.next.relaxation;
  };
  const Motion right{{1e-4, 0.0, 0.0}, Vector3::Zero()};
  const Motion left{{-1e-4, 0.0, 0.0}, Vector3::Zero()};
  EXPECT_EQ(after(right, left, 1.0), 0.5);
  EXPECT_EQ(after(right, left, 0.5), 0.25);
  EXPECT_EQ(after(right, left, 1.0 / 32.0), 1.0 / 64.0);
  EXPECT_EQ(after(right, left, 1.0 / 50.0), 1.0 / 64.0);
  EXPECT_EQ(after(right, left, 1.0 / 64.0), 1.0 / 64.0);
  EXPECT_EQ(after(right, right, 0.5), 0.625);
  EXPECT_EQ(after(right, right, 0.9), 1.0);
  EXPECT_EQ(after(right, {}, 0.5), 0.625) << "no contact before";
  // the mass decides what reverses: |x|^2 + J |r|^2, here 1e-8 m^2 against 2e-4 * 1e-2 * r
  EXPECT_EQ(after({{1e-4, 0.0, 0.0}, {0.0, 1e-2, 0.0}}, {{1e-4, 0.0, 0.0}, {0.0, -0.4e-2, 0.0}}, 0.5), 0.625);
  EXPECT_EQ(after({{1e-4, 0.0, 0.0}, {0.0, 1e-2, 0.0}}, {{1e-4, 0.0, 0.0}, {0.0, -0.6e-2, 0.0}}, 0.5), 0.25);
  EXPECT_EQ(after({{1e-4, 0.0, 0.0}, {0.0, 0.0, 1e-2}}, {{-1e-4, 0.0, 0.0}, {0.0, 0.0, 0.3e-2}}, 0.5), 0.25);
  EXPECT_EQ(after({{1e-4, 0.0, 0.0}, {0.0, 0.0, 1e-2}}, {{-1e-4, 0.0, 0.0}, {0.0, 0.0, 0.4e-2}}, 0.5), 0.625);
  // a swing of less than a hundred-thousandth of d, 30 nm, is left alone
  EXPECT_EQ(after({{2.9e-8, 0.0, 0.0}, Vector3::Zero()}, left, 1.0), 1.0);
  EXPECT_EQ(after({{3.1e-8, 0.0, 0.0}, Vector3::Zero()}, left, 1.0), 0.5);
  EXPECT_EQ(after({Vector3::Zero(), {0.0, 2.0e-6, 0.0}}, {Vector3::Zero(), {0.0, -1.0, 0.0}}, 1.0), 1.0);
  EXPECT_EQ(after({Vector3::Zero(), {0.0, 2.2e-6, 0.0}}, {Vector3::Zero(), {0.0, -1.0, 0.0}}, 1.0), 0.5);
}

/// A share of the motion would remove only a share of the penetration. A translation along the normal removes the rest.
TEST(Projection, MeetsTheRowHoweverLittleOfTheMotionItTakes) {
  Random random(4);
  for (int i = 0; i < 3000; ++i) {
    Problem problem = draw(random);
    problem.wanted = random.motion(0.005, 0.05);
    ProjectionState before;
    before.relaxation = random.between(1.0 / 64.0, 1.0);
    before.wanted = random.motion(0.01, 0.1);
    const bool has_friction = i % 2 == 0;
    const ProjectionFriction friction{0.5, 0.3, 0.1};
    const Projection out = project(problem.wanted, problem.contacts, kSafety, kGain, problem.mass,
                                   has_friction ? &friction : nullptr, before);
    const double missing = problem.required() - problem.row().dot(stacked(problem.wanted));
    if (missing <= 0.0) continue;
    Motion taken = out.next.wanted;
    const double share = out.next.relaxation;
    const double room = 0.5 * kSafety / displacement(taken, problem.mass.radius);
    ASSERT_EQ(out.cut, room < share) << i;
    Vector6 expected = std::min(room, share) * stacked(taken);
    const double left = problem.required() - problem.row().dot(expected);
    expected += std::max(0.0, left) * stacked(problem.u(), Vector3::Zero());
    ASSERT_LT((stacked(out.motion) - expected).norm(), 1e-13) << i;
  }
}

TEST(PenaltyContacts, HaveADirectionUnlessTheyCancel) {
  PenaltyContacts contacts;
  EXPECT_FALSE(contacts.has_direction());
  EXPECT_EQ(contacts.depth, 0.0);
  EXPECT_EQ(contacts.count, 0u);
  contacts.wrench_S.force.x() = 1.0;
  EXPECT_FALSE(contacts.has_direction()) << "nothing touches";
  contacts.depth = -1.0;
  EXPECT_FALSE(contacts.has_direction());
  for (const double depth : {1e-9, 1e-3, 1.0}) {
    contacts.depth = depth;
    contacts.wrench_S.force = 0.9e-6 * depth * Vector3::UnitY();
    EXPECT_FALSE(contacts.has_direction());
    contacts.wrench_S.force *= 1.1 / 0.9;
    EXPECT_TRUE(contacts.has_direction());
  }
}

}  // namespace
}  // namespace godobject::test::projection_test
