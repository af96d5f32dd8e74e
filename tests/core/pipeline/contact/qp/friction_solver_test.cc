// The warm start with friction, and the number of failures and additions in series of problems.

#include "core/pipeline/contact/qp/friction_solver.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "core/pipeline/contact/qp/contact_set.h"
#include "tests/support/random.h"

namespace godobject::test::friction_solver_test {
namespace {

using detail::ContactSet;

const CouplingMetric kMetric;
constexpr double kBody = 0.03;

struct Problem {
  std::unique_ptr<ContactRows> rows = std::make_unique<ContactRows>();
  Motion wanted, last;
  ContactFriction friction{0.5, 0.25, 0.0};
  CouplingMetric metric;
  WorkMeter work;

  void push(const Vector3& normal, const Vector3& point, double gain) { rows->push(rows->count, normal, point, gain); }

  ContactSet set() { return {*rows, wanted, metric, &friction, last, work}; }
  void solve(ConstrainedStep& step) { least_constraint(*rows, wanted, metric, &friction, last, work, step); }
};

Vector6 six(const Motion& m, const CouplingMetric& metric = kMetric) {
  Vector6 z;
  z << m.translation, metric.gyration * m.rotation;
  return z;
}

// -- warm start

/// The forces of the last step become half spaces of the same contacts; a force along a turned normal stays across it.
TEST(GuessCone, StartsFromTheLastForce) {
  Random random(1);
  for (int trial = 0; trial < 100; ++trial) {
    Problem p;
    for (int i = 0; i < 3; ++i) p.push(random.direction(), random.in_cube(kBody), -1e-3 * i);
    p.last = random.motion(1e-3, 0.01);
    ContactSet set = p.set();
    const Vector3 old_normal = (p.rows->normal(1) + 0.2 * random.in_cube(1.0)).normalized();
    ContactForce force;
    force.normal = old_normal;
    force.slip = old_normal.cross(random.direction()).normalized();
    detail::guess_cone(1, force, set);
    detail::guess_cone(1, {.slip = -force.slip}, set);
    detail::guess_cone(2, {}, set);
    ASSERT_EQ(set.contact_count(), 2) << "one contact a row";
    ASSERT_EQ(set.active().size(), 3);
    EXPECT_EQ(set.contact(0).row, 1u);
    EXPECT_EQ(set.contact(1).row, 2u);
    EXPECT_EQ(p.rows->required_gain[1], -FLT_MAX);
    const detail::Slip slip = set.slip_of(set.contact(0), p.last);
    EXPECT_EQ(set.contact(0).shift, slip.speed) << "the shift is the slip of the last motion";
    EXPECT_EQ(set.contact(0).ratio, slip.speed > kMetric.still ? 0.25 : 0.5);
    const Vector3 d = set.active()[0].tag.slip;
    EXPECT_NEAR(d.norm(), 1.0, 1e-12);
    EXPECT_NEAR(d.dot(set.contact(0).normal), 0.0, 1e-12);
    EXPECT_GT(d.dot(force.slip), 0.8);
    EXPECT_LT((set.active()[1].tag.slip + d).norm(), 1e-12);
    EXPECT_EQ(set.active()[2].tag.slip, Vector3::Zero()) << "a force without friction";
    EXPECT_EQ(set.active()[1].tag.contact, 0);
    EXPECT_EQ(set.active()[2].tag.contact, 1);
    set.close_all();
  }
}

/// A row whose contact has closed is opened again; the closed contact does not count.
TEST(GuessCone, OpensARowThatHasClosed) {
  Random random(2);
  Problem p;
  for (int i = 0; i < 2; ++i) p.push(random.direction(), random.in_cube(kBody), 0.0);
  ContactSet set = p.set();
  set.open(0);
  set.open(1);
  set.close(1);
  set.close(0);
  ASSERT_EQ(set.contact_count(), 0);
  detail::guess_cone(0, {}, set);
  EXPECT_EQ(set.contact_count(), 1);
  EXPECT_EQ(p.rows->required_gain[0], -FLT_MAX);
}

/// A slip that points out of the new surface is of no use: the guess is the normal alone.
TEST(GuessCone, ForgetsADirectionThatTheSurfaceHasTurnedAwayFrom) {
  Problem p;
  p.push(Vector3::UnitZ(), Vector3::Zero(), 0.0);
  for (const double angle : {0.0, 0.3, 1.0, 1.1, 1.5}) {
    ContactSet set = p.set();
    detail::guess_cone(0, {.slip = {std::cos(angle), 0.0, std::sin(angle)}}, set);
    const Vector3 expected = (std::cos(angle) > 0.5 ? 1.0 : 0.0) * Vector3::UnitX();
    EXPECT_LT((set.active()[0].tag.slip - expected).norm(), 1e-12) << angle;
    set.close_all();
  }
}

/// Solved again from its own result, a problem needs nothing new, at rest and in motion.
TEST(SolveWithFriction, NeedsNothingNewFromItsOwnResult) {
  Random random(2);
  int compared = 0, again = 0;
  for (int trial = 0; trial < 300; ++trial) {
    Problem p;
    const double mu = random.between(0.05, 0.6);
    p.friction = {mu, mu, 0.0};
    for (int i = 0; i < 4; ++i)
      p.push(Vector3::UnitZ(), {random.between(-kBody, kBody), random.between(-kBody, kBody), -kBody}, 0.0);
    p.wanted = {{random.between(-0.005, 0.005), random.between(-0.005, 0.005), -0.005}, 0.05 * random.in_cube(1.0)};
    ConstrainedStep step;
    p.solve(step);
    if (step.unconverged || step.force_count == 0) continue;
    ++compared;
    p.last = step.motion;
    ConstrainedStep warm = step;
    p.solve(warm);
    again += warm.iterations > 0 ? 1 : 0;
    EXPECT_FALSE(warm.unconverged);
    EXPECT_LT((six(warm.motion) - six(step.motion)).norm(), 5.0 * kMetric.tolerance) << trial;
  }
  std::printf("[ measured ] %d of %d needed an addition\n", again, compared);
  EXPECT_GT(compared, 200);
  EXPECT_LE(again, compared / 10);
}

/// Flags and forces of an earlier step do not matter.
TEST(SolveWithFriction, SetsAllFlagsOfTheStep) {
  for (const bool with_friction : {true, false}) {
    for (const double z : {-0.005, 0.005}) {
      for (const bool with_rows : {true, false}) {
        Problem p;
        if (with_rows) p.push(Vector3::UnitZ(), Vector3::Zero(), 0.0);
        p.wanted.translation = Vector3(0.0, 0.0, z);
        ConstrainedStep step;
        step.force_count = step.contact_count = 3;
        for (std::uint32_t j = 0; j < 3; ++j)
          step.forces[j] = {9 + j, Vector3::Zero(), Vector3::Zero(), Vector3::UnitZ(), Vector3::Zero(), 0.5, 1.0};
        step.iterations = 77;
        step.follows = step.infeasible = step.unconverged = true;
        least_constraint(*p.rows, p.wanted, kMetric, with_friction ? &p.friction : nullptr, p.last, p.work, step);
        const bool touches = with_rows && z < 0.0;
        EXPECT_EQ(step.force_count, touches ? 1u : 0u);
        EXPECT_EQ(step.contact_count, touches ? 1u : 0u);
        EXPECT_EQ(step.iterations, touches ? 1u : 0u);
        EXPECT_EQ(step.follows, !touches);
        EXPECT_FALSE(step.infeasible);
        EXPECT_FALSE(step.unconverged);
        EXPECT_EQ(step.motion.translation.z(), touches ? 0.0 : z);
      }
    }
  }
}

TEST(ConstrainedStep, StartsEmptyCopiesAllAndReleasesItsForces) {
  const ConstrainedStep empty;
  EXPECT_EQ(empty.force_count + empty.contact_count + empty.iterations, 0u);
  EXPECT_FALSE(empty.follows || empty.infeasible || empty.unconverged);
  EXPECT_EQ(ContactForce{}.id, 0u);
  EXPECT_EQ(ContactForce{}.ratio, 0.0);
  EXPECT_EQ(ContactForce{}.multiplier, 0.0);
  const ContactFriction none;
  EXPECT_EQ(none.static_ratio + none.kinetic_ratio + none.viscous_step, 0.0);
  for (unsigned flags = 0; flags < 8; ++flags) {
    ConstrainedStep step;
    step.motion = {Vector3(1.0, 2.0, 3.0), Vector3(4.0, 5.0, 6.0)};
    step.force_count = 5;
    for (std::uint32_t j = 0; j < 5; ++j) step.forces[j].id = 40 + j;
    step.contact_count = 4;
    step.iterations = 17;
    step.follows = (flags & 1) != 0;
    step.infeasible = (flags & 2) != 0;
    step.unconverged = (flags & 4) != 0;
    ConstrainedStep copy;
    copy.forces[5].id = 99;
    copy.follows = !step.follows;
    copy.infeasible = !step.infeasible;
    copy.unconverged = !step.unconverged;
    copy = step;
    EXPECT_EQ(copy.motion.translation, step.motion.translation);
    EXPECT_EQ(copy.motion.rotation, step.motion.rotation);
    EXPECT_EQ(copy.force_count, 5u);
    for (std::uint32_t j = 0; j < 5; ++j) EXPECT_EQ(copy.forces[j].id, 40 + j);
    EXPECT_EQ(copy.forces[5].id, 99u) << "only the active forces";
    EXPECT_EQ(copy.contact_count, 4u);
    EXPECT_EQ(copy.iterations, 17u);
    EXPECT_EQ(copy.follows, step.follows);
    EXPECT_EQ(copy.infeasible, step.infeasible);
    EXPECT_EQ(copy.unconverged, step.unconverged);
    copy.release();
    EXPECT_EQ(copy.force_count + copy.contact_count + copy.iterations, 0u);
    EXPECT_TRUE(copy.follows);
    EXPECT_FALSE(copy.infeasible || copy.unconverged);
    EXPECT_EQ(copy.motion.translation, step.motion.translation);
  }
}

// -- where Coulomb's law is not solved

/// A point in a groove of 33 degrees, both sides of which have lost their gap. Any motion out of the groove slips on
/// both sides, where friction takes more than the sides push: the law has no solution. The result is the motion without
/// friction, which is the nearest that regains both gaps.
TEST(SolveWithFriction, LeadsOutOfAGrooveInWhichFrictionJams) {
  constexpr double kLost = 1e-4, kSine = 0.28, kCosine = 0.96;  // of half the angle of the groove
  for (const double ratio : {0.5, 1.0, 2.0}) {
    for (const Vector3& wanted :
         {Vector3(0.0, 2e-4, 0.0), Vector3(-1e-4, 1e-4, 0.0), Vector3(0.0, 1e-4, 1e-4), Vector3(0.0, 1e-4, -5e-5)}) {
      Problem p;
      p.friction = {ratio, ratio, 0.0};
      p.push({kSine, 0.0, kCosine}, Vector3::Zero(), kLost);
      p.push({kSine, 0.0, -kCosine}, Vector3::Zero(), kLost);
      p.wanted.translation = wanted;
      ConstrainedStep step;
      p.solve(step);
      EXPECT_TRUE(step.unconverged) << ratio << ' ' << wanted.transpose();
      EXPECT_FALSE(step.infeasible) << ratio << ' ' << wanted.transpose();
      const Vector3 expected(kLost / kSine, wanted.y(), 0.0);
      EXPECT_LT((step.motion.translation - expected).norm(), 1e-8) << ratio << ' ' << wanted.transpose();
      EXPECT_LT(step.motion.rotation.norm(), 1e-8) << ratio << ' ' << wanted.transpose();
    }
  }
}

/// A face that slid in the last cycle and has lost its gap. It may stick at three points and more; Newton's method has
/// no room for their forces, and with viscous friction the smoothing method has none. Solved or not: the rows are met
/// and stay as they were. Without a solution the motion leads no farther from the wanted one than rest or than the
/// motion without friction does.
TEST(SolveWithFriction, LiftsAFaceThatSlid) {
  Random random(51);
  for (int trial = 0; trial < 500; ++trial) {
    Problem p;
    const double ratio = random.between(1.0, 2.0);
    p.friction = {ratio, ratio, 1.0};
    for (int i = 0; i < 4; ++i)
      p.push(Vector3::UnitZ(), {random.between(-kBody, kBody), random.between(-kBody, kBody), -kBody}, 1e-4);
    p.wanted = {random.in_cube(1e-5), random.in_cube(1e-4)};
    p.last.translation.x() = 1e-4;
    ConstrainedStep step;
    step.force_count = step.contact_count = 1;
    step.forces[0].id = 99;  // of a point that is near no more
    step.forces[0].normal = Vector3::UnitZ();
    p.solve(step);
    ASSERT_FALSE(step.infeasible) << trial;
    for (std::uint32_t i = 0; i < p.rows->count; ++i) {
      ASSERT_EQ(p.rows->required_gain[i], 1e-4f) << trial;
      const Vector3 v = step.motion.translation + step.motion.rotation.cross(p.rows->point(i));
      ASSERT_GE(v.z(), 1e-4 - 1.5 * kMetric.tolerance) << trial;
    }
    if (!step.unconverged) continue;
    ConstrainedStep slippery;
    least_constraint(*p.rows, p.wanted, kMetric, nullptr, p.last, p.work, slippery);
    const auto reach = [&p](const Motion& m) { return (six(m) - six(p.wanted)).norm(); };
    ASSERT_LE(reach(step.motion), std::max(1.0006 * reach({}), reach(slippery.motion) + kMetric.tolerance)) << trial;
  }
}

/// A peg that slid comes to rest where friction can hold it: points on opposite sides, with forces inside their cones.
/// A motion within the tolerance is no slow creep, but rest to the last bit.
TEST(SolveWithFriction, BringsAPegToRestThatSlid) {
  Random random(52);
  int at_rest = 0, creeps = 0;
  for (int trial = 0; trial < 300; ++trial) {
    Problem p;
    const double ratio = random.between(0.1, 0.8);
    p.friction = {1.1 * ratio, ratio, 0.0};
    p.last = random.motion(1e-3, 0.1);
    ConstrainedStep step;
    Vector3 force = Vector3::Zero(), torque = Vector3::Zero();
    const std::uint32_t loaded = 2 + static_cast<std::uint32_t>(trial % 4);
    for (std::uint32_t i = 0; i < loaded; ++i) {
      const double side = i % 2 == 0 ? 1.0 : -1.0;
      const Vector3 point(random.between(-0.004, 0.004), 0.004 * side, random.between(-0.01, 0.01));
      const Vector3 normal = (Vector3(0.0, -side, 0.0) + 1e-3 * random.in_cube(1.0)).normalized();
      p.push(normal, point, 0.0);
      const double load = std::pow(10.0, random.between(-4.0, -2.0));
      const Vector3 push = load * (normal + 0.9 * ratio * normal.cross(random.direction()));
      force += push;
      torque += point.cross(push);
      step.forces[i] = {i, point, point, normal, normal.cross(random.direction()).normalized(), ratio, 1e-5};
    }
    step.force_count = step.contact_count = loaded;
    p.wanted = {-force, -torque / (kMetric.gyration * kMetric.gyration)};
    p.solve(step);
    const double length = six(step.motion).norm();
    at_rest += length == 0.0 ? 1 : 0;
    creeps += length > 0.0 && length <= kMetric.tolerance ? 1 : 0;
  }
  std::printf("[ measured ] %d of 300 come to rest, %d creep\n", at_rest, creeps);
  EXPECT_GT(at_rest, 200) << "the law has other solutions in a hole, too";
  EXPECT_LT(creeps, 20);
}

/// Only forces lead away from the wanted motion, also if the law is not solved. Two points hardly touch their planes
/// under much viscous friction. The motion must not keep what this viscous friction took while a point seemed to carry
/// load.
TEST(SolveWithFriction, LeavesTheWantedMotionOnlyWhereAForceActs) {
  Random random(53);
  int without_force = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    Problem p;
    p.friction = {0.8, 0.8, 5.0};
    for (int i = 0; i < 2; ++i)
      p.push((Vector3::UnitZ() + 0.5 * random.in_cube(1.0)).normalized(), random.in_cube(kBody), 0.0);
    p.wanted = random.motion(0.01, 0.2);
    p.wanted.translation.z() = random.between(-1e-3, 1e-3);
    p.last = random.motion(1e-3, 0.01);
    ConstrainedStep step;
    p.solve(step);
    if (step.force_count > 0) continue;
    ++without_force;
    ASSERT_LE((six(step.motion) - six(p.wanted)).norm(), kMetric.tolerance) << trial;
  }
  EXPECT_GT(without_force, 100);
}

// -- how often and how long

struct Series {
  const char* name;
  int kind;      ///< 0: random points; 1: a box on three planes; 2: points in wedges
  double ratio;  ///< mu_k
  double viscous;
  int unconverged;  ///< most of the 800 solutions
  long additions;   ///< most in all
};

Problem problem_of(const Series& series, int trial, Random& random) {
  Problem p;
  p.friction = {1.2 * series.ratio, series.ratio, series.viscous};
  p.wanted = random.motion(0.01, 0.2);
  p.last = trial % 2 == 0 ? Motion{} : random.motion(0.001, 0.01);
  const Motion hidden = random.motion(0.002, 0.05);
  switch (series.kind) {
    case 0:
      for (int i = 0; i < 2 + trial % 20; ++i) {
        const Vector3 normal = random.direction(), point = random.in_cube(kBody);
        const double room = normal.dot(hidden.translation + hidden.rotation.cross(point));
        p.push(normal, point, std::min(random.between(-0.002, 1e-5), room - 1e-6));
      }
      break;
    case 1:
      for (int i = 0; i < 48; ++i) {
        const int axis = i / 16;
        Vector3 point;
        point[axis] = -kBody;
        point[(axis + 1) % 3] = kBody * (2.0 * (i % 4) / 3.0 - 1.0);
        point[(axis + 2) % 3] = kBody * (2.0 * (i % 16 / 4) / 3.0 - 1.0);
        p.push(Vector3::Unit(axis), point, trial % 3 == 0 ? random.between(-3e-4, 0.0) : 0.0);
      }
      break;
    default:
      for (int i = 0; i < random.integer(1, 3); ++i) {
        const Vector3 point = random.in_cube(kBody), normal = random.direction();
        p.push(normal, point, random.between(-1e-5, 0.0));
        p.push((0.5 * random.direction() - normal).normalized(), point, random.between(-1e-5, 0.0));
      }
  }
  return p;
}

/// Converged or not: all rows are met, no force pulls, the forces turn the wanted motion into the result (without
/// viscous friction), and it leads no farther from the wanted motion than rest does, up to the lost gaps.
void expect_valid(const Problem& p, const ConstrainedStep& step, bool viscous) {
  for (std::uint32_t i = 0; i < p.rows->count; ++i) {
    const Vector3 v = step.motion.translation + step.motion.rotation.cross(p.rows->point(i));
    EXPECT_GE(p.rows->normal(i).dot(v), static_cast<double>(p.rows->required_gain[i]) - 1.5 * p.metric.tolerance);
  }
  Vector6 sum = six(p.wanted, p.metric) - six(step.motion, p.metric);
  double load = 0.0;
  for (std::uint32_t j = 0; j < step.force_count; ++j) {
    const ContactForce& f = step.forces[j];
    EXPECT_GE(f.multiplier, 0.0);
    const Vector3 force = f.multiplier * (f.normal - f.ratio * f.slip);
    Vector6 push;
    push << force, f.point.cross(force) / p.metric.gyration;
    sum += push;
    load += f.multiplier;
  }
  if (!viscous) {
    EXPECT_LE(sum.norm(), p.metric.tolerance + (step.unconverged ? 2e-7 : 1e-9) * load);
  }
  EXPECT_LE((six(step.motion, p.metric) - six(p.wanted, p.metric)).norm(),
            1.0006 * six(p.wanted, p.metric).norm() + 4e-5);
  EXPECT_EQ(step.follows, step.force_count == 0 && !step.unconverged);
}

/// A peg in a hole with a clearance of 10 um.
struct Peg {
  const char* name;
  bool is_round;
  CouplingMetric metric;  ///< default: of the default coupling; the other one: of a scene with voxels of 0.1 mm
  int hands;              ///< each for 150 cycles
  int unconverged;        ///< most cycles
  long additions;         ///< most in all
};

/// Appends the rows of a peg in pose H: points around it at four heights. Those at the edges of a rectangular one have
/// a row for each face.
void push_walls(const Peg& peg, const Pose& H, Problem& p) {
  constexpr double kHalf[] = {0.004, 0.0035}, kClearance = 1e-5;
  const auto push = [&](const Vector3& point, const Vector3& normal, double gap) {
    p.push(H.rotation.conjugate() * normal, point, gap > 0.0 ? -gap : -0.3 * gap);
  };
  for (int i = 0; i < 64; ++i) {
    const double height = 0.005 * (i / 16) - 0.0075;
    if (peg.is_round) {
      const double angle = 2.0 * std::numbers::pi * (i % 16) / 16.0;
      const Vector3 point(kHalf[0] * std::cos(angle), kHalf[0] * std::sin(angle), height);
      const Vector3 place = H * point;
      const double off = place.head<2>().norm();
      push(point, Vector3(-place.x() / off, -place.y() / off, 0.0), kHalf[0] + kClearance - off);
      continue;
    }
    const int axis = i / 8 % 2;  // eight points on two faces
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    Vector3 point(0.0, 0.0, height);
    point[axis] = side * kHalf[axis];
    point[1 - axis] = (i / 2 % 4 - 1.5) / 1.5 * kHalf[1 - axis];
    push(point, -side * Vector3::Unit(axis), kHalf[axis] + kClearance - side * (H * point)[axis]);
  }
}

void PrintTo(const Peg& peg, std::ostream* out) { *out << peg.name; }

class ShakenPeg : public ::testing::TestWithParam<Peg> {};

/// A peg that is drawn along and shaken by a hand wedges, and stops where friction just holds it. From cycle to cycle
/// the solver starts at the border between sticking and slipping.
TEST_P(ShakenPeg, FindsFriction) {
  const Peg& peg = GetParam();
  Random random(53);
  int cycles = 0, unconverged = 0;
  long additions = 0;
  for (int hand = 0; hand < peg.hands; ++hand) {
    const double ratio = random.between(0.1, 0.6);
    Vector3 amplitude[2], phase[2];
    for (int k = 0; k < 2; ++k) {
      amplitude[k] = random.in_cube(k == 0 ? 5e-4 : 0.02);
      phase[k] = random.in_cube(3.0);
    }
    const double speed = random.between(1e-6, 2e-5);
    Pose H;
    ConstrainedStep step;
    Motion last;
    for (int cycle = 0; cycle < 150; ++cycle, ++cycles) {
      Problem p;
      p.friction = {ratio, ratio, 0.0};
      p.metric = peg.metric;
      p.last = last;
      push_walls(peg, H, p);
      Pose device;
      for (int axis = 0; axis < 3; ++axis) {
        device.translation[axis] = amplitude[0][axis] * std::sin(0.02 * cycle + phase[0][axis]);
      }
      device.translation.z() += speed * cycle;
      device.rotation = exp_rotation(amplitude[1] * std::sin(0.03 * cycle + phase[1].x()));
      p.wanted = get_motion(H.inverse() * device);
      p.solve(step);
      expect_valid(p, step, false);
      if (HasFailure()) FAIL() << "hand " << hand << ", cycle " << cycle;
      unconverged += step.unconverged ? 1 : 0;
      additions += step.iterations;
      last = step.motion;
      H = H * set_matrix(step.motion);
    }
  }
  std::printf("[ measured ] %s peg: friction not found in %d of %d cycles, %ld additions\n", peg.name, unconverged,
              cycles, additions);
  EXPECT_LE(unconverged, peg.unconverged);
  EXPECT_LE(additions, peg.additions) << "one percent above the measured number";
}

INSTANTIATE_TEST_SUITE_P(Pegs, ShakenPeg,
                         ::testing::Values(Peg{"round", true, {}, 60, 0, 44750},
                                           Peg{"rectangular", false, {0.014, 1e-9, 1e-10}, 500, 2, 125100}),
                         [](const auto& peg) { return std::string(peg.param.name); });

class FrictionSeries : public ::testing::TestWithParam<Series> {};

/// Each part of the solver makes failures rarer and additions fewer. The limits are some percent above the measured
/// numbers, which hardly change with the compiler.
TEST_P(FrictionSeries, SeldomFailsAndTakesFewAdditions) {
  Random random(50);
  int unconverged = 0;
  long additions = 0, warm_additions = 0;
  for (int trial = 0; trial < 400; ++trial) {
    Problem p = problem_of(GetParam(), trial, random);
    ConstrainedStep step;
    p.solve(step);
    ASSERT_FALSE(step.infeasible);
    expect_valid(p, step, GetParam().viscous > 0.0);
    unconverged += step.unconverged ? 1 : 0;
    additions += step.iterations;
    p.last = step.motion;
    p.wanted.translation += 1e-4 * random.direction();
    p.solve(step);
    expect_valid(p, step, GetParam().viscous > 0.0);
    if (HasFailure()) FAIL() << "problem " << trial;
    unconverged += step.unconverged ? 1 : 0;
    warm_additions += step.iterations;
  }
  std::printf("[ measured ] %s: %d unconverged, %ld additions, %ld warm\n", GetParam().name, unconverged, additions,
              warm_additions);
  EXPECT_LE(unconverged, GetParam().unconverged);
  EXPECT_LE(additions + warm_additions, GetParam().additions);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, FrictionSeries,
    ::testing::Values(Series{"random, 0.2", 0, 0.2, 0.0, 1, 5450}, Series{"random, 0.6", 0, 0.6, 0.0, 1, 10600},
                      Series{"random, viscous", 0, 0.3, 1.0, 16, 7720}, Series{"box, 0.2", 1, 0.2, 0.0, 1, 4140},
                      Series{"box, 0.6", 1, 0.6, 0.0, 1, 9700}, Series{"wedge, 0.5", 2, 0.5, 0.0, 1, 38500},
                      Series{"wedge, 1.5", 2, 1.5, 0.0, 1, 24700}));

}  // namespace
}  // namespace godobject::test::friction_solver_test
