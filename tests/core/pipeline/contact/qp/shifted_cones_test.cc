// The convex problem with fixed shifts: cases that can be computed by hand, and a slow projection of each force on its
// cone.

#include "core/pipeline/contact/qp/shifted_cones.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/pipeline/contact/qp/contact_forces.h"
#include "core/pipeline/contact/qp/contact_set.h"
#include "tests/support/random.h"
#include "tests/support/slow_projection.h"

namespace godobject::test::shifted_cones_test {
namespace {

using detail::Additions;
using detail::ContactSet;
using detail::Shift;

const CouplingMetric kConeMetric;

struct ConeBench {
  std::unique_ptr<ContactRows> rows = std::make_unique<ContactRows>();
  Motion wanted;
  ContactFriction friction{0.5, 0.25, 0.0};
  Motion last;
  WorkMeter work;

  ContactSet set() { return {*rows, wanted, kConeMetric, &friction, last, work}; }
  void push(const Vector3& normal, const Vector3& point, double gain) { rows->push(rows->count, normal, point, gain); }
};

SixVector six_vector(const Motion& m) {
  SixVector z;
  z << m.translation, kConeMetric.gyration * m.rotation;
  return z;
}

/// Returns the motion nearest to `target` with n . v >= required gain + ratio |slip| at all contacts: each force in
/// turn is projected on its cone. `residual`: the change of a force in the last sweep.
SixVector nearest_in_cones(const SixVector& target, const std::vector<SlowContact>& contacts, double ratio,
                           double& residual) {
  SixVector z = target;
  std::vector<Vector3> forces(contacts.size(), Vector3::Zero());
  for (int sweep = 0; sweep < 20000; ++sweep) {
    residual = 0.0;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const SlowContact& c = contacts[i];
      const double step = 0.9 / (c.velocity * c.velocity.transpose()).trace();
      const Vector3 moved = forces[i] - step * (c.velocity * z - c.required_gain * c.normal);
      const Vector3 change = on_cone(moved, c.normal, ratio) - forces[i];
      forces[i] += change;
      z += c.velocity.transpose() * change;
      residual = std::max(residual, change.norm());
    }
    if (residual < 1e-14) break;
  }
  return z;
}

TEST(MeetCones, ProjectsOnAConeAsGeometryDoes) {
  // one point at the origin: v = x. The cone n . x >= 0.5 |slip|
  for (const double drag : {0.0, 0.001, 0.002, 0.004, 0.009, 0.02, 0.1}) {
    for (const double press : {-0.01, 0.0, 0.01}) {
      ConeBench bench;
      bench.push(Vector3::UnitZ(), Vector3::Zero(), 0.0);
      bench.wanted.translation = Vector3(0.6 * drag, 0.8 * drag, -press);
      ContactSet set = bench.set();
      ASSERT_EQ(detail::meet_cones(Shift::kNone, set), Additions::kMet);
      Vector3 expected = bench.wanted.translation;         // inside of the cone
      if (press > 0.0) {                                   // the row is violated, so that the point is a contact
        const double along = (drag - 0.5 * press) / 1.25;  // on the cone's ray (1, 0.5) / |(1, 0.5)|
        expected = drag <= 0.5 * press ? Vector3::Zero().eval() : Vector3(along * Vector3(0.6, 0.8, 0.5));
      }
      EXPECT_LT((set.motion().translation - expected).norm(), 1e-8) << drag << ' ' << press;
      set.close_all();
    }
  }
}

/// With the shift of its slip, a contact that enters opens no gap: the cone's tip lies below the plane.
TEST(MeetCones, ShiftsTheConeOfAContactThatEntersByItsSlip) {
  ConeBench bench;
  bench.push(Vector3::UnitZ(), Vector3::Zero(), 0.0);
  bench.wanted.translation = Vector3(0.01, 0.0, -0.001);
  ContactSet set = bench.set();
  ASSERT_EQ(detail::meet_cones(Shift::kSlip, set), Additions::kMet);
  ASSERT_EQ(set.contact_count(), 1);
  EXPECT_NEAR(set.contact(0).shift, 0.01, 1e-15);
  // nearest point of the ray z = 0.5 (x - 0.01)
  const double lambda = 0.001 / 1.25;
  EXPECT_LT((set.motion().translation - Vector3(0.01 - 0.5 * lambda, 0.0, -0.001 + lambda)).norm(), 1e-9);
  set.close_all();
}

TEST(MeetCones, FindsTheProjectionOfForcesOnTheirCones) {
  Random random(21);
  int compared = 0;
  for (int problem = 0; problem < 60; ++problem) {
    ConeBench bench;
    const int count = 1 + problem % 6;
    for (int i = 0; i < count; ++i) {
      // normals about +z, so that a motion inside of all cones exists
      bench.push((Vector3::UnitZ() + 0.3 * random.in_cube(1.0)).normalized(), random.in_cube(0.03),
                 random.between(-5e-4, 0.0));
    }
    bench.wanted = random.motion(0.005, 0.05);
    bench.wanted.translation.z() = -0.003;
    ContactSet set = bench.set();
    const Additions ended = detail::meet_cones(Shift::kNone, set);
    const SixVector found = six_vector(set.motion());
    std::vector<SlowContact> contacts;  // rows that the motion does not bring to the surface are no contacts
    for (int k = 0; k < set.contact_count(); ++k) {
      contacts.push_back(slow_contacts(*bench.rows, kConeMetric.gyration)[set.contact(k).row]);
      contacts.back().required_gain = set.contact(k).required_gain;
    }
    set.close_all();
    double residual = 0.0;
    const SixVector slow = nearest_in_cones(six_vector(bench.wanted), contacts, 0.5, residual);
    if (ended != Additions::kMet || residual > 1e-13) continue;
    ++compared;
    const double here = (found - six_vector(bench.wanted)).norm(), there = (slow - six_vector(bench.wanted)).norm();
    EXPECT_NEAR(here, there, 1e-7) << problem;
    EXPECT_LT((found - slow).norm(), 2e-5) << problem;
  }
  EXPECT_GT(compared, 40);
}

TEST(MeetCones, TellsThatConesContradictEachOther) {
  ConeBench bench;
  bench.push(Vector3::UnitZ(), Vector3::Zero(), 0.001);
  bench.push(-Vector3::UnitZ(), Vector3::Zero(), 0.001);
  ContactSet set = bench.set();
  EXPECT_EQ(detail::meet_cones(Shift::kNone, set), Additions::kContradictory);
  EXPECT_LE(set.contact_count(), 1) << "a contact without half space is closed";
  set.close_all();
  EXPECT_EQ(bench.rows->required_gain[0], 0.001f);
  EXPECT_EQ(bench.rows->required_gain[1], 0.001f);
}

TEST(MeetCones, TellsThatTheAdditionsAreUsedUp) {
  // A cone has no corner where the nearest motion slips on it in a generic direction: each half space brings the slip
  // nearer, so that a limit of the tolerance needs some of them. A box of cones needs more than there are.
  Random random(22);
  int exhausted = 0;
  for (int problem = 0; problem < 300; ++problem) {
    ConeBench bench;
    bench.friction = {1.5, 1.5, 0.0};
    for (int i = 0; i < 3 + problem % 5; ++i) {
      bench.push((Vector3::UnitZ() + 2.0 * random.in_cube(1.0)).normalized(), random.in_cube(0.03), 0.0);
    }
    bench.wanted = random.motion(0.02, 0.3);
    ContactSet set = bench.set();
    const bool is_exhausted = detail::meet_cones(Shift::kNone, set) == Additions::kExhausted;
    exhausted += is_exhausted ? 1 : 0;
    EXPECT_TRUE(!is_exhausted || set.additions() == static_cast<std::uint32_t>(detail::kMostConeAdditions));
    EXPECT_LE(set.additions(), static_cast<std::uint32_t>(detail::kMostConeAdditions));
    set.close_all();
  }
  EXPECT_GT(exhausted, 5);
}

// -- rest

TEST(Sticks, TellsWhetherForcesInTheConesHoldTheBody) {
  for (const double share : {0.0, 0.5, 0.99, 1.01, 2.0}) {
    ConeBench bench;
    bench.push(Vector3::UnitZ(), Vector3::Zero(), 0.0);
    bench.wanted.translation = Vector3(0.5 * 0.004 * share, 0.0, -0.004);
    ContactSet set = bench.set();
    ASSERT_TRUE(set.enter(0, bench.wanted));
    set.contact(0).shift = 1e-4;  // of no importance
    EXPECT_EQ(detail::sticks(set), share < 1.0) << share;
    if (share < 1.0) {
      EXPECT_LT(six_vector(set.motion()).norm(), 1e-9);
      EXPECT_EQ(set.contact(0).shift, 0.0);
    }
    set.close_all();
  }
}

/// The body turns about a point that sticks, until a face of the workspace stops its origin, which slides along the
/// face. By hand, with the point as far away as the radius of gyration: the load and the friction force are 1 mm.
TEST(Sticks, LetsAFaceOfTheWorkspaceSlide) {
  const double L = kConeMetric.gyration;
  ConeBench bench;
  bench.friction = {2.0, 2.0, 0.0};
  bench.push(Vector3::UnitZ(), Vector3(0.0, L, 0.0), 0.0);
  bench.rows->push(kFaceOfWorkspace, -Vector3::UnitX(), Vector3::Zero(), -0.001);
  bench.wanted = {Vector3(0.002, 0.0, -0.002), Vector3(0.0, 0.0, 0.002 / L)};
  ContactSet set = bench.set();
  ASSERT_TRUE(set.enter(0, Motion{}));
  EXPECT_TRUE(detail::sticks(set));
  EXPECT_NEAR(set.motion().translation.x(), 0.001, 1e-8);
  EXPECT_NEAR(set.motion().translation.z(), -0.001, 1e-8);
  EXPECT_NEAR(set.motion().rotation.z(), 0.001 / L, 1e-7);
  set.close_all();
}

/// A second row is violated by the rest of the first contact: it becomes a contact, too.
TEST(Sticks, HoldsTheBodyAtRowsThatWereNotYetContacts) {
  ConeBench bench;
  for (const double x : {-0.02, 0.02}) bench.push(Vector3::UnitZ(), Vector3(x, 0.0, 0.0), 0.0);
  for (const double y : {-0.02, 0.02}) bench.push(Vector3::UnitZ(), Vector3(0.0, y, 0.0), 0.0);
  bench.wanted.translation = Vector3(0.0005, 0.0, -0.004);
  ContactSet set = bench.set();
  ASSERT_TRUE(set.enter(0, bench.wanted));
  EXPECT_TRUE(detail::sticks(set));
  EXPECT_GT(set.contact_count(), 1);
  EXPECT_LT(six_vector(set.motion()).norm(), 1e-8);
  set.close_all();
}

TEST(Sticks, DoesNotHoldABodyThatAGapLetsApproach) {
  ConeBench bench;
  bench.push(Vector3::UnitZ(), Vector3::Zero(), -0.001);
  bench.wanted.translation = Vector3(0.0, 0.0, -0.004);
  ContactSet set = bench.set();
  ASSERT_TRUE(set.enter(0, bench.wanted));
  EXPECT_TRUE(detail::sticks(set)) << "without slip";
  EXPECT_NEAR(set.motion().translation.z(), -0.001, 1e-9);
  EXPECT_FALSE(detail::rests(set)) << "the motion exceeds the tolerance";
  set.close_all();
}

/// With the last addition the rows may be met. A locked body among many rows, of which rest meets all; every slip
/// counts as rest.
TEST(Sticks, TellsByTheMotionAfterTheLastAddition) {
  const CouplingMetric all_is_still{.gyration = 0.158, .tolerance = 1e-8, .still = 1.0};
  Random random(23);
  int with_the_last = 0;
  for (int problem = 0; problem < 150; ++problem) {
    ConeBench bench;
    for (int i = 0; i < 800; ++i) bench.push(random.direction(), random.in_cube(0.15), random.between(-1e-5, 0.0));
    bench.wanted = {0.1 * random.direction(), random.direction()};
    ContactSet set(*bench.rows, bench.wanted, all_is_still, &bench.friction, bench.last, bench.work);
    const bool holds = detail::sticks(set);
    const Motion m = set.motion();
    set.close_all();
    double violation = 0.0;
    for (std::uint32_t i = 0; i < bench.rows->count; ++i) {
      const double moved = bench.rows->normal(i).dot(m.translation + m.rotation.cross(bench.rows->point(i)));
      violation = std::max(violation, static_cast<double>(bench.rows->required_gain[i]) - moved);
    }
    if (violation < 0.9 * all_is_still.tolerance) {
      EXPECT_TRUE(holds) << problem;
    }
    if (violation > 1.1 * all_is_still.tolerance) {
      EXPECT_FALSE(holds) << problem;
    }
    with_the_last += holds && set.additions() == static_cast<std::uint32_t>(detail::kMostConeAdditions) ? 1 : 0;
  }
  EXPECT_GT(with_the_last, 0);
}

/// A body is held only if no row and no contact is violated, also after the last addition of the method.
TEST(Sticks, HoldsOnlyWhereAllContactsAreMet) {
  const CouplingMetric metric{.gyration = 0.158, .tolerance = 1e-8, .still = 1e-6};
  Random random(35);
  int held = 0;
  for (int problem = 0; problem < 700; ++problem) {
    ConeBench bench;
    for (int i = 0; i < 300; ++i) bench.push(random.direction(), random.in_cube(0.15), random.between(-1e-5, 0.0));
    bench.wanted = {0.1 * random.direction(), random.direction()};
    ContactSet set(*bench.rows, bench.wanted, metric, &bench.friction, bench.last, bench.work);
    const bool holds = detail::sticks(set);
    const Motion m = set.motion();
    set.close_all();
    if (!holds) continue;
    ++held;
    EXPECT_EQ(bench.rows->most_violated(m, 1.1 * metric.tolerance).row, ContactRows::kNone) << problem;
  }
  EXPECT_GT(held, 0);
}

TEST(Rests, NeedsAContactAndAMotionWithinTheTolerance) {
  ConeBench bench;
  bench.push(Vector3::UnitZ(), Vector3::Zero(), 0.0);
  const auto rests_at = [&](const Vector3& x, bool with_contact) {
    ContactSet set = bench.set();
    if (with_contact) {
      EXPECT_TRUE(set.enter(0, {}));
    }
    Vector6 z = Vector6::Zero();
    z.head<3>() = x;
    set.active().start(z);
    const bool rests = detail::rests(set);
    set.close_all();
    return rests;
  };
  EXPECT_TRUE(rests_at(Vector3::Zero(), true));
  EXPECT_FALSE(rests_at(Vector3::Zero(), false));
  EXPECT_TRUE(rests_at({0.0, 0.0, 0.99 * kConeMetric.tolerance}, true));
  EXPECT_FALSE(rests_at({0.0, 0.0, 1.01 * kConeMetric.tolerance}, true));
  EXPECT_TRUE(rests_at({0.99 * kConeMetric.still, 0.0, 0.0}, true));
  EXPECT_FALSE(rests_at({1.01 * kConeMetric.still, 0.0, 0.0}, true)) << "a slip";
}

/// The body may rest if the loaded points slipped by less than a fiftieth of the motion that friction prevented.
TEST(Crawls, ComparesTheSlipWithTheMotionThatFrictionPrevented) {
  ConeBench bench;
  const double limit = kConeMetric.still + 0.02 * 0.25 * 0.004;
  for (const double share : {0.0, 0.99, 1.01, 3.0}) {
    ConstrainedStep step;
    step.force_count = 2;
    step.forces[0] = {0,    Vector3(0.0, 0.0, 0.0), Vector3(0.0, 0.0, 0.0), Vector3::UnitZ(), Vector3::Zero(), 0.25,
                      0.004};
    step.forces[1] = {1,    Vector3(0.01, 0.0, 0.0), Vector3(0.01, 0.0, 0.0), Vector3::UnitZ(), Vector3::Zero(), 0.25,
                      0.004};
    bench.last = {Vector3(0.0, 0.0, 5.0), Vector3(0.0, 0.0, share * limit / 0.01)};  // the second point slips
    ContactSet set = bench.set();
    EXPECT_EQ(detail::crawls(set, step), share < 1.0) << share;
    step.force_count = 1;
    EXPECT_TRUE(detail::crawls(set, step)) << "the first point does not slip";
    // the turn takes back the translation of the second point, not that of the first
    step.force_count = 2;
    bench.last = {Vector3(0.0, -0.001, 0.0), Vector3(0.0, 0.0, 0.1)};
    EXPECT_FALSE(detail::crawls(set, step));
    std::swap(step.forces[0], step.forces[1]);
    step.force_count = 1;
    EXPECT_TRUE(detail::crawls(set, step));
    bench.last.rotation = -bench.last.rotation;
    EXPECT_FALSE(detail::crawls(set, step));
    std::swap(step.forces[0], step.forces[1]);
    step.force_count = 0;
    EXPECT_TRUE(detail::crawls(set, step));
  }
}

TEST(ComeToRest, ReplacesACreepThatTheConesCanHold) {
  for (const bool can_hold : {true, false}) {
    ConeBench bench;
    bench.push(Vector3::UnitZ(), Vector3::Zero(), 0.0);
    const double creep = 2.0 * kConeMetric.still;
    // a drag just above or below mu_s times the load, as if the contact slipped with the kinetic ratio
    bench.wanted.translation = Vector3((can_hold ? 0.3 : 0.7) * 0.004, 0.0, -0.004);
    ContactSet set = bench.set();
    ASSERT_TRUE(set.enter(0, bench.wanted));
    set.contact(0).slips = true;
    Vector6 z = Vector6::Zero();
    z.x() = creep;
    set.active().start(set.target());
    ASSERT_TRUE(set.active().guess(set.cone_half_space(0, Vector3::UnitX())));
    // the ratio with which exactly this creep remains
    set.contact(0).ratio = (bench.wanted.translation.x() - creep) / 0.004;
    set.contact(0).shift = creep;
    set.resolve();
    ASSERT_NEAR(set.motion().translation.x(), creep, 1e-12);
    ASSERT_NEAR(set.motion().translation.z(), 0.0, 1e-12);
    const double ratio = set.contact(0).ratio;
    set.contact(0).ratio = 0.5;
    detail::come_to_rest(set);
    EXPECT_EQ(detail::rests(set), can_hold);
    if (!can_hold) {
      EXPECT_NEAR(set.motion().translation.x(), creep, 1e-12) << "the set is as it was";
      EXPECT_EQ(set.contact(0).shift, creep);
    }
    static_cast<void>(ratio);
    set.close_all();
  }
}

/// A point whose lost gap the cone regains sticks at the height of the gap. It rests there only if that is a motion
/// within the tolerance; otherwise the set stays as it was. All lengths over the tolerance.
TEST(ComeToRest, NeedsAHeldMotionWithinTheToleranceToo) {
  const double unit = kConeMetric.tolerance;
  const Vector3 creeping(-0.3, 0.0, 0.2);
  for (const double gap : {0.0, 0.5, 0.95, 1.05, 2.0}) {
    ConeBench bench;
    bench.push(Vector3::UnitZ(), Vector3::Zero(), gap * unit);
    bench.wanted.translation = unit * Vector3(0.3, 0.0, -1.0);
    ContactSet set = bench.set();
    const int k = set.open(0);
    ASSERT_TRUE(set.active().guess(set.cone_half_space(k, Vector3::UnitX())));
    // the half space z - 0.5 x >= gap - 0.5 shift turns the wanted motion into the creep, by 1.2 of (-0.5, 1)
    const double shift = 2.0 * (gap - 0.35) * unit;
    set.contact(k).shift = shift;
    set.resolve();
    ASSERT_LT((set.motion().translation - unit * creeping).norm(), 1e-6 * unit);
    const Vector6 before = set.plain_motion();
    detail::come_to_rest(set);
    ASSERT_EQ(set.contact_count(), 1);
    EXPECT_EQ(detail::rests(set), gap < 1.0) << gap;
    if (gap < 1.0) {
      EXPECT_LT((set.motion().translation - unit * Vector3(0.0, 0.0, gap)).norm(), 0.05 * unit) << gap;
    } else {
      EXPECT_EQ(set.plain_motion(), before) << gap;
      EXPECT_EQ(set.contact(0).shift, shift) << gap;
    }
    set.close_all();
  }
}

TEST(ComeToRest, LeavesAMotionThatIsLongerThanTheTolerance) {
  ConeBench bench;
  bench.push(Vector3::UnitZ(), Vector3::Zero(), 0.0);
  bench.wanted.translation = Vector3(0.001, 0.0, -0.004);  // inside of the cone
  ContactSet set = bench.set();
  ASSERT_TRUE(set.enter(0, bench.wanted));
  Vector6 z = Vector6::Zero();
  z.x() = 1.01 * kConeMetric.tolerance;
  set.active().start(z);
  detail::come_to_rest(set);
  EXPECT_EQ(set.active().z(), z);
  set.close_all();
  detail::come_to_rest(set);
  EXPECT_EQ(set.active().z(), z) << "without contacts";
}

}  // namespace
}  // namespace godobject::test::shifted_cones_test
