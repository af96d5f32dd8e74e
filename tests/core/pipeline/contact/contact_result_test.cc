// The end of a cycle and the lengths of the solver: cases that can be computed by hand.

#include "core/pipeline/contact/contact_result.h"

#include <cmath>
#include <limits>
#include <memory>

#include <gtest/gtest.h>

#include "core/pipeline/contact/contact_lengths.h"
#include "core/pipeline/contact/damping.h"
#include "tests/support/random.h"
#include "toolchain/watch/least_distance.h"

namespace godobject::test::contact_result_test {
namespace {

using detail::ContactResult;
using detail::finish_contact;
using detail::outcome_of;

class FinishContact : public ::testing::Test {
 protected:
  FinishContact() {
    q_.stiffness = 1500.0;
    q_.damping = 12.0;
    q_.coupling_translation = 0.8;
    q_.coupling_rotation = 0.03;
    q_.voxel_size = 0.004;
    input_.H_WD.translation = Vector3(0.1, -0.2, 0.3);
    input_.H_WD.rotation = exp_rotation({0.4, 0.5, -0.6});
    result_.H_WS = input_.H_WD;
    result_.smallest = 1e-4;
  }
  Status finish() {
    return finish_contact(input_, result_, step_, q_, ContactLengths::make(q_), *memory_, state_, report_);
  }
  void push(const Vector3& normal, const Vector3& point, double multiplier) {
    step_.forces[step_.force_count++] = {step_.force_count, point, point, normal, Vector3::Zero(), 0.0, multiplier};
    step_.contact_count = step_.force_count;
  }

