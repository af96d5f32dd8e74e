// Friction of one projection of `corrected`: a lever by hand, and Coulomb's law in six-vectors and 6 x 6 matrices.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "core/pipeline/corrected/projection.h"
#include "tests/support/decompositions.h"
#include "tests/support/random.h"

namespace godobject::test::projection_friction_test {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr double kFrictionSafety = 3e-3;
constexpr double kFrictionGain = 0.2;

Vector6 six_vector(const Motion& xi) {
  Vector6 v;
  v << xi.translation, xi.rotation;
  return v;
}

/// A body whose contact pushes along +z at the end of a lever of L = 50 mm along x. Jh = L^2 about all axes: a force of
/// 1 along z or y moves the contact point by 1, and by L^2/L^2 = 1 more with the rotation; along x by 1 alone.
struct Lever {
  static constexpr double kLength = 0.05;
  MassModel mass = MassModel::make(Vector3::Constant(kLength * kLength), kLength, kLength);
  PenaltyContacts contacts;

  Lever() {
    contacts.depth = kFrictionSafety;  // p = 0: the contact point must not go down
    contacts.count = 1;
    contacts.wrench_S.force = 0.003 * Vector3::UnitZ();
    contacts.wrench_S.torque = Vector3(kLength, 0.0, 0.0).cross(contacts.wrench_S.force);
  }
  Projection after(const Vector3& wanted, const ProjectionFriction& friction, bool slipped = false) const {
    ProjectionState before;
    before.slipping = slipped;
    return project({wanted, Vector3::Zero()}, contacts, kFrictionSafety, kFrictionGain, mass, &friction, before);
  }
};

/// Expects the motion of the wanted one and three forces at the lever's end.
void expect_forces(const Projection& out, const Vector3& wanted, const Vector3& force) {
  const double L = Lever::kLength;
  EXPECT_LT((out.motion.translation - wanted - force).norm(), 1e-15);
  EXPECT_LT((out.motion.rotation - Vector3(L, 0.0, 0.0).cross(force) / (L * L)).norm(), 1e-13);
  EXPECT_LT((six_vector(out.next.wanted) - six_vector(out.motion)).norm(), 1e-17);
}

/// The point is pressed 0.4 mm: it takes 0.2 mm of normal force. It is pushed by q along x and by s along y. Holding it
/// takes q and s/2.
TEST(Projection, SticksAtTheEndOfALeverByHand) {
  const Lever lever;
  const ProjectionFriction friction{0.8, 0.5, 0.0};
  const struct {
    double q, s;
  } held[] = {{0.0, 0.0}, {1.59e-4, 0.0}, {0.0, 3.19e-4}, {-1.2e-4, 2.0e-4}};  // hypot(q, s/2) < 0.8 * 2e-4
  for (const auto& [q, s] : held) {
    const Vector3 wanted(q, s, -4e-4);
    const Projection out = lever.after(wanted, friction);
    EXPECT_FALSE(out.next.slipping) << q << ", " << s;
    EXPECT_FALSE(out.cut);
    expect_forces(out, wanted, {-q, -0.5 * s, 2e-4});
  }
  EXPECT_TRUE(lever.after({1.61e-4, 0.0, -4e-4}, friction).next.slipping);
  EXPECT_TRUE(lever.after({0.0, 3.21e-4, -4e-4}, friction).next.slipping);
  EXPECT_TRUE(lever.after({-1.2e-4, 2.2e-4, -4e-4}, friction).next.slipping);
  // a contact that slipped sticks again in the narrower cone of mu_k: up to 0.5 * 2e-4
  EXPECT_FALSE(lever.after({0.99e-4, 0.0, -4e-4}, friction, true).next.slipping);
  EXPECT_TRUE(lever.after({1.01e-4, 0.0, -4e-4}, friction, true).next.slipping);
}

/// Slipping along one axis: the force is |l| = mu_k nu + c slip with nu = 0.2 mm. The slip is q - |l| along x and
/// s - 2 |l| along y.
TEST(Projection, SlipsAtTheEndOfALeverByHand) {
  const Lever lever;
  for (const double mu : {0.0, 0.25}) {
    for (const double c : {0.0, 0.5, 2.0}) {
      const ProjectionFriction friction{0.3, mu, c};
      for (const double sign : {1.0, -1.0}) {
        const Vector3 x(sign * 3e-4, 0.0, -4e-4);
        const Projection along_x = lever.after(x, friction);
        EXPECT_TRUE(along_x.next.slipping);
        expect_forces(along_x, x, {-sign * (mu * 2e-4 + c * 3e-4) / (1.0 + c), 0.0, 2e-4});
        const Vector3 y(0.0, sign * 3e-4, -4e-4);
        const Projection along_y = lever.after(y, friction);
        EXPECT_TRUE(along_y.next.slipping);
        expect_forces(along_y, y, {0.0, -sign * (mu * 2e-4 + c * 3e-4) / (1.0 + 2.0 * c), 2e-4});
      }
    }
  }
}

/// A lever of L^2 = 6 Jh that points anywhere about the normal; the wanted motion turns with it. In the lever's frame,
/// by hand: a force along the lever moves the contact point by 1, one across it by 1 + 6, as one along the normal does.
/// So nu = 0.1 mm, and |l| = mu_k nu + c slip with a slip of w - |l| along the lever and of w - 7 |l| across it.
TEST(Projection, SlipsAlikeWhereverTheLeverPoints) {
  constexpr double L = 0.05, kJh = L * L / 6.0;
  const MassModel mass = MassModel::make(Vector3::Constant(kJh), L, L);
  const ProjectionFriction friction{0.3, 0.25, 0.5};
  for (int step = 0; step < 16; ++step) {
    const Matrix3 turn = exp_rotation(Vector3(0.0, 0.0, M_PI / 8.0 * step)).toRotationMatrix();
    const Vector3 lever(L, 0.0, 0.0);
    PenaltyContacts contacts;
    contacts.depth = kFrictionSafety;  // p = 0: the contact point must not go down
    contacts.count = 1;
    contacts.wrench_S.force = 0.003 * Vector3::UnitZ();
    contacts.wrench_S.torque = (turn * lever).cross(contacts.wrench_S.force);
    for (const int axis : {0, 1}) {
      Vector3 wanted(0.0, 0.0, -7e-4);
      wanted[axis] = 7e-4;
      Vector3 force(0.0, 0.0, 1e-4);
      force[axis] = -(0.25 * 1e-4 + 0.5 * 7e-4) / (1.0 + 0.5 * (axis == 0 ? 1.0 : 7.0));
      const Projection out = project({turn * wanted, Vector3::Zero()}, contacts, kFrictionSafety, kFrictionGain, mass,
                                     &friction, ProjectionState{});
      EXPECT_TRUE(out.next.slipping) << step << ", axis " << axis;
      EXPECT_LT((out.next.wanted.translation - turn * (wanted + force)).norm(), 5e-8) << step << ", axis " << axis;
      EXPECT_LT((out.next.wanted.rotation - turn * lever.cross(force) / kJh).norm(), 5e-6) << step << ", axis " << axis;
    }
  }
}

/// One contact of a body with any inertia and lever. The force line may carry a torque along itself.
struct FrictionProblem {
  MassModel mass;
  PenaltyContacts contacts;
  Motion wanted;
  ProjectionFriction friction;
  bool slipped = false;

