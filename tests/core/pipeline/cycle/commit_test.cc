// The end of a cycle: force, finiteness, and what is written when.

#include "core/pipeline/cycle/commit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/pipeline/cycle/constraint_force.h"
#include "core/pipeline/cycle/device_force.h"
#include "core/pipeline/cycle/unconstrained_motion.h"
#include "core/pipeline/penalty/closed_form_finish.h"
#include "tests/support/random.h"

namespace godobject::test::commit_test {
namespace {

const double kBad[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                       -std::numeric_limits<double>::infinity()};

DeviceForce force_of(double value) {
  DeviceForce force;
  for (Wrench* wrench : {&force.spring_W, &force.total_W}) {
    wrench->force = Vector3(1.0, 2.0, 3.0) * value;
    wrench->torque = Vector3(4.0, 5.0, 6.0) * value;
    value *= 10.0;
  }
  return force;
}
void expect_equal(const DeviceForce& a, const DeviceForce& b) {
  EXPECT_EQ(a.spring_W.force, b.spring_W.force);
  EXPECT_EQ(a.spring_W.torque, b.spring_W.torque);
  EXPECT_EQ(a.total_W.force, b.total_W.force);
  EXPECT_EQ(a.total_W.torque, b.total_W.torque);
}

/// The arguments of `commit`.
struct Commit {
  CycleInput input;
  Pose H_WS{exp_rotation(Vector3(0.1, 0.2, 0.3)), Vector3(0.4, 0.5, 0.6)};
  DeviceForce force = force_of(1.0);
  ProxyState state;
  CycleReport report;