  Parameters q_;
  CycleInput input_;
  ContactResult result_;
  ConstrainedStep step_;
  std::unique_ptr<ContactMemory> memory_ = std::make_unique<ContactMemory>();
  ProxyState state_;
  CycleReport report_;
};

TEST_F(FinishContact, PushesNowhereAtTheDevice) {
  ASSERT_EQ(finish(), Status::kOk);
  EXPECT_EQ(report_.force.spring_W.force, Vector3::Zero());
  EXPECT_EQ(report_.force.spring_W.torque, Vector3::Zero());
  EXPECT_EQ(report_.force.total_W.force, Vector3::Zero());
  EXPECT_TRUE(report_.H_WS == input_.H_WD);
}

/// #6 and #7: the forces of the stretch, along the device's axes, in W.
TEST_F(FinishContact, PushesByTheStretchOfTheCoupling) {
  const Vector3 stretch(0.002, -0.003, 0.001), turn(0.05, -0.02, 0.04);  // in D
  result_.H_WS = input_.H_WD * set_matrix({stretch, turn});
  ASSERT_EQ(finish(), Status::kOk);
  const Quaternion R = input_.H_WD.rotation;
  EXPECT_LT((report_.force.spring_W.force - 1500.0 * 0.8 * (R * stretch)).norm(), 1e-10);
  EXPECT_LT((report_.force.spring_W.torque - 1500.0 * 0.03 * (R * turn)).norm(), 1e-10);
  EXPECT_EQ(report_.force.total_W.force, report_.force.spring_W.force) << "no contact, no damping";
  EXPECT_EQ(report_.force.total_W.torque, report_.force.spring_W.torque);
  EXPECT_TRUE(state_.H_WS == result_.H_WS);
}

/// One contact: the damping is the projection of b_D times the velocity on its row (n, P x n / rho), in the metric of
/// the coupling.
TEST_F(FinishContact, DampsAlongTheRowOfAContact) {
  Random random(1);
  const double rho = std::sqrt(0.03 / 0.8);
  for (int i = 0; i < 50; ++i) {
    step_ = {};
    const Vector3 n = random.direction(), p = random.in_cube(0.1);
    push(n, p, 0.01);
    result_.H_WS.rotation = exp_rotation(random.in_cube(2.0));
    const Motion velocity_S{random.in_cube(0.05), random.in_cube(0.3)};
    const Quaternion R = result_.H_WS.rotation;
    input_.velocity_W = {R * velocity_S.translation, R * velocity_S.rotation};
    ASSERT_EQ(finish(), Status::kOk);
    const Vector3 lever = p.cross(n);
    const double approach = -(n.dot(velocity_S.translation) + lever.dot(velocity_S.rotation));
    const double size = 12.0 * 0.8 * approach / (1.0 + lever.squaredNorm() / (rho * rho));
    const Vector3 force = report_.force.total_W.force - report_.force.spring_W.force;
    const Vector3 torque = report_.force.total_W.torque - report_.force.spring_W.torque;
    EXPECT_LT((force - size * (R * n)).norm(), 1e-9) << i;
    EXPECT_LT((torque - size * (R * lever)).norm(), 1e-9) << i;
  }
}

TEST_F(FinishContact, StoresTheStepForTheNextCycle) {
  push(Vector3::UnitZ(), Vector3::Zero(), 0.01);
  step_.motion = {Vector3(1.0, 2.0, 3.0), Vector3(4.0, 5.0, 6.0)};
  ASSERT_EQ(finish(), Status::kOk);
  EXPECT_EQ(memory_->last_step.motion.translation, step_.motion.translation);
  EXPECT_EQ(memory_->last_step.motion.rotation, step_.motion.rotation);
  EXPECT_EQ(memory_->last_step.force_count, 1u);
  EXPECT_EQ(memory_->last_step.forces[0].multiplier, 0.01);
  EXPECT_TRUE(memory_->H_WD_last == input_.H_WD);
  EXPECT_TRUE(state_.started);
}

TEST_F(FinishContact, ChangesNothingIfANumberIsNotFinite) {
  push(Vector3::UnitZ(), Vector3::Zero(), 0.01);
  result_.H_WS.translation.x() = std::nan("");
  result_.dropped = 5;
  report_.dropped = 77;
  EXPECT_EQ(finish(), Status::kNotFinite);
  EXPECT_EQ(memory_->last_step.force_count, 0u);
  EXPECT_FALSE(memory_->H_WD_last == input_.H_WD);
  EXPECT_EQ(report_.dropped, 77u);
  EXPECT_FALSE(state_.started);
}

TEST_F(FinishContact, ReportsTheCycle) {
  const ContactLengths lengths = ContactLengths::make(q_);
  result_.dropped = 3;
  result_.substeps = 4;
  step_.contact_count = 2;
  step_.force_count = 0;
  step_.unconverged = true;
  for (const double smallest :
       {-0.5, 0.0, 1e-4, lengths.shortest_search_radius, 1.0, std::numeric_limits<double>::infinity()}) {
    result_.smallest = smallest;
    ASSERT_EQ(finish(), Status::kOk);
    EXPECT_EQ(report_.penetration, -std::min(smallest, 0.0005)) << "an eighth of a voxel at most";
  }
  EXPECT_EQ(report_.contacts, 2u);
  EXPECT_EQ(report_.dropped, 3u);
  EXPECT_EQ(report_.substeps, 4u);
  EXPECT_TRUE(report_.unconverged);
  EXPECT_EQ(report_.outcome, Outcome::kOverflow);
  result_.substeps = 0;
  result_.dropped = 0;
  step_.unconverged = false;
  ASSERT_EQ(finish(), Status::kOk);
  EXPECT_EQ(report_.substeps, 1u);
  EXPECT_FALSE(report_.unconverged);
  EXPECT_EQ(report_.outcome, Outcome::kFree);
  step_.force_count = 1;
  ASSERT_EQ(finish(), Status::kOk);
  EXPECT_EQ(report_.outcome, Outcome::kContact);
  result_.cut = true;
  ASSERT_EQ(finish(), Status::kOk);
  EXPECT_EQ(report_.outcome, Outcome::kCut);
  step_.infeasible = true;
  ASSERT_EQ(finish(), Status::kOk);
  EXPECT_EQ(report_.outcome, Outcome::kInfeasible);
  EXPECT_FALSE(state_.inside);
  result_.inside = true;
  ASSERT_EQ(finish(), Status::kOk);
  EXPECT_EQ(report_.outcome, Outcome::kStartInside);
  EXPECT_TRUE(state_.inside);
}

TEST(OutcomeOf, IsFreeWithoutAFlag) {
  const detail::OutcomeFlags none;
  EXPECT_EQ(outcome_of(none), Outcome::kFree);
  detail::OutcomeFlags flags;
  flags.held = true;
  EXPECT_EQ(outcome_of(flags), Outcome::kContact);
}

/// The most severe flag decides: inside, infeasible, dropped, cut, held.
TEST(OutcomeOf, IsThatOfTheMostSevereFlag) {
  for (unsigned flags = 0; flags < 32; ++flags) {
    const Outcome expected = (flags & 16) != 0  ? Outcome::kStartInside
                             : (flags & 8) != 0 ? Outcome::kInfeasible
                             : (flags & 4) != 0 ? Outcome::kOverflow
                             : (flags & 2) != 0 ? Outcome::kCut
                             : (flags & 1) != 0 ? Outcome::kContact
                                                : Outcome::kFree;
    EXPECT_EQ(outcome_of({.held = (flags & 1) != 0,
                          .cut = (flags & 2) != 0,
                          .dropped = (flags & 4) != 0,
                          .infeasible = (flags & 8) != 0,
                          .inside = (flags & 16) != 0}),
              expected);
  }
}

// -- damping

/// The damped forces are the point of the rows' cone nearest to load - damping. An independent solver finds it: among
/// the vectors x with c . x >= 0 the one nearest to damping - load is the remainder of that projection.
TEST(DampingChange, ProjectsOnTheConeOfTheRows) {
  Random random(2);
  int pulling = 0;
  for (int problem = 0; problem < 1000; ++problem) {
    const int count = random.integer(1, 6);
    std::array<Vector6, 6> rows;
    Vector6 load = Vector6::Zero();
    for (int j = 0; j < count; ++j) {
      rows[static_cast<std::size_t>(j)] << random.direction(), 0.5 * random.in_cube(1.0);
      load += random.between(0.0, 0.01) * rows[static_cast<std::size_t>(j)];
    }
    const Vector6 damping = Vector6::NullaryExpr([&] { return random.between(-0.005, 0.005); });
    const Vector6 change = detail::damping_change(rows.data(), static_cast<std::uint32_t>(count), load, damping);
    // z = damping - load + C mu nearest to it with C' z >= 0; the damped force is C mu
    std::vector<watch::HalfPlane> planes;
    for (int j = 0; j < count; ++j) {
      const Vector6& row = rows[static_cast<std::size_t>(j)];
      planes.push_back({row, -row.dot(damping - load)});
    }
    const watch::LeastDistance slow = watch::least_distance(planes);
    ASSERT_TRUE(slow.feasible);
    EXPECT_LT((change + load - slow.x).norm(), 1e-9) << "the damped force, problem " << problem;
    EXPECT_LE(change.norm(), damping.norm() * (1.0 + 1e-9));
    EXPECT_LE(change.dot(damping), 1e-12);
    pulling += (change + damping).norm() > 1e-6 ? 1 : 0;
  }
  EXPECT_GT(pulling, 500);
}

/// Rows that contradict each other almost exactly, under loads of any size: the projection is then wrong by rounding of
/// the load. Damping must not push all the same: the change takes power from the velocity, and is no larger than the
/// damping.
TEST(DampingChange, NeverPushesThoughRowsContradictEachOther) {
  test::Random random(11);
  const auto vector = [&](double half) {
    return Vector6(Vector6::NullaryExpr([&] { return random.between(-half, half); }));
  };
  int zeros = 0;
  constexpr int kCases = 20000;
  for (int k = 0; k < kCases; ++k) {
    const int count = random.integer(2, 9);
    const double apart = std::pow(10.0, random.between(-14.0, -1.0));
    const double size = std::pow(10.0, random.between(-3.0, 9.0));
    std::vector<Vector6> rows;
    Vector6 load = Vector6::Zero();
    for (int i = 0; i < count; ++i) {
      Vector6 row = vector(1.0).normalized();
      if (i > 0 && random.integer(0, 1) == 1) {
        row = -rows[static_cast<std::size_t>(random.integer(0, i - 1))] + vector(apart);
      }
      rows.push_back(row);
      load += size * random.between(0.0, 1.0) * row;
    }
    const Vector6 damping = vector(1.0);
    const Vector6 change = detail::damping_change(rows.data(), static_cast<std::uint32_t>(count), load, damping);
    ASSERT_LE(change.norm(), damping.norm() * (1.0 + 1e-8)) << k;
    ASSERT_LE(change.dot(damping), 1e-8 * damping.squaredNorm()) << k;
    zeros += change.isZero(0.0) ? 1 : 0;
  }
  EXPECT_LT(zeros, kCases / 5) << "most damp";
}

/// Damping is zero if the rows cannot carry the load: it would add power or be too strong.
TEST(DampingChange, IsZeroForALoadThatTheRowsCannotCarry) {
  const Vector6 row = Vector6::Unit(2);
  EXPECT_TRUE(detail::damping_change(&row, 1, -0.01 * row, 0.001 * row).isZero(0.0)) << "a pull";
  const Vector6 elsewhere = 0.01 * Vector6::Unit(0);
  EXPECT_TRUE(detail::damping_change(&row, 1, elsewhere, 0.001 * row).isZero(0.0)) << "too strong";
  EXPECT_TRUE(detail::damping_change(&row, 0, Vector6::Zero(), 0.001 * row).isZero(1e-18)) << "no row";
  EXPECT_LT((detail::damping_change(&row, 1, 0.01 * row, 0.001 * row) + 0.001 * row).norm(), 1e-15);
}

// -- lengths

TEST(ContactLengths, AreThoseOfTheDocumentation) {
  Parameters q;
  q.voxel_size = 0.004;
  q.margin = 1e-4;
  q.coupling_translation = 0.5;
  q.coupling_rotation = 0.02;
  q.point_budget = 123;
  q.mass = MassModel::make(Vector3::Constant(0.01), 0.3, 0.3);
  q.mass.sphere = {Vector3(1.0, 2.0, 3.0), 0.25};
  const ContactLengths lengths = ContactLengths::make(q);
  EXPECT_EQ(lengths.margin, 1e-4);
  EXPECT_DOUBLE_EQ(lengths.wanted_margin, 0.8e-4);
  EXPECT_DOUBLE_EQ(lengths.least_margin, 0.25e-4);
  EXPECT_DOUBLE_EQ(lengths.shortest_search_radius, 0.0005);
  EXPECT_DOUBLE_EQ(lengths.longest_search_radius, 0.006);
  EXPECT_DOUBLE_EQ(lengths.opening, 4e-5);
  EXPECT_DOUBLE_EQ(lengths.largest_gain, 0.001);
  EXPECT_EQ(lengths.radius, 0.3);
  EXPECT_EQ(lengths.sphere.center, Vector3(1.0, 2.0, 3.0));
  EXPECT_EQ(lengths.sphere.radius, 0.25);
  EXPECT_EQ(lengths.point_budget, 123u);
  EXPECT_DOUBLE_EQ(lengths.metric.gyration, 0.2);
  EXPECT_DOUBLE_EQ(lengths.metric.still, 4e-9);
  EXPECT_DOUBLE_EQ(lengths.metric.tolerance, 1e-7) << "a thousandth of the margin";
  EXPECT_DOUBLE_EQ(lengths.rounding, 4e-9);
  q.margin = 1e-6;  // small against the voxel: rounding decides, and stays a tenth of the least margin
  const ContactLengths small = ContactLengths::make(q);
  EXPECT_DOUBLE_EQ(small.metric.tolerance, 4e-9) << "not below the rounding";
  EXPECT_DOUBLE_EQ(small.rounding, 4e-9);
  q.margin = 1e-8;
  EXPECT_DOUBLE_EQ(ContactLengths::make(q).rounding, 0.1 * 0.25e-8);
  const GapLaw gap = lengths.gap_law();
  EXPECT_EQ(gap.margin, 1e-4);
  EXPECT_EQ(gap.tolerance, lengths.metric.tolerance);
  EXPECT_EQ(gap.recovery, 0.3);
  EXPECT_EQ(gap.largest_gain, 0.001 * 1.0);
}

TEST(ContactLengths, SearchThreeMarginsFartherThanTheDisplacement) {
  Parameters q;
  q.voxel_size = 0.004;
  q.margin = 1e-4;
  const ContactLengths lengths = ContactLengths::make(q);
  EXPECT_NEAR(lengths.search_radius_for(0.002, 0.006), 0.0023, 1e-15);
  EXPECT_EQ(lengths.search_radius_for(0.0, 0.006), 0.0005) << "the shortest";
  EXPECT_EQ(lengths.search_radius_for(0.01, 0.006), 0.006) << "the longest";
  EXPECT_EQ(lengths.search_radius_for(0.0, 0.0002), 0.0002) << "the longest is shorter than the shortest";
}

TEST(GapLaw, RegainsAShareOfALostGap) {
  const GapLaw gap{1e-4, 1e-7, 0.3, 0.001};
  EXPECT_EQ(gap.required_gain(0.0), 0.0);
  EXPECT_EQ(gap.required_gain(1e-7), 0.0);
  EXPECT_EQ(gap.required_gain(-1e-7), 0.0);
  EXPECT_DOUBLE_EQ(gap.required_gain(1.01e-7), 0.303e-7);
  EXPECT_DOUBLE_EQ(gap.required_gain(0.001), 0.0003);
  EXPECT_DOUBLE_EQ(gap.required_gain(1.0), 0.001);
  EXPECT_DOUBLE_EQ(gap.required_gain(-1.01e-7), -1.01e-7);
  EXPECT_DOUBLE_EQ(gap.required_gain(-1.0), -1.0) << "a gap above the margin may shrink to it";
}

}  // namespace
}  // namespace godobject::test::contact_result_test
