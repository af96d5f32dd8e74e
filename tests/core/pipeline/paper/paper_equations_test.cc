// The paper's equations, written down once more with 4 x 4 matrices and plain geometry, against the cycle `paper`.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/pipeline/paper/paper_cycle.h"
#include "tests/support/analytic_worlds.h"
#include "tests/support/random.h"

namespace godobject::test::paper_equations_test {
namespace {

using Matrix4 = Eigen::Matrix4d;

constexpr double kEdge = 0.002;

Matrix4 matrix_of(const Vector3& x, const Vector3& r) {
  Matrix4 H = Matrix4::Identity();
  if (r.norm() > 0.0) H.topLeftCorner<3, 3>() = Eigen::AngleAxisd(r.norm(), r.normalized()).toRotationMatrix();
  H.topRightCorner<3, 1>() = x;
  return H;
}
Matrix4 matrix_of(const Pose& pose) {
  Matrix4 H = Matrix4::Identity();
  H.topLeftCorner<3, 3>() = pose.rotation.toRotationMatrix();
  H.topRightCorner<3, 1>() = pose.translation;
  return H;
}
Vector3 translation_of(const Matrix4& H) { return H.topRightCorner<3, 1>(); }
Vector3 rotation_of(const Matrix4& H) {
  const Eigen::AngleAxisd turn(Matrix3(H.topLeftCorner<3, 3>()));
  return turn.angle() * turn.axis();
}

/// The body, by its principal moments over its mass.
struct SlowBody {
  Vector3 moments;
  double sigma() const { return std::cbrt(moments.x() * moments.y() * moments.z()); }  // (4)
  /// (11), the axes of the ellipsoid of uniform density with these moments
  Vector3 squared_axes() const {
    const auto [a, b, c] = std::array{moments.x(), moments.y(), moments.z()};
    return 2.5 * Vector3(b + c - a, a + c - b, a + b - c);
  }
};

struct SlowCorrection {
  Vector3 u_x, u_r, x, r;
  double p, delta, radius, lambda;
};

/// Equations (5) to (27).
SlowCorrection slow_correction(const SlowBody& body, const Vector3& f, const Vector3& t, double depth, double d) {
  SlowCorrection c;
  c.u_x = f / f.norm();
  const Vector3 u_t = t / t.norm();
  const Matrix3 J = Matrix3(body.moments.asDiagonal()) / body.sigma();
  c.u_r = (J.inverse() * u_t).normalized();
  c.p = depth - d;
  c.delta = t.norm() / f.norm();

  // (12)-(17) where the ellipsoid is a unit ball: the line enters it half a chord before its nearest point
  const Vector3 A = c.delta * u_t.cross(c.u_x);
  const Vector3 axes = body.squared_axes().cwiseSqrt();
  const Vector3 start = A.cwiseQuotient(axes);
  const Vector3 along = c.u_x.cwiseQuotient(axes);
  const double nearest = -start.dot(along) / along.squaredNorm();
  const double distance = (start + nearest * along).norm();
  Vector3 Q_L;
  if (distance <= 1.0) {
    Q_L = A + (nearest - std::sqrt(1.0 - distance * distance) / along.norm()) * c.u_x;
  } else {
    const Vector3 S = axes.cwiseAbs2().cwiseProduct(A) / axes.cwiseProduct(A).norm();
    Q_L = A + (S - A).dot(c.u_x) * c.u_x;
  }
  c.radius = Q_L.norm();

  // (21)-(27): lambda is the minimum of a parabola, the kinetic energy for p = 1
  const auto energy = [&](double lambda) {
    const double theta = c.delta / (c.radius * c.radius) * (1.0 - lambda);
    return lambda * lambda + theta * theta * body.sigma() * c.u_r.dot(J * c.u_r);
  };
  const double curvature = energy(1.0) + energy(-1.0) - 2.0 * energy(0.0);
  c.lambda = -0.5 * (energy(1.0) - energy(-1.0)) / curvature;
  c.x = c.lambda * c.p * c.u_x;                                            // (7)
  c.r = c.delta / (c.radius * c.radius) * c.p * (1.0 - c.lambda) * c.u_r;  // (7), (21)
  return c;
}

/// Equations (34) to (40) and (47), (48), for translations or rotations.
Vector3 slow_motion(const Vector3& wanted, const Vector3& u, double delta, double p, const Vector3& mu, bool friction) {
  const Vector3 parallel = u * u.transpose() * wanted;
  const Vector3 perpendicular = (Matrix3::Identity() - u * u.transpose()) * wanted;
  // the restricted part of the motion towards the surface: all of it in region A, in region B the part beyond contact
  const double towards = std::max(0.0, -u.dot(wanted));
  const double restricted = p >= 0.0 ? towards : std::max(0.0, towards - delta);
  const Vector3 allowed = parallel + restricted * u;
  Vector3 x_fr = Vector3::Zero();  // Algorithm 1; mu: static, kinetic, viscous
  if (friction && restricted > 0.0) {
    if (perpendicular.norm() < mu[0] * restricted) {
      x_fr = -perpendicular;
    } else {
      x_fr = -mu[1] * restricted * perpendicular.normalized() - mu[2] * perpendicular;
    }
  }
  return allowed + perpendicular + x_fr;
}

/// Equation (43).
Matrix4 slow_filter(const Matrix4& before, const Matrix4& target, const Matrix4& device, double period) {
  const Matrix4 gap = target.inverse() * device;
  const double distance = std::hypot(translation_of(gap).norm(), std::sqrt(0.025) * rotation_of(gap).norm());
  const double frequency = std::min(60.0, 1.0 + 19.0 * distance / 0.007);
  const double share = 1.0 - std::exp(-2.0 * M_PI * frequency * period);
  const Matrix4 step = before.inverse() * target;
  return before * matrix_of(share * translation_of(step), share * rotation_of(step));
}

/// Equations (44) to (46), step #7: force and torque, with damping, on the axes of W.
struct SlowForce {
  Vector3 spring_force, spring_torque, force, torque;
};
SlowForce slow_force(const Matrix4& S, const Matrix4& D, const Motion& velocity, const Parameters& q) {
  const Matrix4 stretch = D.inverse() * S;
  const Matrix3 R = D.topLeftCorner<3, 3>();
  SlowForce out;
  out.spring_force = q.stiffness * q.coupling_translation * (R * translation_of(stretch));
  out.spring_torque = q.stiffness * q.coupling_rotation * (R * rotation_of(stretch));
  const auto damped = [](const Vector3& spring, const Vector3& v, double b) -> Vector3 {
    if (spring.norm() < 1e-12) return Vector3::Zero();  // no contact, but for rounding
    const Vector3 n = spring.normalized();
    return std::max(0.0, spring.norm() - b * n.dot(v)) * n;
  };
  out.force = damped(out.spring_force, velocity.translation, q.damping * q.coupling_translation);
  out.torque = damped(out.spring_torque, velocity.rotation, q.damping * q.coupling_rotation);
  return out;
}

struct SlowCycle {
  Matrix4 S = Matrix4::Identity();
  double depth = 0.0;
  int count = 0;
};

/// Steps #1 to #5. `moments`: J_B / m.
template <bool kFriction, class Field>
SlowCycle slow_cycle(const Field& field, const SampledBody& body, const SlowBody& slow, const Parameters& q,
                     const Matrix4& S, const Matrix4& D) {
  SlowCycle out;
  out.depth = -1.0;
  const Pointshell shell = body.pointshell();
  const Matrix3 R = S.topLeftCorner<3, 3>();
  Vector3 f = Vector3::Zero();
  Vector3 t = Vector3::Zero();
  for (std::size_t i = 0; i < shell.size; ++i) {
    const Vector3 P = R * shell.point(i) + translation_of(S);
    const LayerSample sample = field.layer(P);
    const double V = sample.layer * kEdge + (R * shell.normal(i)).dot(sample.to_center) + q.safety_distance;  // (1)
    out.depth = std::max(out.depth, V);
    if (V <= 0.0) continue;
    ++out.count;
    f += V * shell.normal(i);  // (2), on the axes of S
    t += V * shell.point(i).cross(shell.normal(i));
  }
  out.S = D;
  if (out.depth <= 0.0) return out;  // region C
  const SlowCorrection c = slow_correction(slow, f, t, out.depth, q.safety_distance);
  const double eta = c.p >= 0.0 ? 0.2 : 0.0;
  const Matrix4 H_pen = matrix_of(eta * c.x, eta * c.r);            // (28)
  const Matrix4 S1 = S * H_pen;                                     // (29)
  const Matrix3 into_S1 = H_pen.topLeftCorner<3, 3>().transpose();  // (30), whose printed direction is corrected
  const Matrix4 free = S1.inverse() * D;                            // (32)
  const PaperFriction& mu = q.paper_friction;
  const Vector3 x = slow_motion(translation_of(free), into_S1 * c.u_x, c.x.norm(), c.p,
                                {mu.translation_static, mu.translation_kinetic, mu.viscous}, kFriction);
  const Vector3 r = slow_motion(rotation_of(free), into_S1 * c.u_r, c.r.norm(), c.p,
                                {mu.rotation_static, mu.rotation_kinetic, mu.viscous}, kFriction);
  out.S = slow_filter(S, S1 * matrix_of(x, r), D, q.period);  // (41)-(43)
  return out;
}

TEST(PaperCorrection, IsThePrintedOneForAnyWrench) {
  Random random(1);
  int outside = 0;
  for (int i = 0; i < 20000; ++i) {
    // moments of three masses on the axes: any body's, none flat
    const Vector3 second(random.between(0.1, 1.0), random.between(0.1, 1.0), random.between(0.1, 1.0));
    const SlowBody body{1e-3 * (Vector3::Constant(second.sum()) - second)};
    const MassModel mass = MassModel::make(body.moments, 0.05, 0.05);
    PenaltyContacts contacts;
    contacts.depth = random.between(0.0, 0.01);
    contacts.wrench_S.force = std::pow(10.0, random.between(-5.0, 0.0)) * random.direction();
    const double lever = std::pow(10.0, random.between(-4.0, 0.0));
    contacts.wrench_S.torque = lever * contacts.wrench_S.force.norm() * random.direction();
    const double d = random.between(0.001, 0.005);
    const SlowCorrection expected =
        slow_correction(body, contacts.wrench_S.force, contacts.wrench_S.torque, contacts.depth, d);
    const Correction got = correction(contacts, d, mass);
    ASSERT_LT((got.u_x - expected.u_x).norm(), 1e-12) << i;
    ASSERT_LT((got.u_r - expected.u_r).norm(), 1e-12) << i;
    ASSERT_EQ(got.penetration, expected.p) << i;
    ASSERT_NEAR(got.lever, expected.delta, 1e-12) << i;
    ASSERT_NEAR(got.rotation_radius, expected.radius, 1e-7) << i;  // half of the digits are lost where the line touches
    ASSERT_NEAR(got.distribution, expected.lambda, 1e-6) << i;
    ASSERT_LT((got.delta.translation - expected.x).norm(), 1e-8) << i;
    ASSERT_LT((got.delta.rotation - expected.r).norm(), 1e-6 * (1.0 + expected.r.norm())) << i;
    outside += expected.radius > 2.0 * body.squared_axes().cwiseSqrt().maxCoeff() ? 1 : 0;
  }
  EXPECT_GT(outside, 1000);
}

/// A force without lever moves nothing; a force below the rounding of V constrains nothing.
TEST(PaperCorrection, HasAConstraintFromTheSmallestForceAndARotationFromTheSmallestLever) {
  const MassModel mass = box_body().mass;
  const auto with = [&](double force, double lever) {
    PenaltyContacts contacts;
    contacts.depth = 0.004;
    contacts.wrench_S.force = force * Vector3::UnitY();
    contacts.wrench_S.torque = force * lever * Vector3::UnitX();
    return correction(contacts, 0.003, mass);
  };
  for (const double force : {1e-15, 0.9e-12}) {
    const Correction c = with(force, 0.01);
    EXPECT_TRUE(c.u_x.isZero(0.0) && c.u_r.isZero(0.0) && c.delta.rotation.isZero(0.0)) << force;
    EXPECT_NEAR(c.penetration, 0.001, 1e-15);
  }
  for (const double force : {1.1e-12, 1e-9}) {
    EXPECT_EQ(with(force, 0.01).u_x, Vector3::UnitY()) << force;
    EXPECT_EQ(with(force, 0.9e-12).u_x, Vector3::UnitY()) << force;
    EXPECT_TRUE(with(force, 0.9e-12).u_r.isZero(0.0)) << force;
    EXPECT_TRUE(with(force, 0.9e-12).delta.translation.isZero(0.0)) << force;
    EXPECT_EQ(with(force, 1.1e-12).u_r, Vector3::UnitX()) << force;
    EXPECT_GT(with(force, 1e-9).delta.rotation.x(), 0.0) << force;
  }
  const Correction none;
  EXPECT_EQ(none.penetration + none.lever + none.rotation_radius + none.distribution, 0.0);
}

TEST(ProxyFilter, IsThePrintedOneForAnyPoses) {
  Random random(2);
  for (int i = 0; i < 3000; ++i) {
    const Pose before = set_matrix(random.motion(1.0, 3.0));
    const Pose target = before * set_matrix(random.motion(0.01, 0.2));
    const double size = std::pow(10.0, random.between(-5.0, 0.0));
    const Pose device = target * set_matrix(random.motion(size, size));
    const double period = std::pow(10.0, random.between(-4.0, 0.0));
    const Matrix4 expected = slow_filter(matrix_of(before), matrix_of(target), matrix_of(device), period);
    ASSERT_LT((matrix_of(filter_proxy(before, target, device, period)) - expected).norm(), 1e-10) << i;
  }
}

/// Random bodies that are pressed into a ball. The printed cycle and the one above run side by side, always from the
/// same pose, because integer layers would magnify rounding errors.
template <bool kFriction>
void expect_printed_cycle(unsigned seed) {
  Random random(seed);
  const AnalyticField world(Ball{Vector3(0.01, -0.02, 0.03), 0.1}, kEdge);
  const SampledBody body = box_body(5);
  const Vector3 edges(0.06, 0.04, 0.03);
  const Vector3 squares = edges.cwiseAbs2();
  const SlowBody slow{(Vector3::Constant(squares.sum()) - squares) / 12.0};
  int regions[3] = {0, 0, 0};
  for (int i = 0; i < 1500; ++i) {
    Pose start = set_matrix(random.motion(0.0, 3.0));
    start.translation = Vector3(0.01, -0.02, 0.03) + random.between(0.11, 0.14) * random.direction();
    AnalyticRun<AnalyticField, PaperCycle<kFriction>> run(world, body, start);
    Parameters& q = run.parameters;
    q.safety_distance = random.between(0.001, 0.005);
    q.period = random.between(5e-4, 2e-3);
    q.stiffness = random.between(100.0, 5000.0);
    q.damping = random.between(0.0, 50.0);
    q.coupling_translation = random.between(0.5, 2.0);
    q.coupling_rotation = random.between(0.01, 0.1);
    q.paper_friction = {random.between(0.0, 1.0), random.between(0.0, 0.5), random.between(0.0, 1.0),
                        random.between(0.0, 0.5), random.between(0.0, 0.1)};
    const Pose device = start * set_matrix(random.motion(0.01, 0.3));
    const Motion velocity{random.in_cube(0.2), random.in_cube(2.0)};
    const SlowCycle expected = slow_cycle<kFriction>(world, body, slow, q, matrix_of(start), matrix_of(device));
    ASSERT_EQ(run.step(device, velocity), Status::kOk) << i;
    const double p = expected.depth - q.safety_distance;
    ++regions[expected.depth <= 0.0 ? 2 : p < 0.0 ? 1 : 0];
    ASSERT_LT((matrix_of(run.state.H_WS) - expected.S).norm(), 1e-9) << i;
    ASSERT_TRUE(run.report.H_WS == run.state.H_WS) << i;
    ASSERT_EQ(run.report.contacts, static_cast<std::uint32_t>(expected.count)) << i;
    ASSERT_EQ(run.report.substeps, 1u);
    ASSERT_EQ(run.report.outcome, expected.depth > 0.0 ? Outcome::kContact : Outcome::kFree) << i;
    if (expected.count > 0) {
      ASSERT_NEAR(run.report.penetration, p, 1e-12) << i;
    } else {
      ASSERT_TRUE(run.state.H_WS == device) << i;
    }
    const SlowForce force = slow_force(matrix_of(run.state.H_WS), matrix_of(device), velocity, q);
    const DeviceForce& got = run.report.force;
    ASSERT_LT((got.spring_W.force - force.spring_force).norm(), 1e-8) << i;
    ASSERT_LT((got.spring_W.torque - force.spring_torque).norm(), 1e-8) << i;
    ASSERT_LT((got.total_W.force - force.force).norm(), 1e-8) << i;
    ASSERT_LT((got.total_W.torque - force.torque).norm(), 1e-8) << i;
  }
  for (const int count : regions) EXPECT_GT(count, 100);
}

TEST(Paper, IsThePrintedCycle) { expect_printed_cycle<false>(3); }
TEST(Paper, IsThePrintedCycleWithFriction) { expect_printed_cycle<true>(4); }

TEST(PaperFriction, IsAlgorithmOneForAnyMotion) {
  Random random(5);
  int sticks = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vector3 u = random.direction();
    const Vector3 wanted = random.in_cube(0.01);
    const double delta = random.between(0.0, 0.01);
    const double p = random.between(-1.0, 1.0);
    const Vector3 mu(random.between(0.0, 1.0), random.between(0.0, 1.0), random.between(0.0, 0.2));
    const Vector3 without = constrained_motion(wanted, u, delta, p);
    ASSERT_LT((without - slow_motion(wanted, u, delta, p, mu, false)).norm(), 1e-15) << i;
    const SplitMotion free = split(wanted, u);
    const Vector3 added = paper_friction(wanted - without, free.perpendicular, mu[0], mu[1], mu[2]);
    ASSERT_LT((without + added - slow_motion(wanted, u, delta, p, mu, true)).norm(), 1e-15) << i;
    sticks += added == -free.perpendicular ? 1 : 0;
  }
  EXPECT_GT(sticks, 500);
}

/// A body that leaves the surface, or approaches it from afar, is not restricted: not even by a rounding error, which
/// would bring the viscous friction about.
TEST(PaperFriction, IsZeroWhereNothingIsRestricted) {
  Random random(6);
  for (int i = 0; i < 2000; ++i) {
    const Vector3 u = random.direction();
    Vector3 wanted = random.in_cube(0.01);
    if (wanted.dot(u) < 0.0) wanted = -wanted;
    EXPECT_EQ(constrained_motion(wanted, u, 0.005, 1.0), wanted);
    EXPECT_EQ(constrained_motion(wanted, u, 0.005, -1.0), wanted);
    EXPECT_EQ(constrained_motion(-wanted, u, 0.02, -1.0), -wanted);
    EXPECT_NE(constrained_motion(-wanted, u, 0.0, -1.0), -wanted);
  }
}

TEST(PaperFriction, SlipsOnTheEdgeOfItsConeAndRestsWithoutTangent) {
  const Vector3 restricted(0.0, 0.0, -2.0);
  // the perpendicular motion is exactly mu_s times the restricted one: line 9
  EXPECT_EQ(paper_friction(restricted, Vector3(0.5, 0.0, 0.0), 0.25, 0.125, 0.0), Vector3(-0.25, 0.0, 0.0));
  EXPECT_EQ(paper_friction(restricted, Vector3(0.499, 0.0, 0.0), 0.25, 0.125, 0.0), Vector3(-0.499, 0.0, 0.0));
  EXPECT_EQ(paper_friction(restricted, Vector3::Zero(), 0.0, 0.125, 0.5), Vector3(0.0, 0.0, 0.0));
  // no guard may hide behind a length of 1
  EXPECT_EQ(paper_friction(1e-9 * restricted, Vector3(1e-9, 0.0, 0.0), 0.25, 0.125, 0.0), Vector3(-0.25e-9, 0.0, 0.0));
}

}  // namespace
}  // namespace godobject::test::paper_equations_test