  Status run(bool inside = false) { return commit(input, H_WS, force, inside, state, report); }
};

TEST(Commit, WritesPoseForceAndState) {
  for (const bool inside : {false, true}) {
    Commit commit;
    EXPECT_FALSE(commit.state.started);
    EXPECT_FALSE(commit.state.inside);
    commit.state.inside = !inside;
    commit.report.outside = true;
    ASSERT_EQ(commit.run(inside), Status::kOk);
    EXPECT_TRUE(commit.state.H_WS == commit.H_WS);
    EXPECT_TRUE(commit.report.H_WS == commit.H_WS);
    EXPECT_TRUE(commit.state.started);
    EXPECT_EQ(commit.state.inside, inside);
    EXPECT_FALSE(commit.report.outside);
    expect_equal(commit.report.force, force_of(1.0));
  }
}

TEST(Commit, AddsThePushOfTheFacesOnlyOutside) {
  Commit commit;
  commit.input.push = force_of(100.0);
  ASSERT_EQ(commit.run(), Status::kOk);
  expect_equal(commit.report.force, force_of(1.0));
  commit.input.outside = true;
  ASSERT_EQ(commit.run(), Status::kOk);
  EXPECT_TRUE(commit.report.outside);
  EXPECT_EQ(commit.report.force.spring_W.force, force_of(101.0).spring_W.force);
  EXPECT_EQ(commit.report.force.spring_W.torque, force_of(1.0).spring_W.torque) << "a face has no torque";
  EXPECT_EQ(commit.report.force.total_W.torque, force_of(1.0).total_W.torque);
}

/// Along each axis contacts and faces damp together by no more than the larger of the two, unless they oppose each
/// other.
TEST(Commit, DampsEachAxisOnce) {
  Commit commit;
  commit.input.outside = true;
  commit.force.spring_W.force = Vector3(10.0, 10.0, -10.0);
  commit.force.total_W.force = Vector3(13.0, 6.0, -11.0);  // damping 3, -4, -1
  commit.input.push.spring_W.force = Vector3(100.0, 100.0, -100.0);
  commit.input.push.total_W.force = Vector3(105.0, 98.0, -93.0);  // damping 5, -2, 7
  ASSERT_EQ(commit.run(), Status::kOk);
  EXPECT_EQ(commit.report.force.spring_W.force, Vector3(110.0, 110.0, -110.0));
  EXPECT_EQ(commit.report.force.total_W.force, Vector3(110.0 + 5.0, 110.0 - 4.0, -110.0 - 1.0 + 7.0));
}

TEST(Commit, RefusesEachNumberThatIsNotFiniteAndChangesNothing) {
  Commit commit;
  std::vector<double*> numbers;
  for (int i = 0; i < 3; ++i) {
    numbers.push_back(&commit.H_WS.translation[i]);
    for (Wrench* wrench : {&commit.force.spring_W, &commit.force.total_W}) {
      numbers.push_back(&wrench->force[i]);
      numbers.push_back(&wrench->torque[i]);
    }
  }
  for (int i = 0; i < 4; ++i) numbers.push_back(&commit.H_WS.rotation.coeffs()[i]);
  for (double* number : numbers) {
    const double good = *number;
    for (const double bad : kBad) {
      *number = bad;
      commit.state = ProxyState{};
      commit.report = CycleReport{};
      ASSERT_EQ(commit.run(true), Status::kNotFinite);
      EXPECT_TRUE(commit.state.H_WS == Pose() && !commit.state.started && !commit.state.inside);
      EXPECT_TRUE(commit.report.H_WS == Pose());
      expect_equal(commit.report.force, DeviceForce{});
    }
    *number = good;
    ASSERT_EQ(commit.run(), Status::kOk);
  }
}

TEST(Commit, RefusesAPushThatIsNotFinite) {
  for (Wrench DeviceForce::*wrench : {&DeviceForce::spring_W, &DeviceForce::total_W}) {
    Commit commit;
    (commit.input.push.*wrench).force.y() = kBad[0];
    EXPECT_EQ(commit.run(), Status::kOk) << "the device is inside: no push";
    commit.input.outside = true;
    EXPECT_EQ(commit.run(), Status::kNotFinite);
  }
}

/// The power of the damping is never positive: in each frame, for translations and rotations, and the force keeps its
/// line.
TEST(DeviceForce, TakesPowerAlongTheSpringAndNeverPulls) {
  Random random(1);
  Parameters q;
  for (int i = 0; i < 5000; ++i) {
    q.stiffness = random.between(100.0, 5000.0);
    q.damping = random.between(0.0, 50.0);
    q.coupling_translation = random.between(0.5, 2.0);
    q.coupling_rotation = random.between(0.01, 0.1);
    const Wrench coupling_D{random.in_cube(0.01), random.in_cube(0.001)};
    const Pose H_WD = set_matrix(random.motion(1.0, 3.0));
    const Motion velocity{random.in_cube(0.5), random.in_cube(3.0)};
    const DeviceForce got = device_force(coupling_D, H_WD, velocity, q);
    const Matrix3 R = H_WD.rotation.toRotationMatrix();
    const auto check = [&](const Vector3& spring, const Vector3& total, const Vector3& coupling, const Vector3& v,
                           double damping) {
      ASSERT_LT((spring - q.stiffness * R * coupling).norm(), 1e-11) << i;
      const Vector3 n = spring.normalized();
      const double size = std::max(0.0, spring.norm() - damping * n.dot(v));
      ASSERT_LT((total - size * n).norm(), 1e-11) << i;
      ASSERT_LE((total - spring).dot(v), 1e-12) << i;
    };
    check(got.spring_W.force, got.total_W.force, coupling_D.force, velocity.translation,
          q.damping * q.coupling_translation);
    check(got.spring_W.torque, got.total_W.torque, coupling_D.torque, velocity.rotation,
          q.damping * q.coupling_rotation);
    if (HasFatalFailure()) return;
  }
}

TEST(DeviceForce, IsZeroBelowTheRoundingOfAStretch) {
  Parameters q;
  q.stiffness = 1.0;
  for (const double size : {0.0, 1e-15, 0.9e-12}) {
    const DeviceForce force = device_force({size * Vector3::UnitX(), size * Vector3::UnitY()}, Pose(), {}, q);
    EXPECT_TRUE(force.total_W.force.isZero(0.0) && force.total_W.torque.isZero(0.0)) << size;
  }
  for (const double size : {1.1e-12, 1e-9}) {
    const DeviceForce force = device_force({size * Vector3::UnitX(), size * Vector3::UnitY()}, Pose(), {}, q);
    EXPECT_NEAR(force.total_W.force.x(), size, 1e-15 * size);
    EXPECT_NEAR(force.total_W.torque.y(), size, 1e-15 * size);
  }
}

TEST(CouplingStretch, TakesTheDeviceToTheGodObjectInTheDevicesFrame) {
  Random random(2);
  for (int i = 0; i < 500; ++i) {
    const Pose H_WD = set_matrix(random.motion(1.0, 3.0));
    const Motion stretch = random.motion(0.01, 0.5);
    const Motion got = coupling_stretch(H_WD, H_WD * set_matrix(stretch));
    ASSERT_LT((got.translation - stretch.translation).norm(), 1e-14);
    ASSERT_LT((got.rotation - stretch.rotation).norm(), 1e-14);
    const Wrench force = constraint_force(stretch, 2.0, 3.0);
    ASSERT_EQ(force.force, 2.0 * stretch.translation);
    ASSERT_EQ(force.torque, 3.0 * stretch.rotation);
    const Motion free = unconstrained_motion(H_WD, H_WD * set_matrix(stretch));
    ASSERT_LT((free.translation - stretch.translation).norm(), 1e-14);
    ASSERT_LT((free.rotation - stretch.rotation).norm(), 1e-14);
  }
}

struct Finish {
  CycleInput input;
  ClosedFormResult result;
  Parameters parameters;
  ProxyState state;
  CycleReport report;

