// The cycle `corrected` with its sub-steps, against a plain loop over all points.

#include "core/pipeline/corrected/corrected_cycle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/pipeline/paper/paper_cycle.h"
#include "tests/support/analytic_worlds.h"
#include "tests/support/random.h"

namespace godobject::test::corrected_cycle_test {
namespace {

constexpr double kVoxel = 0.002;
constexpr double kWorldRadius = 0.1;

/// A ball without a gradient at its centre, as the stored field of a thick body has none.
struct ThickBall {
  double distance(const Vector3& p) const noexcept { return p.norm() - kWorldRadius; }
  Vector3 gradient(const Vector3& p) const noexcept {
    return p.norm() < 0.05 ? Vector3(Vector3::Zero()) : Vector3(2.0 * p.normalized());
  }
};
using World = AnalyticField;

struct SlowResult {
  Pose H_WS;
  ProjectionState memory;
  double depth = 0.0;
  std::uint32_t contacts = 0;
  std::uint32_t substeps = 0;
  bool cut = false;
};

/// Step #1 by brute force: (1) to first order, and (2).
PenaltyContacts slow_contacts(const World& world, const Pointshell& shell, const Pose& H_WS, double d) {
  PenaltyContacts contacts;
  contacts.depth = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < shell.size; ++i) {
    const FieldSample sample = world.sample(H_WS * shell.point(i));
    const double V = d - sample.distance;
    contacts.depth = std::max(contacts.depth, V);
    if (V <= 0.0) continue;
    ++contacts.count;
    if (sample.gradient.isZero(0.0)) continue;
    const Vector3 force_S = H_WS.rotation.conjugate() * (V * sample.gradient.normalized());
    contacts.wrench_S.force += force_S;
    contacts.wrench_S.torque += shell.point(i).cross(force_S);
  }
  return contacts;
}

SlowResult slow_cycle(const World& world, const Pointshell& shell, const Parameters& q, const CycleInput& input,
                      const ProxyState& state, const ProjectionState& memory, bool has_friction) {
  const ProjectionFriction friction{q.friction.static_ratio, q.friction.kinetic_ratio,
                                    q.friction.viscous / (q.period * q.stiffness * q.coupling_translation)};
  SlowResult out;
  out.H_WS = state.H_WS;
  out.memory = memory;
  for (;;) {
    ++out.substeps;
    const PenaltyContacts contacts = slow_contacts(world, shell, out.H_WS, q.safety_distance);
    out.depth = contacts.depth;
    out.contacts = contacts.count;
    const Motion wanted = get_motion(out.H_WS.inverse() * input.H_WD);
    if (state.inside && !contacts.has_direction()) {
      out.H_WS = out.H_WS * set_matrix(wanted);
      out.memory = {};
      out.cut = false;
      return out;
    }
    const Projection step = project(wanted, contacts, q.safety_distance, q.correction_gain, q.mass,
                                    has_friction ? &friction : nullptr, out.memory);
    out.memory = step.next;
    out.cut = step.cut;
    if (!step.cut && contacts.depth <= 0.0) {
      out.H_WS = input.H_WD;
    } else {
      out.H_WS = clipped_to(q.workspace, out.H_WS, out.H_WS * set_matrix(step.motion));
    }
    if (!step.cut || out.substeps == 8) return out;
  }
}

/// Draws parameters, some with a workspace around the start.
void draw(Random& random, const Vector3& start, Parameters& q) {
  q.safety_distance = random.between(0.001, 0.005);
  q.correction_gain = random.between(0.1, 1.0);
  q.stiffness = random.between(100.0, 5000.0);
  q.coupling_translation = random.between(0.5, 2.0);
  q.period = random.between(5e-4, 2e-3);
  q.friction = {random.between(0.1, 0.8), 0.1, random.between(0.0, 20.0)};
  q.workspace = {};
  if (random.integer(0, 2) == 0) {
    q.workspace.limited = true;
    q.workspace.low = start - 0.004 * Vector3::Ones();
    q.workspace.high = start + 0.004 * Vector3::Ones();
  }
}

template <bool kFriction>
void expect_plain_loop(unsigned seed) {
  Random random(seed);
  const World world(ThickBall{}, kVoxel);
  const SampledBody body = box_body(5);
  int by_substeps[9] = {};
  int flat = 0;
  int clipped = 0;
  for (int i = 0; i < 3000; ++i) {
    Pose start = set_matrix(random.motion(0.0, 3.0));
    start.translation = random.between(i % 4 == 0 ? 0.0 : 0.11, 0.16) * random.direction();
    AnalyticRun<World, CorrectedCycle<kFriction>> run(world, body, start);
    draw(random, start.translation, run.parameters);
    const double size = std::pow(10.0, random.between(-5.0, -1.3));
    CycleInput input;
    input.H_WD = start * set_matrix(random.motion(size, i % 5 == 0 ? 3.0 : 10.0 * size));
    input.H_WD.translation = run.parameters.workspace.nearest(input.H_WD.translation);
    run.state.inside = i % 4 == 0;
    run.cycle.memory.slipping = random.integer(0, 1) == 1;
    run.cycle.memory.relaxation = random.between(0.1, 1.0);
    run.cycle.memory.wanted = random.motion(0.001, 0.01);
    const SlowResult expected =
        slow_cycle(world, body.pointshell(), run.parameters, input, run.state, run.cycle.memory, kFriction);
    ASSERT_EQ(run.step(input.H_WD), Status::kOk) << i;
    ASSERT_LT((run.state.H_WS.translation - expected.H_WS.translation).norm(), 1e-10) << i;
    ASSERT_LT(log_rotation(run.state.H_WS.rotation.conjugate() * expected.H_WS.rotation).norm(), 1e-9) << i;
    ASSERT_EQ(run.report.substeps, expected.substeps) << i;
    ASSERT_EQ(run.report.contacts, expected.contacts) << i;
    if (expected.contacts > 0) {
      ASSERT_NEAR(run.report.penetration, expected.depth - run.parameters.safety_distance, 1e-10) << i;
    }
    if (!expected.cut && expected.depth <= 0.0) {
      ASSERT_TRUE(run.state.H_WS == input.H_WD) << i << ": the device's pose to the last bit";
    }
    if (!run.state.inside) {
      ASSERT_EQ(run.report.outcome == Outcome::kCut, expected.cut) << i;
    }
    ASSERT_EQ(run.cycle.memory.slipping, expected.memory.slipping) << i;
    ASSERT_EQ(run.cycle.memory.relaxation, expected.memory.relaxation) << i;
    ASSERT_LT((run.cycle.memory.wanted.translation - expected.memory.wanted.translation).norm(), 1e-10) << i;
    ++by_substeps[expected.substeps];
    flat += run.report.outcome == Outcome::kStartInside && expected.memory.wanted.translation.isZero(0.0) ? 1 : 0;
    clipped += run.parameters.workspace.limited && expected.substeps > 1 ? 1 : 0;
  }
  EXPECT_GT(by_substeps[1], 500);
  EXPECT_GT(by_substeps[2], 20);
  EXPECT_GT(by_substeps[8], 100);
  EXPECT_GT(flat, 50);
  EXPECT_GT(clipped, 20);
}

TEST(Corrected, IsAPlainLoopOverAllPoints) { expect_plain_loop<false>(1); }
TEST(Corrected, IsAPlainLoopOverAllPointsWithFriction) { expect_plain_loop<true>(2); }

/// A point exactly on the safety layer, 0.25 m above the floor, does not touch it.
TEST(Corrected, FollowsTheDeviceToTheLastBitOnTheEdgeOfTheLayer) {
  const AnalyticField floor(HalfSpace{}, kVoxel);
  const SampledBody point({{Vector3::Zero()}, {Vector3::UnitZ()}}, Vector3::Zero());
  Pose start;
  start.translation = Vector3(0.1, 0.2, 0.25);
  start.rotation = exp_rotation(Vector3(0.3, 0.2, 0.1));
  AnalyticRun<AnalyticField, CorrectedCycle<false>> run(floor, point, start);
  run.parameters.safety_distance = 0.25;
  const Pose device = start * set_matrix({Vector3(0.001, 0.002, -0.003), Vector3(0.01, 0.02, 0.03)});
  ASSERT_EQ(run.step(device), Status::kOk);
  EXPECT_TRUE(run.state.H_WS == device);
  EXPECT_EQ(run.report.outcome, Outcome::kFree);
  EXPECT_EQ(run.report.contacts, 0u);
}

/// By hand: free air 13 mm below the ball, d = 3 mm. The device dives through the floor: 1.5 mm plus the distance to
/// the layer in the first sub-step, then 1.5 mm at most in each of seven.
TEST(Corrected, SplitsADiveIntoEightSubsteps) {
  const AnalyticField floor(HalfSpace{}, kVoxel);
  const SampledBody ball = ball_body();
  Pose start;
  start.translation.z() = 0.033;
  AnalyticRun<AnalyticField, CorrectedCycle<false>> run(floor, ball, start);
  Pose device = start;
  device.translation.z() = -0.5;
  ASSERT_EQ(run.step(device), Status::kOk);
  EXPECT_LE(run.report.substeps, kMaxSubsteps);
  EXPECT_NEAR(run.depth(), 0.0, 0.1 * kVoxel) << "it stops at the floor";
  // along the floor the motion is never done: eight sub-steps, 1.5 mm each, and the rest waits
  device.translation = Vector3(0.5, 0.0, 0.0);
  const double before = run.state.H_WS.translation.x();
  ASSERT_EQ(run.step(device), Status::kOk);
  EXPECT_EQ(run.report.substeps, 8u);
  EXPECT_EQ(run.report.outcome, Outcome::kCut);
  EXPECT_NEAR(run.state.H_WS.translation.x() - before, 8.0 * 0.0015, 1e-5);
}

TEST(Corrected, ChangesNoMemoryIfTheCycleFails) {
  const AnalyticField floor(HalfSpace{}, kVoxel);
  const SampledBody ball = ball_body();
  Pose start;
  start.translation.z() = 0.019;
  AnalyticRun<AnalyticField, CorrectedCycle<true>> run(floor, ball, start);
  run.parameters.friction = {0.2, 0.18, 0.0};
  Pose device = start;
  device.translation += Vector3(0.0003, 0.0, -0.001);
  Motion velocity;
  velocity.translation.setConstant(-1.5e308);
  run.parameters.damping = 1e9;
  const ProjectionState before = run.cycle.memory;
  ASSERT_EQ(run.step(device, velocity), Status::kNotFinite);
  EXPECT_EQ(run.cycle.memory.slipping, before.slipping);
  EXPECT_EQ(run.cycle.memory.wanted.translation, before.wanted.translation);
  EXPECT_TRUE(run.state.H_WS == start);
  ASSERT_EQ(run.step(device), Status::kOk);
  EXPECT_FALSE(run.cycle.memory.wanted.translation.isZero(0.0));
}

/// A clock that advances by 1 ns a reading, and by 1 us a look-up of the field below.
std::int64_t clock_ns = 0;
std::int64_t read_clock() noexcept { return ++clock_ns; }

class SlowField : public AnalyticField {
 public:
  using AnalyticField::AnalyticField;
  FieldSample sample(const Vector3& p) const noexcept {
    clock_ns += 1000;
    return AnalyticField::sample(p);
  }
  LayerSample layer(const Vector3& p) const noexcept {
    clock_ns += 1000;
    return AnalyticField::layer(p);
  }
  double lower_bound(const Vector3& center, double radius) const noexcept {
    clock_ns += 1000;
    return AnalyticField::lower_bound(center, radius);
  }
};

/// Expects that the look-ups are step #1 and that each interval has one reading of the clock.
template <class Cycle>
void expect_times(Cycle cycle, bool is_paper) {
  const SlowField floor(HalfSpace{}, kVoxel);
  const SampledBody ball = ball_body(0.02, 100);
  Parameters q;
  q.mass = ball.mass;
  ProxyState state;
  state.started = true;
  state.H_WS.translation.z() = 0.021;
  CycleInput input;
  input.H_WD = state.H_WS;
  for (const double slide : {0.0, 1e-4, 0.004, 0.02}) {
    input.H_WD.translation += Vector3(slide, 0.0, -1e-4);
    CycleReport report;
    StepTimes times;
    times.now_ns = &read_clock;
    times.step1_ns = times.solve_ns = times.since_ns = 1234567;
    clock_ns = 10'000'000;
    ASSERT_EQ(cycle(floor, ball.pointshell(), q, input, state, report, &times), Status::kOk);
    const std::int64_t intervals = is_paper ? 1 : report.substeps;
    EXPECT_EQ(times.solve_ns, intervals) << slide;
    EXPECT_EQ(times.step1_ns % 1000, intervals) << slide;
    EXPECT_EQ(times.step1_ns + times.solve_ns, clock_ns - 10'000'001) << "all of the time since the first reading";
    ASSERT_EQ(cycle(floor, ball.pointshell(), q, input, state, report, nullptr), Status::kOk);
  }
}

TEST(StepTimes, CountTheLookUpsOfPaper) {
  expect_times([](auto&&... arguments) { return paper_cycle<false>(arguments...); }, true);
}

TEST(StepTimes, CountTheLookUpsOfCorrected) {
  ProjectionState memory;
  expect_times(
      [&](const SlowField& field, const Pointshell& shell, const Parameters& q, const CycleInput& input,
          ProxyState& state, CycleReport& report,
          StepTimes* times) { return corrected_cycle<false>(field, shell, q, input, memory, state, report, times); },
      false);
}

TEST(StepTimes, BeginAtZero) {
  const StepTimes times;
  EXPECT_EQ(times.now_ns, nullptr);
  EXPECT_EQ(times.step1_ns + times.solve_ns + times.since_ns, 0);
}

}  // namespace
}  // namespace godobject::test::corrected_cycle_test
