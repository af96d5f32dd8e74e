// The problem of one sub-step with its active set and contacts: half spaces, books of the rows, forces.

#include "core/pipeline/contact/qp/contact_set.h"

#include <cfloat>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/pipeline/contact/qp/combined_forces.h"
#include "core/pipeline/contact/qp/contact_forces.h"
#include "core/pipeline/contact/qp/meet_rows.h"
#include "tests/support/random.h"

namespace godobject::test::contact_set_test {
namespace {

using detail::ActiveSet;
using detail::Additions;
using detail::Contact;
using detail::ContactSet;
using detail::CouplingSpace;
using detail::Slip;

const CouplingMetric kSetMetric;

/// The objects that a set refers to.
struct SetBench {
  std::unique_ptr<ContactRows> rows = std::make_unique<ContactRows>();
  Motion wanted{{0.001, -0.002, -0.005}, {0.01, 0.02, -0.03}};
  CouplingMetric metric = kSetMetric;
  ContactFriction friction{0.5, 0.25, 0.0};
  Motion last;
  WorkMeter work;

  ContactSet set() { return {*rows, wanted, metric, &friction, last, work}; }
  /// Adds rows with random normals and points and the required gains -1 mm, -2 mm, ...
  void push_random(Random& random, int count) {
    for (int i = 0; i < count; ++i)
      rows->push(100 + rows->count, random.direction(), random.in_cube(0.03), -1e-3 * (i + 1));
  }
  bool is_excluded(std::uint32_t row) const { return rows->required_gain[row] == -FLT_MAX; }
};

Vector6 six(const Motion& m, double gyration) {
  Vector6 z;
  z << m.translation, gyration * m.rotation;
  return z;
}

Vector3 velocity(const Motion& m, const Vector3& point) { return m.translation + m.rotation.cross(point); }

Matrix6 random_metric(Random& random) {
  Matrix6 a = Matrix6::NullaryExpr([&] { return random.between(-1.0, 1.0); });
  return Matrix6::Identity() + a.transpose() * a;
}

// -- coordinates

TEST(CouplingSpace, GivesTheWorkOfAPushAndTheMotionOfALoadInAnyMetric) {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const double gyration = random.between(0.05, 2.0);
    CouplingSpace space(gyration);
    const Matrix6 H = i % 3 == 0 ? Matrix6::Identity() : random_metric(random);
    if (i % 3 != 0) space.set_metric(H);
    const Vector3 push = random.in_cube(1.0), point = random.in_cube(0.1);
    const Vector6 z = Vector6::NullaryExpr([&] { return random.between(-1.0, 1.0); });
    const Motion m = space.motion(space.plain(z));
    EXPECT_NEAR(space.gradient(push, point).dot(z), push.dot(velocity(m, point)), 1e-12);
    const Vector6 load = Vector6::NullaryExpr([&] { return random.between(-1.0, 1.0); });
    EXPECT_LT((H * space.plain(space.target(load)) - load).norm(), 1e-12);
    // a motion under a load and a push: the push changes z by its gradient
    Vector6 push_load;
    push_load << push, point.cross(push) / gyration;
    EXPECT_LT((space.target(Vector6(load + push_load)) - space.target(load) - space.gradient(push, point)).norm(),
              1e-12);
    const Vector3 other = random.in_cube(1.0), other_point = random.in_cube(0.1);
    EXPECT_LT((space.gradient(push, point, other, other_point) - space.gradient(push, point) -
               space.gradient(other, other_point))
                  .norm(),
              1e-12);
    space.reset();
    EXPECT_EQ(space.gradient(push, point), push_load);
    EXPECT_EQ(space.gradient(push, point, Vector3::Zero(), other_point), push_load);
    EXPECT_EQ(space.target(load), load);
    EXPECT_EQ(space.plain(load), load);
    EXPECT_EQ(space.gyration(), gyration);
  }
}

TEST(ContactSet, StartsAtTheWantedMotion) {
  SetBench bench;
  const ContactSet set = bench.set();
  EXPECT_LT((six(set.motion(), kSetMetric.gyration) - six(bench.wanted, kSetMetric.gyration)).norm(), 1e-17);
  EXPECT_EQ(set.target(), six(bench.wanted, kSetMetric.gyration));
  EXPECT_EQ(set.contact_count(), 0);
  EXPECT_EQ(set.active().size(), 0);
  EXPECT_EQ(set.additions(), 0u);
}

TEST(ContactSet, SplitsTheDisplacementOfAPointByItsNormal) {
  Random random(2);
  SetBench bench;
  const ContactSet set = bench.set();
  for (int i = 0; i < 100; ++i) {
    Contact contact;
    contact.normal = random.direction();
    contact.point = random.in_cube(0.05);
    contact.grip = random.in_cube(0.05);
    const Motion m = random.motion(0.01, 0.1);
    const Slip slip = set.slip_of(contact, m);
    const Vector3 v = velocity(m, contact.grip);
    EXPECT_NEAR(slip.approach, contact.normal.dot(velocity(m, contact.point)), 1e-16);
    EXPECT_LT((slip.speed * slip.direction - v + contact.normal.dot(v) * contact.normal).norm(), 1e-16);
    EXPECT_NEAR(slip.direction.norm(), 1.0, 1e-12);
    EXPECT_NEAR(slip.direction.dot(contact.normal), 0.0, 1e-9);
  }
}

TEST(ContactSet, TakesASlipThatIsNotAboveStillForRest) {
  SetBench bench;
  const ContactSet set = bench.set();
  Contact contact;
  contact.normal = Vector3::UnitZ();
  contact.point = contact.grip = Vector3::Zero();
  const auto slip_at = [&](double speed) { return set.slip_of(contact, {{0.0, speed, 0.3}, Vector3::Zero()}); };
  EXPECT_EQ(slip_at(kSetMetric.still).direction, Vector3::Zero());
  EXPECT_EQ(slip_at(kSetMetric.still).speed, kSetMetric.still);
  EXPECT_EQ(slip_at(1.001 * kSetMetric.still).direction, Vector3::UnitY());
  EXPECT_EQ(slip_at(0.0).approach, 0.3);
}

TEST(ContactSet, HasTheStaticRatioForAPointThatRestedAndTheKineticOneForAPointThatSlipped) {
  SetBench bench;
  bench.rows->push(0, Vector3::UnitZ(), Vector3(0.02, 0.0, 0.0), 0.0);
  for (const double speed : {0.0, kSetMetric.still, 1.01 * kSetMetric.still, 1.0}) {
    bench.last.rotation = Vector3(0.0, 0.0, speed / 0.02);
    ContactSet set = bench.set();
    const Contact& contact = set.contact(set.open(0));
    EXPECT_EQ(contact.ratio, speed > 1.005 * kSetMetric.still ? 0.25 : 0.5) << speed;
    set.close_all();
  }
}

TEST(ContactSet, MakesHalfSpacesOfItsRows) {
  Random random(3);
  SetBench bench;
  bench.push_random(random, 8);
  ContactSet set = bench.set();
  for (std::uint32_t row = 0; row < 8; ++row) {
    const ActiveSet::Inequality h = set.row_half_space(row);
    const Motion m = random.motion(0.01, 0.1);
    EXPECT_NEAR(h.gradient.dot(six(m, kSetMetric.gyration)),
                bench.rows->normal(row).dot(velocity(m, bench.rows->point(row))), 1e-16);
    EXPECT_EQ(h.rhs, static_cast<double>(bench.rows->required_gain[row]));
    EXPECT_EQ(h.tag.row, row);
    EXPECT_EQ(h.tag.slip, Vector3::Zero());
    EXPECT_EQ(h.multiplier, 0.0);
  }
}

/// (n - mu d) . v >= required gain - mu shift, for any direction d.
TEST(ContactSet, MakesHalfSpacesOfACone) {
  Random random(4);
  SetBench bench;
  bench.push_random(random, 8);
  ContactSet set = bench.set();
  for (std::uint32_t row = 0; row < 6; ++row) {
    const int k = set.open(row);
    Contact& c = set.contact(k);
    c.shift = 1e-4 * row;
    c.ratio = 0.1 * row;
    const Vector3 slip = row == 5 ? Vector3::Zero() : Vector3(c.normal.cross(random.direction()).normalized());
    const ActiveSet::Inequality h = set.cone_half_space(k, slip);
    const Motion m = random.motion(0.01, 0.1);
    const Vector3 v = velocity(m, c.point);
    EXPECT_NEAR(h.gradient.dot(six(m, kSetMetric.gyration)), c.normal.dot(v) - c.ratio * slip.dot(v), 1e-16);
    EXPECT_DOUBLE_EQ(h.rhs, c.required_gain - c.ratio * c.shift);
    EXPECT_EQ(h.tag.row, row);
    EXPECT_EQ(h.tag.contact, k);
    EXPECT_EQ(h.tag.slip, slip);
  }
  set.close_all();
}

// -- contacts and the rows that they stand for

TEST(ContactSet, ExcludesTheRowOfAContactFromTheScanUntilItCloses) {
  Random random(5);
  SetBench bench;
  bench.push_random(random, 5);
  const std::vector<float> gains(bench.rows->required_gain, bench.rows->required_gain + 5);
  ContactSet set = bench.set();
  EXPECT_EQ(set.open(3), 0);
  EXPECT_EQ(set.open(1), 1);
  ASSERT_EQ(set.contact_count(), 2);
  const Contact& c = set.contact(0);
  EXPECT_EQ(c.row, 3u);
  EXPECT_NEAR(c.normal.norm(), 1.0, 1e-15) << "in double precision";
  EXPECT_LT((c.normal - bench.rows->normal(3)).norm(), 1e-7);
  EXPECT_EQ(c.point, bench.rows->point(3));
  EXPECT_EQ(c.required_gain, static_cast<double>(gains[3]));
  EXPECT_EQ(c.shift, 0.0);
  EXPECT_FALSE(c.slips || c.is_held);
  for (std::uint32_t row = 0; row < 5; ++row) EXPECT_EQ(bench.is_excluded(row), row == 1 || row == 3);
  // all rows are violated by a motion against their normals; the scan finds the others only
  Motion against;
  against.translation = -10.0 * bench.rows->normal(3);
  EXPECT_NE(set.most_violated(against).row, 3u);
  set.close_all();
  EXPECT_EQ(set.contact_count(), 0);
  for (std::uint32_t row = 0; row < 5; ++row) EXPECT_EQ(bench.rows->required_gain[row], gains[row]);
}

TEST(ContactSet, ClosesContactsWithoutHalfSpaceAndRenumbersTheOthers) {
  Random random(6);
  SetBench bench;
  bench.push_random(random, 6);
  const std::vector<float> gains(bench.rows->required_gain, bench.rows->required_gain + 6);
  ContactSet set = bench.set();
  for (std::uint32_t row = 0; row < 5; ++row) set.open(row);
  const Vector3 slip = set.contact(3).normal.unitOrthogonal();
  set.active().guess(set.cone_half_space(3, slip));
  set.active().guess(set.cone_half_space(1, Vector3::Zero()));
  set.active().guess(set.cone_half_space(3, -slip));
  set.close_idle();
  ASSERT_EQ(set.contact_count(), 2);
  EXPECT_EQ(set.contact(0).row, 1u);
  EXPECT_EQ(set.contact(1).row, 3u);
  for (std::uint32_t row = 0; row < 6; ++row) {
    EXPECT_EQ(bench.is_excluded(row), row == 1 || row == 3) << row;
    if (row != 1 && row != 3) {
      EXPECT_EQ(bench.rows->required_gain[row], gains[row]) << row;
    }
  }
  ASSERT_EQ(set.active().size(), 3);
  EXPECT_EQ(set.contact_of(0).row, 3u);
  EXPECT_EQ(set.contact_of(1).row, 1u);
  EXPECT_EQ(set.contact_of(2).row, 3u);
  EXPECT_EQ(set.active()[2].tag.slip, -slip);
  set.close_all();
  for (std::uint32_t row = 0; row < 6; ++row) EXPECT_EQ(bench.rows->required_gain[row], gains[row]);
}

TEST(ContactSet, LetsAContactEnterThatSlipsWithTheMotionAsLongAsThereIsRoom) {
  Random random(7);
  SetBench bench;
  bench.push_random(random, 7);
  ContactSet set = bench.set();
  const Motion m = random.motion(0.01, 0.1);
  for (int k = 0; k < 6; ++k) {
    ASSERT_TRUE(set.enter(static_cast<std::uint32_t>(6 - k), m));
    EXPECT_EQ(set.additions(), static_cast<std::uint32_t>(k + 1));
    ASSERT_EQ(set.contact_count(), k + 1);
    EXPECT_EQ(set.contact(k).row, static_cast<std::uint32_t>(6 - k));
    const Slip slip = set.slip_of(set.contact(k), m);
    EXPECT_EQ(set.active()[k].tag.slip, slip.direction);
    EXPECT_EQ(set.active()[k].tag.contact, k);
  }
  EXPECT_FALSE(set.enter(0, m));
  EXPECT_EQ(set.contact_count(), 6);
  EXPECT_EQ(set.additions(), 6u);
  EXPECT_FALSE(bench.is_excluded(0));
}

TEST(ContactSet, SolvesAgainWithTheRatiosAndShiftsOfItsContacts) {
  SetBench bench;
  bench.wanted = {{0.004, 0.0, -0.005}, Vector3::Zero()};
  bench.rows->push(0, Vector3::UnitZ(), Vector3::Zero(), 0.0);
  bench.rows->push(1, Vector3::UnitY(), Vector3::Zero(), -1.0);
  ContactSet set = bench.set();
  set.active().guess(set.cone_half_space(set.open(0), Vector3::UnitX()));
  set.active().guess(set.cone_half_space(set.open(1), Vector3::Zero()));  // would pull
  set.contact(0).ratio = 0.3;
  set.contact(0).shift = 0.002;
  set.resolve();
  // on the plane z - 0.3 x = -0.3 shift, nearest to the target: lambda (1 + mu^2) = missing
  const double missing = -0.3 * 0.002 - (-0.005 - 0.3 * 0.004);
  const double lambda = missing / 1.09;
  ASSERT_EQ(set.active().size(), 1);
  ASSERT_EQ(set.contact_count(), 1);
  EXPECT_NEAR(set.active()[0].multiplier, lambda, 1e-16);
  EXPECT_LT((set.motion().translation - Vector3(0.004 - 0.3 * lambda, 0.0, -0.005 + lambda)).norm(), 1e-16);
  EXPECT_FALSE(bench.is_excluded(1)) << "the contact that would pull is a row again";
  EXPECT_TRUE(bench.is_excluded(0));
}

TEST(ContactSet, ReturnsToASavedState) {
  Random random(8);
  SetBench bench;
  bench.push_random(random, 6);
  const std::vector<float> gains(bench.rows->required_gain, bench.rows->required_gain + 6);
  ContactSet set = bench.set();
  for (const std::uint32_t row : {4u, 2u}) ASSERT_TRUE(set.enter(row, bench.wanted));
  set.contact(1).shift = 0.125;
  set.contact(1).slips = true;
  const Vector6 z = set.active().z();
  const ContactSet::Saved saved = set.save();
  set.close_all();
  set.active().start(Vector6::Ones());
  ASSERT_TRUE(set.enter(5, bench.wanted));
  set.contact(0).shift = 1.0;
  set.restore(saved);
  ASSERT_EQ(set.contact_count(), 2);
  EXPECT_EQ(set.contact(0).row, 4u);
  EXPECT_EQ(set.contact(1).row, 2u);
  EXPECT_EQ(set.contact(1).shift, 0.125);
  EXPECT_TRUE(set.contact(1).slips);
  ASSERT_EQ(set.active().size(), 2);
  EXPECT_EQ(set.active().z(), z);
  for (std::uint32_t row = 0; row < 6; ++row) EXPECT_EQ(bench.is_excluded(row), row == 2 || row == 4) << row;
  set.close_all();
  for (std::uint32_t row = 0; row < 6; ++row) EXPECT_EQ(bench.rows->required_gain[row], gains[row]);
}

TEST(ContactSet, RestartsWithoutContactsAndInTheMetricOfTheCoupling) {
  Random random(9);
  for (const bool from_motion : {false, true}) {
    SetBench bench;
    bench.friction.viscous_step = 1.5;
    bench.push_random(random, 3);
    ContactSet set = bench.set();
    ASSERT_TRUE(set.enter(1, bench.wanted));
    set.set_viscous_metric({1.0});
    set.active().start(Vector6::Constant(0.001));
    const Vector6 here = set.plain_motion();
    from_motion ? set.restart_from_motion() : set.restart();
    EXPECT_EQ(set.contact_count(), 0);
    EXPECT_EQ(set.active().size(), 0);
    EXPECT_FALSE(bench.is_excluded(1));
    const Vector6 wanted = six(bench.wanted, kSetMetric.gyration);
    EXPECT_LT((set.plain_motion() - (from_motion ? here : wanted)).norm(), 1e-17);
    EXPECT_EQ(set.active().z(), set.plain_motion()) << "the metric without viscous friction";
    EXPECT_EQ(set.target(), wanted);
  }
}

/// In the metric H a load has the squared length load' H^-1 load. Two contacts on the plane z = 0 share a load 3 : 1,
/// and mu_v is 2: along x the metric is 1 + 2, along z it is 1. A turn about y by 1 / rho moves no point, which lie on
/// the y axis, along the plane; a turn about z by 1 / rho moves them by y / rho.
TEST(ContactSet, SharesViscousFrictionByLoad) {
  SetBench bench;
  bench.friction.viscous_step = 2.0;
  bench.rows->push(0, Vector3::UnitZ(), Vector3(0.0, 0.01, 0.0), 0.0);
  bench.rows->push(1, Vector3::UnitZ(), Vector3(0.0, -0.03, 0.0), 0.0);
  const double rho = kSetMetric.gyration;
  const double along_z = 2.0 * (0.75 * 0.01 * 0.01 + 0.25 * 0.03 * 0.03) / (rho * rho);
  const double mixed = -2.0 * (0.75 * 0.01 - 0.25 * 0.03) / rho;  // of a shift along x and a turn about z: 0
  ASSERT_NEAR(mixed, 0.0, 1e-15);
  const std::pair<Motion, double> cases[] = {{{Vector3(1.0, 0.0, 0.0), Vector3::Zero()}, 1.0 / 3.0},
                                             {{Vector3(0.0, 1.0, 0.0), Vector3::Zero()}, 1.0 / 3.0},
                                             {{Vector3(0.0, 0.0, 1.0), Vector3::Zero()}, 1.0},
                                             {{Vector3::Zero(), Vector3(0.0, 1.0 / rho, 0.0)}, 1.0},
                                             {{Vector3::Zero(), Vector3(0.0, 0.0, 1.0 / rho)}, 1.0 / (1.0 + along_z)}};
  for (const auto& [wanted, square] : cases) {
    bench.wanted = wanted;
    ContactSet set = bench.set();
    set.open(0);
    set.open(1);
    set.set_viscous_metric({3e-3, 1e-3});
    EXPECT_NEAR(set.target().squaredNorm(), square, 1e-8) << "rows are in single precision";
    set.set_viscous_metric({});
    EXPECT_NEAR(set.target().squaredNorm(), 1.0, 1e-12) << "no load, no friction";
    set.close_all();
  }
}

TEST(ContactSet, ClosesOneContactAndGivesItsNumberToTheLast) {
  Random random(10);
  SetBench bench;
  bench.push_random(random, 3);
  ContactSet set = bench.set();
  for (std::uint32_t row = 0; row < 3; ++row) set.open(row);
  set.close(0);
  ASSERT_EQ(set.contact_count(), 2);
  EXPECT_EQ(set.contact(0).row, 2u);
  EXPECT_EQ(set.contact(1).row, 1u);
  EXPECT_FALSE(bench.is_excluded(0));
  EXPECT_EQ(bench.rows->required_gain[0], -1e-3f);
  EXPECT_TRUE(bench.is_excluded(1) && bench.is_excluded(2));
  set.close(1);
  set.close(0);
  EXPECT_EQ(set.contact_count(), 0);
  EXPECT_EQ(bench.rows->required_gain[1], -2e-3f);
  EXPECT_EQ(bench.rows->required_gain[2], -3e-3f);
}

// -- forces

/// Returns the wrench of the forces in the coupling's metric.
Vector6 sum_of(const ConstrainedStep& step, double gyration) {
  Vector6 sum = Vector6::Zero();
  for (std::uint32_t j = 0; j < step.force_count; ++j) {
    const ContactForce& f = step.forces[j];
    const Vector3 drag = -f.ratio * f.slip;
    Vector6 c;
    c << f.normal + drag, (f.point.cross(f.normal) + f.grip.cross(drag)) / gyration;
    sum += f.multiplier * c;
  }
  return sum;
}

TEST(ContactForces, AreThoseOfTheHalfSpaces) {
  Random random(10);
  SetBench bench;
  bench.push_random(random, 4);
  ContactSet set = bench.set();
  ASSERT_TRUE(set.enter(0, bench.wanted));  // a contact that is no more does not matter
  set.restart();
  set.active().guess(set.row_half_space(2));
  set.active().at(0).multiplier = 0.75;
  const ContactForce plain = detail::force_of(set, 0);
  EXPECT_EQ(plain.id, 102u);
  EXPECT_EQ(plain.normal, bench.rows->normal(2));
  EXPECT_EQ(plain.point, bench.rows->point(2));
  EXPECT_EQ(plain.slip, Vector3::Zero());
  EXPECT_EQ(plain.ratio, 0.0) << "without contacts there is no friction";
  EXPECT_EQ(plain.multiplier, 0.75);
  set.restart();
  ASSERT_TRUE(set.enter(3, bench.wanted));
  ASSERT_TRUE(set.enter(1, bench.wanted));
  set.contact(1).ratio = 0.4;
  set.active().at(1).multiplier = 0.25;
  ConstrainedStep step;
  detail::take_forces(set, step);
  ASSERT_EQ(step.force_count, 2u);
  EXPECT_EQ(step.contact_count, 2u);
  EXPECT_EQ(step.forces[0].id, 103u);
  EXPECT_EQ(step.forces[0].ratio, 0.5);
  EXPECT_EQ(step.forces[1].id, 101u);
  EXPECT_EQ(step.forces[1].ratio, 0.4);
  EXPECT_EQ(step.forces[1].multiplier, 0.25);
  EXPECT_EQ(step.forces[1].slip, set.active()[1].tag.slip);
  set.close_all();
}

TEST(ContactForces, CountRowsAndLeaveOutAPoint) {
  ConstrainedStep step;
  const auto push = [&](std::uint32_t id, const Vector3& normal) {
    step.forces[step.force_count].id = id;
    step.forces[step.force_count++].normal = normal;
  };
  push(5, Vector3::UnitX());
  push(7, Vector3::UnitX());
  push(5, Vector3::UnitX());
  push(5, Vector3::UnitY());
  push(7, Vector3::UnitX());
  push(9, Vector3::UnitZ());
  detail::count_contacts(step);
  EXPECT_EQ(step.contact_count, 4u) << "point 5 twice with different normals, 7, and 9";
  detail::drop_forces(5, step);
  ASSERT_EQ(step.force_count, 3u);
  EXPECT_EQ(step.forces[0].id, 7u);
  EXPECT_EQ(step.forces[1].id, 7u);
  EXPECT_EQ(step.forces[2].id, 9u);
  EXPECT_EQ(step.contact_count, 2u);
  detail::drop_forces(1, step);
  EXPECT_EQ(step.force_count, 3u) << "no force of this point";
  detail::drop_forces(7, step);
  detail::drop_forces(9, step);
  EXPECT_EQ(step.force_count, 0u);
  EXPECT_EQ(step.contact_count, 0u);
}

ContactForce random_force(Random& random, std::uint32_t id) {
  ContactForce force;
  force.id = id;
  force.point = random.in_cube(0.05);
  force.grip = random.in_cube(0.05);
  force.normal = random.direction();
  force.slip =
      random.integer(0, 1) == 0 ? Vector3::Zero() : Vector3(force.normal.cross(random.direction()).normalized());
  force.ratio = random.between(0.0, 1.0);
  force.multiplier = random.between(0.0, 0.01);
  return force;
}

/// The forces of the step and of the set have the same sum afterwards, none pulls, and each is one of them.
TEST(CombinedForces, AreAtMostSixWithTheSameSum) {
  Random random(11);
  int merged = 0;
  for (int problem = 0; problem < 400; ++problem) {
    SetBench bench;
    bench.push_random(random, 6);
    ContactSet set = bench.set();
    const int of_set = random.integer(0, 6);
    for (int j = 0; j < of_set; ++j) {
      ASSERT_TRUE(set.enter(static_cast<std::uint32_t>(j), random.motion(0.01, 0.1)));
      set.active().at(j).multiplier = random.between(0.0, 0.01);
    }
    ConstrainedStep step;
    step.force_count = static_cast<std::uint32_t>(random.integer(0, 6));
    for (std::uint32_t j = 0; j < step.force_count; ++j) step.forces[j] = random_force(random, j);
    ConstrainedStep other;
    detail::take_forces(set, other);
    const Vector6 sum = sum_of(step, kSetMetric.gyration) + sum_of(other, kSetMetric.gyration);
    const ConstrainedStep before = step;
    detail::add_forces(set, step);
    ASSERT_LE(step.force_count, 6u);
    EXPECT_LT((sum_of(step, kSetMetric.gyration) - sum).norm(), 1e-14) << problem;
    std::uint32_t contacts = 0;
    for (std::uint32_t j = 0; j < step.force_count; ++j) {
      const ContactForce& f = step.forces[j];
      EXPECT_GE(f.multiplier, 0.0);
      bool known = false;
      for (const ConstrainedStep* from : {&before, static_cast<const ConstrainedStep*>(&other)}) {
        for (std::uint32_t i = 0; i < from->force_count; ++i) {
          const ContactForce& g = from->forces[i];
          known |= f.id == g.id && f.normal == g.normal && f.slip == g.slip && f.ratio == g.ratio && f.point == g.point;
        }
      }
      EXPECT_TRUE(known) << problem;
      ++contacts;
    }
    EXPECT_EQ(step.contact_count, contacts) << "each row has one force here";
    const std::uint32_t all = before.force_count + other.force_count;
    if (all <= 6) {
      ASSERT_EQ(step.force_count, all);
      for (std::uint32_t j = 0; j < all; ++j) {
        const ContactForce& f = j < before.force_count ? before.forces[j] : other.forces[j - before.force_count];
        EXPECT_EQ(step.forces[j].id, f.id);
        EXPECT_EQ(step.forces[j].multiplier, f.multiplier);
      }
    } else {
      ++merged;
    }
    set.close_all();
  }
  EXPECT_GT(merged, 100);
}

/// Entries behind the count do not count.
TEST(CombinedForces, AreThoseOfTheCountOnly) {
  Random random(15);
  for (std::size_t count = 0; count <= 3 * ContactSet::kMaxContacts; ++count) {
    detail::Forces all;
    for (std::uint32_t i = 0; i < 3 * ContactSet::kMaxContacts; ++i) all.add(random_force(random, i));
    all.count = count;
    Vector6 sum = Vector6::Zero();
    for (std::size_t i = 0; i < count; ++i) {
      ConstrainedStep one;
      one.force_count = 1;
      one.forces[0] = all.force[i];
      sum += sum_of(one, kSetMetric.gyration);
    }
    ConstrainedStep step;
    EXPECT_LT(detail::store_sum(all, kSetMetric.gyration, step), 1e-11) << count;
    ASSERT_LE(step.force_count, 6u);
    EXPECT_LT((sum_of(step, kSetMetric.gyration) - sum).norm(), 1e-11) << count;
    for (std::uint32_t j = 0; j < step.force_count; ++j) EXPECT_LT(step.forces[j].id, count);
  }
}

/// Forces in a plane, each turned out of it by a millionth: six of them hardly span the others.
TEST(CombinedForces, TellWhatTheirSumLacks) {
  Random random(16);
  double most = 0.0;
  for (int trial = 0; trial < 2000; ++trial) {
    detail::Forces all;
    for (std::uint32_t i = 0; i < 9; ++i) {
      ContactForce force = random_force(random, i);
      force.normal = (Vector3(0.0, 1.0, 0.5 * random.between(-1.0, 1.0)) + 1e-6 * random.in_cube(1.0)).normalized();
      force.point.x() *= 1e-6;
      force.grip = force.point;
      force.slip = Vector3::Zero();
      all.add(force);
    }
    ConstrainedStep step;
    const double lacks = detail::store_sum(all, kSetMetric.gyration, step);
    Vector6 sum = Vector6::Zero();
    for (std::size_t i = 0; i < all.count; ++i) {
      ConstrainedStep one;
      one.force_count = 1;
      one.forces[0] = all.force[i];
      sum += sum_of(one, kSetMetric.gyration);
    }
    ASSERT_NEAR((sum_of(step, kSetMetric.gyration) - sum).norm(), lacks, 1e-11) << trial;
    most = std::max(most, lacks);
  }
  EXPECT_GT(most, 1e-10) << "the test looks at nothing";
}

TEST(CombinedForces, CancelWhereTheyOpposeEachOther) {
  SetBench bench;
  bench.rows->push(0, Vector3::UnitZ(), Vector3::Zero(), 0.0);
  ContactSet set = bench.set();
  set.active().guess(set.row_half_space(0));
  set.active().at(0).multiplier = 6.0;
  ConstrainedStep step;
  for (std::uint32_t j = 0; j < 6; ++j) {
    step.forces[j] = {1 + j, Vector3::Zero(), Vector3::Zero(), -Vector3::UnitZ(), Vector3::Zero(), 0.0, 1.0};
  }
  step.force_count = 6;
  detail::add_forces(set, step);
  EXPECT_LT(sum_of(step, kSetMetric.gyration).norm(), 1e-11);
}

/// More than six forces in one plane: fewer than six give their sum.
TEST(CombinedForces, KeepTheSumOfForcesInOnePlane) {
  Random random(14);
  for (int problem = 0; problem < 50; ++problem) {
    SetBench bench;
    const auto normal = [&] {
      const double angle = random.between(-1.0, 1.0);
      return Vector3(std::sin(angle), 0.0, std::cos(angle));
    };
    for (int i = 0; i < 5; ++i) bench.rows->push(static_cast<std::uint32_t>(10 + i), normal(), Vector3::Zero(), 0.0);
    ContactSet set = bench.set();
    for (std::uint32_t j = 0; j < 5; ++j) {
      set.active().guess(set.row_half_space(j));
      set.active().at(static_cast<int>(j)).multiplier = random.between(0.0, 1.0);
    }
    ConstrainedStep step, other;
    for (std::uint32_t j = 0; j < 5; ++j) {
      step.forces[j] = {j, Vector3::Zero(), Vector3::Zero(), normal(), Vector3::Zero(), 0.0, random.between(0.0, 1.0)};
    }
    step.force_count = 5;
    detail::take_forces(set, other);
    const Vector6 sum = sum_of(step, kSetMetric.gyration) + sum_of(other, kSetMetric.gyration);
    detail::add_forces(set, step);
    EXPECT_LE(step.force_count, 2u) << "two directions span a plane";
    EXPECT_LT((sum_of(step, kSetMetric.gyration) - sum).norm(), 1e-11);
  }
}

// -- rows

TEST(MeetRows, TellsWhetherAllAreMetOrContradictEachOther) {
  SetBench bench;
  bench.wanted = {{0.0, 0.0, -0.005}, Vector3::Zero()};
  bench.rows->push(0, Vector3::UnitZ(), Vector3::Zero(), -0.001);
  {
    ContactSet set = bench.set();
    EXPECT_EQ(detail::meet_rows(set), Additions::kMet);
    EXPECT_EQ(set.additions(), 1u);
    EXPECT_NEAR(set.motion().translation.z(), -0.001, 1e-10);
  }
  bench.rows->push(1, -Vector3::UnitZ(), Vector3::Zero(), 0.002);
  ContactSet set = bench.set();
  EXPECT_EQ(detail::meet_rows(set), Additions::kContradictory);
}

/// The scan is in single precision. Far from the origin it sees an active row violated by more than the tolerance.
TEST(MeetRows, AddsNoActiveRowAgain) {
  Random random(12);
  for (int problem = 0; problem < 50; ++problem) {
    SetBench bench;
    bench.rows->push(0, random.direction(), random.in_cube(0.03), 0.0);
    bench.wanted = {1e5 * random.direction(), Vector3::Zero()};
    ContactSet set = bench.set();
    EXPECT_EQ(detail::meet_rows(set), Additions::kMet) << problem;
    EXPECT_LE(set.additions(), 1u) << problem;
    EXPECT_LE(set.active().size(), 1) << problem;
  }
}

}  // namespace
}  // namespace godobject::test::contact_set_test