  /// `tenths`: depth beyond the safety layer, in tenths of a voxel.
  explicit Finish(double tenths) {
    parameters.voxel_size = 0.002;
    result.contacts.depth = parameters.safety_distance + tenths * 0.1 * parameters.voxel_size;
    result.contacts.count = 7;
    result.substeps = 3;
    report.dropped = 9;
    report.unconverged = true;
    state.started = true;
  }
  Outcome run() {
    EXPECT_EQ(finish_closed_form(input, result, parameters, state, report), Status::kOk);
    return report.outcome;
  }
};

TEST(ClosedFormFinish, ReportsContactsOfTheLastSubstep) {
  Finish finish(0.5);
  EXPECT_EQ(finish.run(), Outcome::kContact);
  EXPECT_NEAR(finish.report.penetration, 1e-4, 1e-15);
  EXPECT_EQ(finish.report.contacts, 7u);
  EXPECT_EQ(finish.report.substeps, 3u);
  EXPECT_EQ(finish.report.dropped, 0u);
  EXPECT_FALSE(finish.report.unconverged);
  const ClosedFormResult first;
  EXPECT_FALSE(first.cut);
  EXPECT_EQ(first.substeps, 1u);
}

TEST(ClosedFormFinish, NamesTheOutcome) {
  Finish free(0.0);
  free.result.contacts.depth = 0.0;
  EXPECT_EQ(free.run(), Outcome::kFree);
  free.result.contacts.depth = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(free.run(), Outcome::kContact);
  free.result.cut = true;
  EXPECT_EQ(free.run(), Outcome::kCut);
  free.result.contacts.depth = -1.0;
  EXPECT_EQ(free.run(), Outcome::kCut);
  // a start inside comes last in the order, so it is reported
  Finish deep(20.0);
  deep.state.inside = true;
  deep.result.cut = true;
  EXPECT_EQ(deep.run(), Outcome::kStartInside);
}

/// It counts as outside once it is less than a tenth of a voxel deep, but not in the first cycle, and never again.
TEST(ClosedFormFinish, StaysInsideUntilItHasComeOut) {
  for (const bool started : {false, true}) {
    for (const double tenths : {-100.0, 0.0, 0.99, 1.01, 100.0}) {
      Finish finish(tenths);
      finish.state.started = started;
      finish.state.inside = true;
      const bool inside = !started || tenths > 1.0;
      EXPECT_EQ(finish.run() == Outcome::kStartInside, inside) << tenths;
      EXPECT_EQ(finish.state.inside, inside);
      EXPECT_TRUE(finish.state.started);
    }
  }
  Finish outside(100.0);
  EXPECT_EQ(outside.run(), Outcome::kContact) << "it did not start inside";
  EXPECT_FALSE(outside.state.inside);
}

TEST(ClosedFormFinish, WritesNothingIfAForceIsNotFinite) {
  Finish finish(0.5);
  finish.input.velocity_W.translation.setConstant(-1e308);
  finish.input.H_WD.translation.x() = -0.01;
  finish.parameters.damping = 1e10;
  finish.report.contacts = 99;
  finish.state.inside = true;
  EXPECT_EQ(finish_closed_form(finish.input, finish.result, finish.parameters, finish.state, finish.report),
            Status::kNotFinite);
  EXPECT_EQ(finish.report.contacts, 99u);
  EXPECT_TRUE(finish.report.unconverged);
  EXPECT_TRUE(finish.state.inside);
}

/// (46) and #7 by hand: 2 mm and 0.1 rad from device to god object, the device turned by a quarter about z.
TEST(ClosedFormFinish, RendersTheStretchOnTheAxesOfTheWorld) {
  Finish finish(0.5);
  finish.input.H_WD = {exp_rotation(Vector3(0.0, 0.0, 0.5 * M_PI)), Vector3(0.3, 0.0, 0.0)};
  finish.result.H_WS = finish.input.H_WD * set_matrix({{0.002, 0.0, 0.0}, {0.1, 0.0, 0.0}});
  finish.input.velocity_W = {{0.0, -0.1, 0.0}, {0.0, 2.0, 0.0}};
  finish.run();
  // k_D = 2000 N/m: 4 N; b_D 0.1 m/s = 2 N against the approach. k_VC,r = 0.025 m^2: 5 Nm, less 20 * 0.025 * 2 Nm
  EXPECT_LT((finish.report.force.spring_W.force - Vector3(0.0, 4.0, 0.0)).norm(), 1e-12);
  EXPECT_LT((finish.report.force.total_W.force - Vector3(0.0, 6.0, 0.0)).norm(), 1e-12);
  EXPECT_LT((finish.report.force.spring_W.torque - Vector3(0.0, 5.0, 0.0)).norm(), 1e-12);
  EXPECT_LT((finish.report.force.total_W.torque - Vector3(0.0, 4.0, 0.0)).norm(), 1e-12);
  EXPECT_TRUE(finish.state.H_WS == finish.result.H_WS);
}

TEST(Outcome, HasAWordForEach) {
  const struct {
    Outcome outcome;
    std::string word;
  } words[] = {{Outcome::kFree, "free"},
               {Outcome::kContact, "contact"},
               {Outcome::kStartInside, "start_inside"},
               {Outcome::kCut, "cut"},
               {Outcome::kOverflow, "overflow"},
               {Outcome::kBadInput, "bad_input"},
               {Outcome::kInfeasible, "infeasible"}};
  for (const auto& [outcome, word] : words) EXPECT_EQ(name(outcome), word);
  EXPECT_EQ(name(static_cast<Outcome>(200)), std::string("unknown"));
}

}  // namespace
}  // namespace godobject::test::commit_test