  explicit FrictionProblem(Random& random) {
    const Vector3 second(random.between(0.3, 1.0), random.between(0.3, 1.0), random.between(0.3, 1.0));
    mass = MassModel::make(1e-3 * (Vector3::Constant(second.sum()) - second), 0.05, 0.05);
    contacts.depth = kFrictionSafety * random.between(0.95, 1.05);
    contacts.count = 1;
    contacts.wrench_S.force = random.between(0.001, 0.1) * random.direction();
    contacts.wrench_S.torque = random.between(0.0, 0.03) * contacts.wrench_S.force.norm() * random.direction();
    wanted = {random.in_cube(1e-4), random.in_cube(1e-3)};
    friction.kinetic_ratio = random.between(0.0, 0.8);
    friction.static_ratio = friction.kinetic_ratio + random.between(0.0, 1.0);
    friction.viscous_step = random.integer(0, 1) == 0 ? 0.0 : random.between(0.0, 2.0);
    slipped = random.integer(0, 1) == 1;
  }

  Vector3 u() const { return contacts.wrench_S.force.normalized(); }
  Vector3 tau() const { return contacts.wrench_S.torque / contacts.wrench_S.force.norm(); }
  double required() const {
    const double p = contacts.depth - kFrictionSafety;
    return p > 0.0 ? kFrictionGain * p : p;
  }
  /// Rows of the normal and of two tangents at the point of the force line that is nearest to the centre of mass.
  Eigen::Matrix<double, 3, 6> rows() const {
    const Vector3 lever = u().cross(tau());
    const Vector3 e1 = u().cross(std::fabs(u().x()) < 0.6 ? Vector3::UnitX() : Vector3::UnitY()).normalized();
    const Vector3 e2 = e1.cross(u());
    Eigen::Matrix<double, 3, 6> rows;
    rows << u().transpose(), tau().transpose(), e1.transpose(), lever.cross(e1).transpose(), e2.transpose(),
        lever.cross(e2).transpose();
    return rows;
  }
  Matrix6 mass_matrix() const {
    Matrix6 matrix = Matrix6::Identity();
    matrix.bottomRightCorner<3, 3>() = mass.inertia.asDiagonal();
    return matrix;
  }
};

/// The motion is the wanted one and a force at the contact. The force holds the point, within the cone, or it opposes
/// the slip with |l| = mu_k nu + c slip.
TEST(Projection, MeetsCoulombsLawAtAnyContact) {
  Random random(5);
  int stuck = 0, slipped = 0;
  for (int i = 0; i < 4000; ++i) {
    const FrictionProblem problem(random);
    const Eigen::Matrix<double, 3, 6> rows = problem.rows();
    const Vector6 wanted = six_vector(problem.wanted);
    if (rows.row(0).dot(wanted) >= problem.required()) continue;
    ProjectionState before;
    before.slipping = problem.slipped;
    const Projection out = project(problem.wanted, problem.contacts, kFrictionSafety, kFrictionGain, problem.mass,
                                   &problem.friction, before);
    const Vector6 got = six_vector(out.motion);
    const Vector6 wrench = problem.mass_matrix() * (got - wanted);
    const Vector3 force = test::least_squares(rows.transpose(), wrench);
    ASSERT_LT((rows.transpose() * force - wrench).norm(), 1e-15) << i << ": other forces";
    const Vector3 velocity = rows * got;
    const double slip = velocity.tail<2>().norm();
    const double friction = force.tail<2>().norm();
    ASSERT_GE(velocity[0], problem.required() - 1e-15) << i;
    ASSERT_GE(force[0], -1e-18) << i;
    // viscous friction alone may lift the point: then nothing presses on it
    ASSERT_LT(force[0] * (velocity[0] - problem.required()), 1e-18) << i;

    const Eigen::Matrix3d mobility = rows * problem.mass_matrix().inverse() * rows.transpose();
    const Vector3 at_rest(problem.required(), 0.0, 0.0);
    const Vector3 holding = mobility.inverse() * (at_rest - rows * wanted);
    const double ratio = problem.slipped ? problem.friction.kinetic_ratio : problem.friction.static_ratio;
    const bool sticks = holding[0] >= 0.0 && holding.tail<2>().norm() <= ratio * holding[0];
    ASSERT_EQ(out.next.slipping, !sticks) << i;
    if (sticks) {
      ++stuck;
      ASSERT_LT(slip, 1e-15) << i;
      continue;
    }
    ++slipped;
    const double allowed = problem.friction.kinetic_ratio * force[0] + problem.friction.viscous_step * slip;
    ASSERT_NEAR(friction, allowed, 1e-9) << i;
    ASSERT_NEAR(force.tail<2>().dot(velocity.tail<2>()), -friction * slip, 1e-14) << i << ": not against the slip";
  }
  EXPECT_GT(stuck, 100);
  EXPECT_GT(slipped, 200);
}

/// At the end of a long lever the rounds of a slipping contact do not converge. Yet the contact that presses keeps its
/// gap: friction neither lifts it nor lets it in.
TEST(Projection, MeetsTheRowOfASlippingContactAtTheEndOfALongLever) {
  Random random(6);
  int pressed = 0;
  for (int i = 0; i < 4000; ++i) {
    FrictionProblem problem(random);
    problem.contacts.wrench_S.torque *= random.between(10.0, 100.0);
    const Eigen::Matrix<double, 3, 6> rows = problem.rows();
    const Vector6 wanted = six_vector(problem.wanted);
    if (rows.row(0).dot(wanted) >= problem.required()) continue;
    const Projection out = project(problem.wanted, problem.contacts, kFrictionSafety, kFrictionGain, problem.mass,
                                   &problem.friction, ProjectionState{});
    if (!out.next.slipping) continue;
    const Vector6 got = six_vector(out.next.wanted);
    const Vector6 wrench = problem.mass_matrix() * (got - wanted);
    const Vector3 force = test::least_squares(rows.transpose(), wrench);
    const double left = rows.row(0).dot(got) - problem.required();
    const double rounding = 1e-13 * (rows.row(0).norm() * got.norm() + problem.required());
    ASSERT_GE(left, -rounding) << i;
    if (!(force[0] > 1e-9)) continue;
    ++pressed;
    ASSERT_LE(left, rounding) << i;
  }
  EXPECT_GT(pressed, 500);
}

}  // namespace
}  // namespace godobject::test::projection_friction_test
