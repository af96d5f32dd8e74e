// The sub-steps of one cycle: the path, the motion that the next cycle starts from, and the report agree; a cycle goes
// on past an edge.

#include "core/pipeline/contact/contact_substeps.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/pipeline/contact/contact_cycle.h"
#include "tests/support/analytic_worlds.h"
#include "tests/support/edge_set.h"
#include "tests/support/random.h"

namespace godobject::test::contact_substeps_test {
namespace {

constexpr double kSubstepVoxel = 0.002;
constexpr double kSubstepMargin = 2e-5;

/// A box about the origin with its exact distance.
struct Block {
  Vector3 half_edges{0.02, 0.02, 0.01};
  double distance(const Vector3& p) const noexcept { return analytic::box_distance(p, half_edges); }
  Vector3 gradient(const Vector3& p) const noexcept {
    const Vector3 beyond = (p.cwiseAbs() - half_edges).cwiseMax(0.0);
    Vector3 out = beyond.norm() > 0.0 ? Vector3(beyond.normalized()) : Vector3::Zero();
    if (out.isZero(0.0)) {
      int axis = 0;
      (p.cwiseAbs() - half_edges).maxCoeff(&axis);
      out[axis] = 1.0;
    }
    for (int axis = 0; axis < 3; ++axis) out[axis] = std::copysign(out[axis], p[axis]);
    return out;
  }
};

Pose pose_at(const Vector3& position, const Vector3& turn = Vector3::Zero()) {
  Pose pose;
  pose.translation = position;
  pose.rotation = exp_rotation(turn);
  return pose;
}

template <bool kFriction = false>
struct SubstepRun : AnalyticRun<AnalyticField, ContactCycle<kFriction>> {
  using Base = AnalyticRun<AnalyticField, ContactCycle<kFriction>>;
  SubstepRun(const AnalyticField& f, const SampledBody& b, const Pose& start) : Base(f, b, start) {
    this->parameters.margin = kSubstepMargin;
    this->parameters.friction = {0.2, 0.18, 0.0};
  }
  const ContactMemory& memory() const { return *this->cycle.memory; }
};

/// Counts of the cycles of a run, by what happened in them.
struct Seen {
  int free = 0, held = 0, cut = 0, several = 0, far = 0;
};

/// Runs a box about a block, with jumps, and expects that the path, the stored motion and the report of each cycle
/// describe the same motion.
template <bool kFriction>
Seen expect_one_story(unsigned seed, const WorkspaceBox& workspace) {
  Random random(seed);
  const AnalyticField field(Block{}, kSubstepVoxel);
  const SampledBody body = box_body(4);
  SubstepRun<kFriction> run(field, body, pose_at({0.0, 0.0, 0.06}));
  run.parameters.workspace = workspace;
  Pose device = run.state.H_WS;
  Motion velocity;
  Seen seen;
  for (int cycle = 0; cycle < 600; ++cycle) {
    if (cycle % 30 == 0) velocity = random.motion(std::pow(10.0, random.between(-5.0, -2.3)), 0.05);
    if (cycle % 150 == 149) device = pose_at(random.in_cube(0.07), random.in_cube(1.0));
    device = device * set_matrix(velocity);
    if (device.translation.norm() > 0.08) device.translation *= 0.9;
    const Pose before = run.state.H_WS;
    EXPECT_EQ(run.step(device), Status::kOk);
    const Pose followed{device.rotation, workspace.nearest(device.translation)};
    const auto path = run.memory().path.poses();
    EXPECT_FALSE(path.empty());
    if (path.empty()) return seen;
    // the stored motion is the sum of the motions of the sub-steps, each in the frame of its start; that of a free
    // cycle is the motion to the device
    Motion sum;
    Pose from = before;
    for (const Pose& to : path) {
      const Motion part = get_motion(from.inverse() * to);
      sum.translation += part.translation;
      sum.rotation += part.rotation;
      from = to;
    }
    const ConstrainedStep& last = run.memory().last_step;
    EXPECT_TRUE(from == run.state.H_WS);
    const auto stored = [&last](const Motion& motion) {
      return (last.motion.translation - motion.translation).norm() < 1e-9 &&
             (last.motion.rotation - motion.rotation).norm() < 1e-8;
    };
    const bool ends_free = path.size() > 1 && last.follows && from == followed;
    const Motion wanted = get_motion(before.inverse() * followed);
    EXPECT_TRUE(stored(sum) || (ends_free && stored(wanted))) << cycle;
    EXPECT_TRUE(run.memory().H_WD_last == followed);
    // the report is that of the last sub-step
    EXPECT_EQ(run.report.contacts, last.contact_count);
    EXPECT_EQ(last.force_count > 0, last.contact_count > 0);
    EXPECT_LE(last.contact_count, last.force_count);
    EXPECT_GE(run.report.substeps, 1u);
    EXPECT_LE(run.report.substeps, kMaxSubsteps);
    EXPECT_LE(run.report.substeps, std::max<std::size_t>(1, path.size()));
    const bool at_device = run.state.H_WS == followed;
    if (at_device && last.force_count == 0) {
      EXPECT_EQ(run.report.outcome, Outcome::kFree) << cycle;
      const Vector3 push = run.parameters.stiffness * (followed.translation - device.translation);
      EXPECT_LT((run.report.force.spring_W.force - push).norm(), 1e-9) << "of the faces";
      ++seen.free;
    }
    if (run.report.outcome == Outcome::kFree) {
      EXPECT_TRUE(at_device) << cycle;
    }
    EXPECT_LT(run.depth(), 0.0) << cycle;
    if (::testing::Test::HasFailure()) return seen;
    seen.held += run.report.outcome == Outcome::kContact ? 1 : 0;
    seen.cut += run.report.outcome == Outcome::kCut ? 1 : 0;
    seen.several += path.size() > 1 ? 1 : 0;
    seen.far += path.size() > 1 && sum.rotation.norm() > 1e-3 && sum.translation.norm() > 1e-4 ? 1 : 0;
  }
  return seen;
}

TEST(ContactSubsteps, StoreTheMotionOfTheWholeCycle) {
  const double inf = std::numeric_limits<double>::infinity();
  const WorkspaceBox above{true, {-0.03, -inf, -0.01}, {0.05, inf, inf}};
  Seen all;
  const auto add = [&all](const Seen& seen) {
    all.free += seen.free;
    all.held += seen.held;
    all.cut += seen.cut;
    all.several += seen.several;
    all.far += seen.far;
  };
  for (const unsigned seed : {1u, 2u}) {
    add(expect_one_story<false>(seed, {}));
    add(expect_one_story<true>(seed, {}));
    add(expect_one_story<false>(seed, above));
    add(expect_one_story<true>(seed, above));
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
  std::printf("[ measured ] free %d held %d cut %d several %d far %d\n", all.free, all.held, all.cut, all.several,
              all.far);
  EXPECT_GT(all.free, 500);
  EXPECT_GT(all.held, 500);
  EXPECT_GT(all.cut, 10);
  EXPECT_GT(all.several, 300);
  EXPECT_GT(all.far, 100);
}

/// A box slides on a floor. In a cycle whose budget of work is spent before its first motion it stays, and the stored
/// motion is zero, not that of the cycle before. Its forces stay, so that the hand feels no jump.
template <bool kFriction>
void expect_no_motion_without_work() {
  const AnalyticField field(HalfSpace{Vector3::UnitZ(), 0.0}, kSubstepVoxel);
  const SampledBody body = box_body(4);
  SubstepRun<kFriction> run(field, body, pose_at({0.0, 0.0, 0.015 + kSubstepMargin}));
  const auto device = [](int cycle) { return pose_at({1e-4 * cycle, 0.0, 0.0149}); };
  for (int cycle = 1; cycle <= 20; ++cycle) {
    const bool has_work = cycle % 5 != 0;
    run.parameters.work_budget = has_work ? WorkMeter::kUnlimited : 1;
    const Pose before = run.state.H_WS;
    ASSERT_EQ(run.step(device(cycle)), Status::kOk);
    const ConstrainedStep& last = run.memory().last_step;
    EXPECT_GT(last.force_count, 0u) << cycle;
    EXPECT_EQ(run.report.out_of_work, !has_work) << cycle;
    if (has_work) {
      EXPECT_GT(last.motion.translation.x(), 0.5e-4) << cycle;
      continue;
    }
    EXPECT_TRUE(run.state.H_WS == before) << cycle;
    EXPECT_EQ(last.motion.translation, Vector3::Zero()) << cycle;
    EXPECT_EQ(last.motion.rotation, Vector3::Zero()) << cycle;
  }
}
TEST(ContactSubsteps, StoreNoMotionWithoutWork) { expect_no_motion_without_work<false>(); }
TEST(ContactSubsteps, StoreNoMotionWithoutWorkWithFriction) { expect_no_motion_without_work<true>(); }

/// The same for a box that has followed the device over the floor: it stays behind, and the stored motion is not the
/// way to the device.
template <bool kFriction>
void expect_no_motion_without_work_after_a_free_cycle() {
  const AnalyticField field(HalfSpace{Vector3::UnitZ(), 0.0}, kSubstepVoxel);
  const SampledBody body = box_body(4);
  SubstepRun<kFriction> run(field, body, pose_at({0.0, 0.0, 0.03}));
  for (int cycle = 1; cycle <= 20; ++cycle) {
    const bool has_work = cycle % 5 != 0;
    run.parameters.work_budget = has_work ? WorkMeter::kUnlimited : 1;
    const Pose before = run.state.H_WS;
    const Pose device = pose_at({1e-4 * cycle, 0.0, 0.03});
    ASSERT_EQ(run.step(device), Status::kOk);
    EXPECT_EQ(run.report.out_of_work, !has_work) << cycle;
    EXPECT_TRUE(run.state.H_WS == (has_work ? device : before)) << cycle;
    const ConstrainedStep& last = run.memory().last_step;
    EXPECT_EQ(last.follows, has_work) << cycle;
    const Motion moved = get_motion(before.inverse() * run.state.H_WS);
    EXPECT_LT((last.motion.translation - moved.translation).norm(), 1e-12) << cycle;
    EXPECT_LT(last.motion.rotation.norm(), 1e-12) << cycle;
  }
}
TEST(ContactSubsteps, StoreNoMotionWithoutWorkAfterAFreeCycle) {
  expect_no_motion_without_work_after_a_free_cycle<false>();
}
TEST(ContactSubsteps, StoreNoMotionWithoutWorkAfterAFreeCycleWithFriction) {
  expect_no_motion_without_work_after_a_free_cycle<true>();
}

/// A point falls onto a floor in one cycle, in any number of sub-steps: at first none finds the floor, then some do.
/// The stored motion is the whole fall.
TEST(ContactSubsteps, StoreTheWholeFallOfAPoint) {
  const AnalyticField field(HalfSpace{}, kSubstepVoxel);
  const SampledBody body({{Vector3::Zero()}, {-Vector3::UnitZ()}}, Vector3::Constant(4e-5));
  int several = 0;
  for (double height = 1e-4; height < 5e-3; height *= 1.1) {
    SubstepRun<> run(field, body, pose_at({0.0, 0.0, height}));
    const Vector3 before = run.state.H_WS.translation;
    ASSERT_EQ(run.step(pose_at({0.0, 0.0, -1e-3})), Status::kOk);
    const Vector3 fall = run.state.H_WS.translation - before;
    EXPECT_LT((run.memory().last_step.motion.translation - fall).norm(), 1e-12) << height;
    EXPECT_NEAR(run.state.H_WS.translation.z(), kSubstepMargin, 0.1 * kSubstepMargin) << height;
    several += run.memory().path.poses().size() > 1 ? 1 : 0;
  }
  EXPECT_GT(several, 10);
}

/// The rows are linear in the rotation. A body that is held, be it at a single point, turns by at most 0.1 rad in a
/// sub-step.
TEST(ContactSubsteps, TurnABodyThatOnePointHoldsInShortSteps) {
  const AnalyticField field(HalfSpace{}, kSubstepVoxel);
  const SampledBody body({{Vector3::Zero()}, {-Vector3::UnitZ()}}, Vector3::Constant(4e-5));
  SubstepRun<> run(field, body, pose_at({0.0, 0.0, kSubstepMargin}));
  const Pose device = pose_at({0.0, 0.0, -1e-3}, {0.3, -0.2, 0.35});
  for (int cycle = 0; cycle < 3; ++cycle) {
    Pose from = run.state.H_WS;
    ASSERT_EQ(run.step(device), Status::kOk);
    EXPECT_EQ(run.report.contacts, 1u);
    for (const Pose& to : run.memory().path.poses()) {
      EXPECT_LT(get_motion(from.inverse() * to).rotation.norm(), 0.1 + 1e-9) << cycle;
      from = to;
    }
  }
  EXPECT_LT(get_motion(run.state.H_WS.inverse() * device).rotation.norm(), 1e-9) << "nothing holds the turn";
}

/// A floor, and a wall beside it across x. The field knows the nearer one.
struct FloorBesideAWall {
  double wall;
  double distance(const Vector3& p) const noexcept { return std::min(p.z(), wall - p.x()); }
  Vector3 gradient(const Vector3& p) const noexcept {
    return p.z() < wall - p.x() ? Vector3(Vector3::UnitZ()) : Vector3(-Vector3::UnitX());
  }
};

/// The same where a second look has found a wall, after which the way is short, but the turn is not.
TEST(ContactSubsteps, TurnABodyInShortStepsAfterASecondLook) {
  const SampledBody body({{Vector3::Zero()}, {-Vector3::UnitZ()}}, Vector3::Constant(4e-5));
  const Pose device = pose_at({2e-3, 0.0, -1e-3}, {0.3, -0.2, 0.35});
  for (const double wall : {1.1e-4, 1.5e-4, 1.9e-4}) {
    const AnalyticField field(FloorBesideAWall{wall}, kSubstepVoxel);
    SubstepRun<> run(field, body, pose_at({0.0, 0.0, kSubstepMargin}));
    for (int cycle = 0; cycle < 4; ++cycle) {
      Pose from = run.state.H_WS;
      ASSERT_EQ(run.step(device), Status::kOk);
      for (const Pose& to : run.memory().path.poses()) {
        EXPECT_LT(get_motion(from.inverse() * to).rotation.norm(), 0.1 + 1e-9) << wall << ' ' << cycle;
        from = to;
      }
    }
    EXPECT_LT(get_motion(run.state.H_WS.inverse() * device).rotation.norm(), 1e-6) << "nothing holds the turn";
    EXPECT_NEAR(run.state.H_WS.translation.x(), wall - kSubstepMargin, 0.5 * kSubstepMargin);
    EXPECT_LT(run.depth(), 0.0);
  }
}

/// A floor, and beside it a slot, in whose middle the field has no direction.
struct FloorBesideASlot {
  static constexpr double kMiddle = -0.01;
  static bool in_slot(const Vector3& p) noexcept { return p.x() < 0.5 * kMiddle; }
  double distance(const Vector3& p) const noexcept { return in_slot(p) ? 5e-5 - std::fabs(p.x() - kMiddle) : p.z(); }
  Vector3 gradient(const Vector3& p) const noexcept {
    if (!in_slot(p)) return Vector3::UnitZ();
    const double off = p.x() - kMiddle;
    return std::fabs(off) < 1e-6 ? Vector3::Zero() : Vector3(off > 0.0 ? -1.0 : 1.0, 0.0, 0.0);
  }
};

/// More near points than rows lie where the field has no direction, so that they need none. They take no row from the
/// three feet on which the body comes to stand: it does so in one sub-step.
TEST(ContactSubsteps, LeaveTheRowsToPointsWithADirection) {
  const AnalyticField field(FloorBesideASlot{}, kSubstepVoxel);
  SurfaceSamples samples;
  for (std::uint32_t i = 0; i < ContactRows::kCapacity + 100; ++i) {
    samples.points.push_back({FloorBesideASlot::kMiddle, 1e-3 * (i % 50) - 0.0245, 1e-3 * (i / 50)});
  }
  samples.points[1] = Vector3(0.006, -0.006, 0.0);
  samples.points[2] = Vector3(0.006, 0.006, 0.0);
  samples.points[3] = Vector3(-0.004, 0.0, 0.0);
  samples.normals.assign(samples.points.size(), Vector3::UnitZ());
  const SampledBody body(samples, Vector3::Constant(4e-4));
  SubstepRun<> run(field, body, pose_at({0.0, 0.0, 1e-4}));
  ASSERT_EQ(run.step(pose_at({0.0, 0.0, -2e-4})), Status::kOk);
  EXPECT_EQ(run.report.substeps, 1u);
  EXPECT_EQ(run.report.dropped, 0u);
  EXPECT_EQ(run.report.outcome, Outcome::kContact);
  EXPECT_NEAR(run.state.H_WS.translation.z(), kSubstepMargin, 0.01 * kSubstepMargin);
}

/// The time of a look-up at TickingBlock.
std::int64_t ticks_of_block = 0;
std::int64_t block_clock() noexcept { return ticks_of_block; }

/// A block at which each look-up takes a nanosecond of `block_clock`. Nothing else takes time.
struct TickingBlock : Block {
  double distance(const Vector3& p) const noexcept {
    ++ticks_of_block;
    return Block::distance(p);
  }
};

/// Cycles of a box about a field, with the times of their steps.
struct TimedRun {
  TimedRun(const AnalyticField& field, std::int64_t (*clock)() noexcept, double height)
      : scene(field, shell, {}, parameters()) {
    memory->search.start(scene, {});
    state.H_WS = memory->H_WD_last = pose_at({0.0, 0.0, height});
    state.started = true;
    times.now_ns = clock;
  }

  const Parameters& parameters() {
    q.mass = body.mass;
    q.voxel_size = kSubstepVoxel;
    q.margin = kSubstepMargin;
    return q;
  }
  Status step(const Pose& device) {
    CycleInput input;
    input.H_WD = device;
    return contact_cycle<false>(scene, input, *memory, state, report, &times);
  }

  SampledBody body = box_body(4);
  Pointshell shell = body.pointshell();
  Parameters q;
  ContactScene<AnalyticField, NoBodyField> scene;
  std::unique_ptr<ContactMemory> memory = std::make_unique<ContactMemory>();
  ProxyState state;
  CycleReport report;
  StepTimes times;
};

/// Step #1 contains every look-up, also those of the certificate, and nothing else does.
TEST(ContactSubsteps, CountTheTimeOfEachLookUpAsStep1) {
  const AnalyticField field(TickingBlock{}, kSubstepVoxel);
  TimedRun run(field, block_clock, 0.03);
  int held = 0, several = 0;
  for (int i = 0; i < 200; ++i) {
    const double t = 0.02 * i;
    const std::int64_t before = ticks_of_block;
    ASSERT_EQ(run.step(pose_at({0.02 * std::sin(t), 0.015 * std::sin(1.3 * t), 0.022},
                               {0.2 * std::sin(0.7 * t), 0.2 * std::sin(0.9 * t), 0.3 * t})),
              Status::kOk);
    EXPECT_EQ(run.times.step1_ns, ticks_of_block - before) << i;
    EXPECT_EQ(run.times.solve_ns, 0) << i;
    held += run.report.contacts > 0 ? 1 : 0;
    several += run.memory->path.poses().size() > 1 ? 1 : 0;
  }
  EXPECT_GT(held, 50);
  EXPECT_GT(several, 0);
}

std::int64_t readings = 0;
std::int64_t reading_clock() noexcept { return ++readings; }

/// Whatever a cycle does, its time since the first reading of the clock belongs to one of the steps.
TEST(ContactSubsteps, CountTheTimeOfTheLastStepToo) {
  const AnalyticField field(Block{}, kSubstepVoxel);
  TimedRun run(field, reading_clock, 0.05);
  for (const double height : {0.05, 0.0501, 0.05, 0.022, 0.02}) {
    const std::int64_t before = readings;
    ASSERT_EQ(run.step(pose_at({0.0, 0.0, height})), Status::kOk);
    EXPECT_EQ(run.times.step1_ns + run.times.solve_ns, readings - before - 1) << height;
    EXPECT_GT(run.times.solve_ns, 0) << height;
  }
}

/// A point slides on the top of a block and past its edge. The device is 0.3 mm below the top. Beyond the edge nothing
/// holds the point: in the same cycle it goes to the device.
TEST(ContactSubsteps, GoDownToTheDevicePastAnEdgeInTheSameCycle) {
  const AnalyticField field(Block{}, kSubstepVoxel);
  const SampledBody body({{Vector3::Zero()}, {-Vector3::UnitZ()}}, Vector3::Constant(4e-5));
  for (const double begin : {0.0, 1e-4, 2.5e-4, 4e-4}) {
    SubstepRun<> run(field, body, pose_at({0.018 + begin, 0.0, 0.0101}));
    for (int i = 1; i < 10; ++i) {
      const double x = 0.018 + begin + 5e-4 * i;
      ASSERT_EQ(run.step(pose_at({x, 0.0, 0.0097})), Status::kOk);
      const Vector3 here = run.state.H_WS.translation;
      ASSERT_NEAR(here.x(), x, 1e-7) << "without friction it keeps up";
      if (x < 0.02 - 1e-9) {
        EXPECT_NEAR(here.z(), 0.01 + kSubstepMargin, 0.1 * kSubstepMargin) << x;
        EXPECT_EQ(run.report.outcome, Outcome::kContact);
      } else if (x > 0.02 + 1e-4) {
        EXPECT_NEAR(here.z(), 0.0097, 1e-9) << x;
        EXPECT_EQ(run.report.outcome, Outcome::kFree) << x;
        EXPECT_EQ(run.report.contacts, 0u);
      }
    }
  }
}

/// The same with a jump, of any length, past the edge. A search radius may end the first sub-step shortly before the
/// device; from there the way is free. A cycle that ends at the device has no contact and no damping.
TEST(ContactSubsteps, HaveNoContactWhereTheyEndAtTheDevice) {
  const AnalyticField field(Block{}, kSubstepVoxel);
  const SampledBody body({{Vector3::Zero()}, {-Vector3::UnitZ()}}, Vector3::Constant(4e-5));
  for (int k = 10; k < 30; ++k) {
    const double jump = 5e-5 * k;
    SubstepRun<> run(field, body, pose_at({0.0187, 0.0, 0.01 + kSubstepMargin}));
    for (int i = 1; i <= 3; ++i) ASSERT_EQ(run.step(pose_at({0.0187 + 4e-4 * i, 0.0, 0.0098})), Status::kOk);
    ASSERT_EQ(run.report.contacts, 1u);
    const Pose device = pose_at({0.0199 + jump, 0.0, 0.0098});
    ASSERT_EQ(run.step(device, {{0.0, 0.0, -0.1}, Vector3::Zero()}), Status::kOk);
    EXPECT_LT((run.state.H_WS.translation - device.translation).norm(), 1e-9) << jump;
    EXPECT_EQ(run.report.contacts, 0u) << jump;
    EXPECT_EQ(run.report.outcome, Outcome::kFree) << jump;
    EXPECT_LT(run.report.force.total_W.force.norm(), 1e-4) << jump;
    EXPECT_EQ(run.memory().last_step.force_count, 0u) << jump;
  }
}

/// A flat face of 2048 points, as many as there are rows, lies on a floor at half of the margin. The workspace ends
/// there, so that no motion regains the gap. The six faces of the workspace take the place of six rows.
template <bool kFriction>
void expect_rows_to_give_way_to_the_faces() {
  const AnalyticField field(HalfSpace{}, kSubstepVoxel);
  SurfaceSamples face;
  for (int i = 0; i < 2048; ++i) {
    face.points.push_back({1e-3 * (i % 64 - 31.5), 1e-3 * (i / 64 - 15.5), -0.015});
    face.normals.push_back(Vector3::UnitZ());
  }
  const SampledBody body(face, Vector3::Constant(4e-4));
  const double height = 0.015 + 0.5 * kSubstepMargin;
  SubstepRun<kFriction> run(field, body, pose_at({0.0, 0.0, height}));
  const double inf = std::numeric_limits<double>::infinity();
  run.parameters.workspace = {true, {-inf, -inf, -inf}, {inf, inf, height}};
  for (int i = 1; i <= 20; ++i) {
    ASSERT_EQ(run.step(pose_at({1e-5 * i, 0.0, height})), Status::kOk);
    EXPECT_EQ(run.report.dropped, 6u) << i;
    EXPECT_EQ(run.report.outcome, Outcome::kInfeasible) << i;
    EXPECT_FALSE(run.report.unconverged);
    ASSERT_LE(run.state.H_WS.translation.z(), height);
    EXPECT_NEAR(run.state.H_WS.translation.z(), height, 1e-7) << "no gap below the margin shrinks";
    EXPECT_NEAR(run.state.H_WS.translation.x(), 1e-5 * i, 1e-7) << "the faces do not hold it back";
    for (std::uint32_t k = 0; k < run.memory().last_step.force_count; ++k) {
      EXPECT_LT(run.memory().last_step.forces[k].id, 2048u) << "no force of a face";
    }
  }
}
TEST(ContactSubsteps, GiveWayToTheFacesOfTheWorkspace) { expect_rows_to_give_way_to_the_faces<false>(); }
TEST(ContactSubsteps, GiveWayToTheFacesOfTheWorkspaceWithFriction) { expect_rows_to_give_way_to_the_faces<true>(); }

/// A slope that rises against the x axis.
const Vector3 kRamp(0.6, 0.0, 0.8);

/// A slope pushes a body against a face of the workspace. The face stops it there with friction, too, however the body
/// is turned.
TEST(ContactSubsteps, StopAtAFaceOfTheWorkspaceHoweverTheBodyIsTurned) {
  const AnalyticField field(HalfSpace{kRamp, 0.0}, kSubstepVoxel);
  const SampledBody body({{Vector3::Zero()}, {-Vector3::UnitZ()}}, Vector3::Constant(4e-5));
  const double inf = std::numeric_limits<double>::infinity();
  for (const Vector3& turn : {Vector3(0.0, 0.0, 0.0), Vector3(0.0, 0.0, 0.5 * M_PI), Vector3(0.0, -0.5 * M_PI, 0.0),
                              Vector3(0.4, -0.7, 1.1)}) {
    SubstepRun<true> run(field, body, pose_at({0.0, 0.0, kSubstepMargin / 0.8}, turn));
    run.parameters.friction = {0.18, 0.18, 0.0};
    run.parameters.workspace = {true, {-inf, -inf, -inf}, {0.001, inf, inf}};
    ASSERT_EQ(run.step(pose_at({0.001, 0.0, -0.008}, turn)), Status::kOk);
    EXPECT_FALSE(run.report.unconverged) << turn.transpose();
    const Vector3 at_face(0.001, 0.0, (kSubstepMargin - 0.6 * 0.001) / 0.8);
    EXPECT_LT((run.state.H_WS.translation - at_face).norm(), 1e-6) << turn.transpose();
  }
}

/// The gap between two parallel ramps.
struct RampedSlot {
  double half_width;
  double distance(const Vector3& p) const noexcept { return half_width - std::fabs(kRamp.dot(p)); }
  Vector3 gradient(const Vector3& p) const noexcept { return kRamp.dot(p) > 0.0 ? Vector3(-kRamp) : kRamp; }
};

/// Walls closer than twice the margin push against each other, and push the body against a face of the workspace.
/// That the walls have no common solution is said whatever the face needs.
TEST(ContactSubsteps, CallWallsInfeasibleAtAFaceOfTheWorkspaceWithFriction) {
  const double gap = 0.5 * kSubstepMargin;
  const AnalyticField field(RampedSlot{0.015 + gap}, kSubstepVoxel);
  const SampledBody body({{0.015 * kRamp, -0.015 * kRamp}, {-kRamp, kRamp}}, Vector3::Constant(4e-5));
  const double inf = std::numeric_limits<double>::infinity();
  SubstepRun<true> run(field, body, Pose{});
  run.parameters.friction = {0.1, 0.1, 0.0};
  run.parameters.workspace = {true, {-inf, -inf, -inf}, {0.001, inf, inf}};
  for (int i = 0; i < 3; ++i) {
    ASSERT_EQ(run.step(pose_at({0.001, 0.0, -0.008})), Status::kOk);
    EXPECT_EQ(run.report.outcome, Outcome::kInfeasible) << i;
    ASSERT_LE(run.state.H_WS.translation.x(), 0.001) << i;
    ASSERT_LT(run.depth(), -0.9 * gap) << i;
  }
}

/// A body that starts between walls that push against each other is nowhere held: no contact, no damping, and nothing
/// for the next cycle. The device is in the middle, so that the spring hardly stretches.
TEST(ContactSubsteps, LeaveNoContactWhereWallsPushAgainstEachOther) {
  const AnalyticField field(Slot{0.018}, kSubstepVoxel);
  const SampledBody body = ball_body();
  SubstepRun<true> run(field, body, Pose{});
  run.state.started = false;
  run.state.inside = true;
  for (int i = 0; i < 10; ++i) {
    ASSERT_EQ(run.step(pose_at({0.0, 0.0, 1e-3 * i}), {{0.1, 0.2, 0.3}, {1.0, 2.0, 3.0}}), Status::kOk);
    EXPECT_EQ(run.report.outcome, Outcome::kStartInside);
    EXPECT_EQ(run.report.force.total_W.force, run.report.force.spring_W.force);
    EXPECT_EQ(run.report.force.total_W.torque, run.report.force.spring_W.torque);
    EXPECT_LT(run.report.force.total_W.force.norm(), 0.02);
    EXPECT_EQ(run.report.contacts, 0u);
    EXPECT_EQ(run.memory().last_step.force_count, 0u);
    EXPECT_FALSE(run.memory().last_step.infeasible);
    ASSERT_EQ(run.memory().path.poses().size(), 1u);
  }
}

/// A floor, a wall beside the point `kUpper`, and just behind the wall's distance a ceiling that rises slowly along x.
struct LowNiche {
  static constexpr double kUpper = 0.009;
  Vector3 ceiling{0.1, 0.0, -std::sqrt(0.99)};
  double above = ceiling.z() * kUpper - 6e-5;

  double distance(const Vector3& p) const noexcept { return std::min({p.z(), p.y() + 5e-5, ceiling.dot(p) - above}); }
  Vector3 gradient(const Vector3& p) const noexcept {
    if (distance(p) == p.z()) return Vector3::UnitZ();
    return distance(p) == p.y() + 5e-5 ? Vector3::UnitY() : ceiling;
  }
};

/// The lower end of a stick starts inside a floor and regains a share of its depth; then the upper end would meet a
/// ceiling that the field at the start does not show. A way along the ceiling leads ten times as far aside. Such a
/// second look, which leads away from the device, is not taken.
TEST(ContactSubsteps, TakeNoSecondLookThatLeadsAwayFromTheDevice) {
  const double depth = 1e-3;
  const AnalyticField field(LowNiche{}, kSubstepVoxel);
  const SampledBody body(
      {{Vector3::Zero(), Vector3(0.0, 0.0, LowNiche::kUpper + depth)}, {Vector3::UnitZ(), -Vector3::UnitZ()}},
      Vector3::Constant(4e-5));
  SubstepRun<> run(field, body, pose_at({0.0, 0.0, -depth}));
  run.state.started = false;
  run.state.inside = true;
  run.cycle.memory->last_step.motion.translation = Vector3::UnitX();  // long: the longest search radius
  const Pose device = pose_at({0.0, 1e-4, -depth});
  ASSERT_EQ(run.step(device), Status::kOk);
  EXPECT_EQ(run.report.outcome, Outcome::kStartInside);
  const Vector3 moved = run.state.H_WS.translation - Vector3(0.0, 0.0, -depth);
  EXPECT_GT(moved.z(), 0.0) << "it comes out";
  EXPECT_GT(moved.y(), 0.0) << "towards the device";
  EXPECT_LT(std::fabs(moved.x()), kSubstepMargin) << "not aside";
  const double regained = kRecovery * (depth + kSubstepMargin);
  EXPECT_LT((run.state.H_WS.translation - device.translation).norm(), regained + kSubstepMargin);
}

/// Two walls that stand almost face to face across x. The slot between them opens along z, slowly.
struct OpeningSlot {
  static constexpr double kSlope = 2e-4;
  double half_width;
  double distance(const Vector3& p) const noexcept { return half_width + kSlope * p.z() - std::fabs(p.x()); }
  Vector3 gradient(const Vector3& p) const noexcept { return {p.x() > 0.0 ? -1.0 : 1.0, 0.0, kSlope}; }
};

/// A body has lost a quarter of both gaps. It could regain 1.5 um of each only 7.5 mm along the slot, and of one only
/// half as far. Such rows count as contradictory: no gap shrinks, and the body stays with the device, whichever side
/// has the first row.
TEST(ContactSubsteps, StayInASlotThatOpensTooSlowlyToRegainItsMargins) {
  const AnalyticField field(OpeningSlot{0.015 + 0.75 * kSubstepMargin}, kSubstepVoxel);
  const Vector3 right(0.015, 0.0, 0.0);
  for (const double side : {-1.0, 1.0}) {
    const SampledBody body({{side * right, -side * right}, {-side * Vector3::UnitX(), side * Vector3::UnitX()}},
                           Vector3::Constant(4e-4));
    SubstepRun<> run(field, body, Pose{});
    for (int i = 1; i <= 3; ++i) {
      const Pose device = pose_at({0.0, 1e-4 * i, 0.0});
      ASSERT_EQ(run.step(device), Status::kOk);
      EXPECT_LT((run.state.H_WS.translation - device.translation).norm(), 1e-7) << side << ' ' << i;
    }
  }
}

/// Two faces of 2500 points each, more than there are rows, between walls closer than twice the margin: no motion
/// regains both margins. The device turns, so that points without a row have to be added, and no gap shrinks.
TEST(ContactSubsteps, CallWallsThatPushAgainstMorePointsThanRowsInfeasible) {
  const double gap = 0.5 * kSubstepMargin;
  const AnalyticField field(Slot{0.015 + gap}, kSubstepVoxel);
  SurfaceSamples faces;
  for (int i = 0; i < 5000; ++i) {
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    faces.points.push_back({0.015 * side, 1e-3 * (i / 2 % 50 - 24.5), 1e-3 * (i / 100 - 24.5)});
    faces.normals.push_back({-side, 0.0, 0.0});
  }
  const SampledBody body(faces, Vector3::Constant(4e-4));
  SubstepRun<> run(field, body, Pose{});
  for (int i = 1; i <= 30; ++i) {
    const double angle = 2.0 * M_PI * i / 30.0;
    const Vector3 turn = 0.05 * Vector3(0.0, std::cos(angle), std::sin(angle));
    ASSERT_EQ(run.step(pose_at({0.0, 1e-4 * i, 0.0}, turn)), Status::kOk);
    EXPECT_EQ(run.report.outcome, Outcome::kInfeasible) << i;
    ASSERT_LT(run.depth(), -0.9 * gap) << i;
    EXPECT_NEAR(run.state.H_WS.translation.y(), 1e-4 * i, 1e-6) << "nothing holds it along the walls";
  }
}

/// Walls at both sides in x, closer than twice the margin to a body of 30 mm between them, over a floor whose ramp
/// begins at y = 0 and rises by 45 degrees.
struct SlotWithRamp {
  double half_width = 0.015 + 0.5 * kSubstepMargin;
  Vector3 ramp = Vector3(0.0, -1.0, 1.0).normalized();
  double wall(const Vector3& p) const noexcept { return half_width - std::fabs(p.x()); }
  double distance(const Vector3& p) const noexcept { return std::min({wall(p), p.z(), ramp.dot(p)}); }
  Vector3 gradient(const Vector3& p) const noexcept {
    if (wall(p) < std::min(p.z(), ramp.dot(p))) return {p.x() > 0.0 ? -1.0 : 1.0, 0.0, 0.0};
    return p.z() < ramp.dot(p) ? Vector3::UnitZ() : ramp;
  }
};

/// No motion regains the margins of both walls. A point on the floor is to slide onto the ramp, by less than a margin,
/// which takes a second look. The motion that the ramp directs does not hide that the walls contradict each other.
TEST(ContactSubsteps, CallWallsInfeasibleAfterASecondLookAtARamp) {
  const AnalyticField field(SlotWithRamp{}, kSubstepVoxel);
  const SampledBody body({{Vector3(0.015, 0.0, 0.01), Vector3(-0.015, 0.0, 0.01), Vector3::Zero()},
                          {-Vector3::UnitX(), Vector3::UnitX(), -Vector3::UnitZ()}},
                         Vector3::Constant(4e-4));
  SubstepRun<> run(field, body, pose_at({0.0, -9e-6, kSubstepMargin}));
  for (int cycle = 0; cycle < 5; ++cycle) {
    ASSERT_EQ(run.step(pose_at({0.0, 4e-6, -1e-3})), Status::kOk);
    EXPECT_NEAR(run.state.H_WS.translation.y(), kSubstepMargin * (1.0 - std::sqrt(2.0)), 1e-7) << "margin of the ramp";
    EXPECT_EQ(run.report.outcome, Outcome::kInfeasible) << cycle;
  }
}

/// A hollow ball about the origin.
struct HollowBall {
  static constexpr double kRadius = 0.1;
  double distance(const Vector3& p) const noexcept { return kRadius - p.norm(); }
  Vector3 gradient(const Vector3& p) const noexcept { return -p.normalized(); }
};

/// Most points, more than there are rows, lie at the bottom of a hollow ball; 64 neighbours lie below its top, to which
/// the device goes. They get rows one at a time, as each motion would violate another one. A sub-step adds rows eight
/// times. For some ways that is enough; for others a gap ends below the margin, and the report counts its point.
TEST(ContactSubsteps, CountPointsThatStillLackARowAfterEightTimes) {
  constexpr int kTop = 64;
  constexpr int kAll = 16000;
  SurfaceSamples samples;
  for (int k = 0; k < kAll; ++k) {
    const double z = k < kTop ? 1.0 - 0.5 * (k + 0.5) / kTop : -1.0;
    const double aside = std::sqrt(1.0 - z * z);
    const double gap = k < kTop ? 1e-4 : 5e-5 + 3e-5 * k / kAll;
    const Vector3 out(aside * std::cos(2.4 * k), aside * std::sin(2.4 * k), z);
    samples.points.push_back((HollowBall::kRadius - gap) * out);
    samples.normals.push_back(-out);
  }
  const AnalyticField field(HollowBall{}, kSubstepVoxel);
  const SampledBody body(samples, Vector3::Constant(4e-3));
  int counted = 0, complete = 0;
  for (const auto& [x, y] : {std::pair(0, -2), {2, -5}, {2, -4}, {0, 2}, {-3, 1}, {4, 4}}) {
    SubstepRun<> run(field, body, Pose{});
    ASSERT_EQ(run.step(pose_at({1.6e-3 * x, 1.6e-3 * y, 0.02})), Status::kOk);
    EXPECT_GT(-run.depth(), 0.7 * kSubstepMargin) << x << ' ' << y;
    EXPECT_EQ(run.report.outcome == Outcome::kOverflow, run.report.dropped > 0) << x << ' ' << y;
    if (run.report.dropped == 0) {
      EXPECT_GT(-run.depth(), kSubstepMargin - 2e-7) << x << ' ' << y;
    }
    ++(run.report.dropped > 0 ? counted : complete);
  }
  EXPECT_GT(counted, 0);
  EXPECT_GT(complete, 0);
}

/// The second direction alone: a tilted block comes to lie on a bed of points 1 mm apart, more than there are rows.
TEST(ContactSubsteps, LayABlockOnMoreFeaturePointsThanRows) {
  const AnalyticField nothing(HalfSpace{Vector3::UnitZ(), -1.0}, kSubstepVoxel);
  const Block shape{{0.03, 0.02, 0.015}};
  const AnalyticField block(shape, kSubstepVoxel);
  const SampledBody body = box_body(3);
  SurfaceSamples bed;
  for (int y = -30; y <= 30; ++y) {
    for (int x = -40; x <= 40; ++x) {
      bed.points.push_back({1e-3 * x, 1e-3 * y, 0.0});
      bed.normals.push_back(-Vector3::UnitZ());
    }
  }
  const SampledBody still(bed, Vector3::Ones());
  const Pointshell points = still.pointshell();
  const Vector3 origin_W(0.1, -0.2, 0.3);
  const FeatureContacts<AnalyticField> features{&block, points, origin_W, 0.05};
  Parameters q;
  q.mass = body.mass;
  q.voxel_size = kSubstepVoxel;
  q.margin = kSubstepMargin;
  const Pointshell shell = body.pointshell();
  const ContactScene<AnalyticField, AnalyticField> scene(nothing, shell, features, q);
  const auto memory = std::make_unique<ContactMemory>();
  memory->search.start(scene, {});
  ProxyState state;
  state.H_WS = memory->H_WD_last = pose_at(origin_W + Vector3(0.0, 0.0, 0.0155), {0.01, 0.005, 0.2});
  state.started = true;
  CycleReport report;
  CycleInput input;
  input.H_WD = pose_at(origin_W + Vector3(1e-4, 0.0, 0.012), {0.0, 0.0, 0.2});
  int overflows = 0;
  for (int i = 0; i < 60; ++i) {
    ASSERT_EQ(contact_cycle<false>(scene, input, *memory, state, report), Status::kOk);
    for (std::size_t k = 0; k < points.size; ++k) {
      ASSERT_GT(shape.distance(state.H_WS.inverse() * (origin_W + points.point(k))), 0.0) << i;
    }
    overflows += report.dropped > 0 || report.outcome == Outcome::kOverflow ? 1 : 0;
  }
  EXPECT_NEAR(state.H_WS.rotation.toRotationMatrix()(2, 2), 1.0, 1e-6) << "it lies flat";
  EXPECT_NEAR(state.H_WS.translation.z() - origin_W.z(), 0.015 + kSubstepMargin, 0.1 * kSubstepMargin);
  EXPECT_NEAR(state.H_WS.translation.x() - origin_W.x(), 1e-4, 1e-5) << "nothing holds it along the bed";
  EXPECT_GT(report.force.spring_W.force.z(), 0.0);
  EXPECT_EQ(overflows, 0) << "some 2400 points lie under the block; the 2048 rows have room for those that matter";
  for (std::uint32_t k = 0; k < memory->last_step.force_count; ++k) {
    EXPECT_NE(memory->last_step.forces[k].id & detail::kFeature, 0u);
  }
}

/// A block starts 0.1 mm deep on a feature point; no sample point is inside. It counts as a start inside until the
/// block has come out, and never again.
TEST(ContactSubsteps, KnowAStartThatOnlyAFeaturePointPenetrates) {
  const AnalyticField nothing(HalfSpace{Vector3::UnitZ(), -1.0}, kSubstepVoxel);
  const Block shape{{0.03, 0.02, 0.015}};
  const AnalyticField block(shape, kSubstepVoxel);
  const SampledBody body = box_body(3);
  const SampledBody still({{Vector3::Zero()}, {-Vector3::UnitZ()}}, Vector3::Ones());
  const Vector3 origin_W(0.1, -0.2, 0.3);
  Parameters q;
  q.mass = body.mass;
  q.voxel_size = kSubstepVoxel;
  q.margin = kSubstepMargin;
  const Pointshell shell = body.pointshell();
  const ContactScene<AnalyticField, AnalyticField> scene(nothing, shell, {&block, still.pointshell(), origin_W, 0.05},
                                                         q);
  const auto memory = std::make_unique<ContactMemory>();
  memory->search.start(scene, {});
  ProxyState state;
  CycleReport report;
  CycleInput input;
  state.H_WS = input.H_WD = pose_at(origin_W + Vector3(0.0, 0.0, 0.015 - 1e-4));
  const auto gap = [&] { return shape.distance(state.H_WS.inverse() * origin_W); };
  for (int cycle = 0; cycle < 40; ++cycle) {
    const double before = gap();
    ASSERT_EQ(contact_cycle<false>(scene, input, *memory, state, report), Status::kOk);
    EXPECT_EQ(state.inside, before < 0.0) << cycle;
    EXPECT_EQ(report.outcome == Outcome::kStartInside, before < 0.0) << cycle;
  }
  EXPECT_FALSE(state.inside);
  EXPECT_NEAR(gap(), kSubstepMargin, 0.1 * kSubstepMargin);
}

/// Two feature points start inside the block, under its top and over its bottom, so that no motion meets their rows. A
/// third one lies inside its side: the way out leads past that one, by the margin, and leaves the other two where they
/// cancel. A budget of work that is larger than the work of these cycles changes nothing.
TEST(ContactSubsteps, LeaveAnOverlapOfFeaturePointsWhereTheyDoNotCancel) {
  constexpr double kDepth = 1e-4;
  const AnalyticField nothing(HalfSpace{Vector3::UnitZ(), -1.0}, kSubstepVoxel);
  const AnalyticField block(Block{{0.03, 0.02, 0.015}}, kSubstepVoxel);
  const SampledBody body = box_body(3);
  const Vector3 up = Vector3::UnitZ();
  const SampledBody still({{up * (0.015 - kDepth), -up * (0.015 - kDepth), Vector3::UnitX() * (0.03 - kDepth)},
                           {-up, up, -Vector3::UnitX()}},
                          Vector3::Ones());
  Parameters q;
  q.mass = body.mass;
  q.voxel_size = kSubstepVoxel;
  q.margin = kSubstepMargin;
  const Pointshell shell = body.pointshell();
  const ContactScene<AnalyticField, AnalyticField> scene(nothing, shell,
                                                         {&block, still.pointshell(), Vector3::Zero(), 0.05}, q);
  for (const std::uint64_t budget : {WorkMeter::kUnlimited, std::uint64_t{1000000}}) {
    q.work_budget = budget;
    const auto memory = std::make_unique<ContactMemory>();
    memory->search.start(scene, {});
    ProxyState state;
    CycleReport report;
    CycleInput input;
    for (int cycle = 0; cycle < 60; ++cycle) {
      ASSERT_EQ(contact_cycle<false>(scene, input, *memory, state, report), Status::kOk);
      EXPECT_EQ(report.outcome, Outcome::kStartInside) << cycle;
      EXPECT_FALSE(report.out_of_work) << cycle << ": " << report.work;
    }
    EXPECT_NEAR(state.H_WS.translation.x(), -kDepth - kSubstepMargin, 0.1 * kSubstepMargin);
    EXPECT_NEAR(state.H_WS.translation.z(), 0.0, 0.1 * kSubstepMargin);
  }
}

/// The memory of a cycle does not outlive a reset.
TEST(ContactMemory, ForgetsTheLastCycleWhenReset) {
  const auto memory = std::make_unique<ContactMemory>();
  memory->last_step.motion = {Vector3(1.0, 2.0, 3.0), Vector3(4.0, 5.0, 6.0)};
  memory->last_step.force_count = 2;
  memory->H_WD_last = pose_at({1.0, 2.0, 3.0}, {0.1, 0.2, 0.3});
  memory->path.push(memory->H_WD_last);
  memory->reset();
  EXPECT_EQ(memory->last_step.motion.translation, Vector3::Zero());
  EXPECT_EQ(memory->last_step.motion.rotation, Vector3::Zero());
  EXPECT_EQ(memory->last_step.force_count, 0u);
  EXPECT_TRUE(memory->H_WD_last == Pose{});
  EXPECT_TRUE(memory->path.poses().empty());
}

/// The still body is one metre below.
struct FarBelow {
  double distance(const Vector3& p) const noexcept { return p.z() + 1.0; }
  Vector3 gradient(const Vector3& /*p*/) const noexcept { return Vector3::UnitZ(); }
};

/// A cycle of `contact` with edge against edge, whose search remembers the last cycle.
struct EdgeCycle {
  EdgeContacts edges;
  std::unique_ptr<ContactMemory> memory = std::make_unique<ContactMemory>();
  bool is_first = true;
  bool has_friction = false;
  template <class Field>
  Status operator()(const Field& field, const Pointshell& shell, const Parameters& q, const CycleInput& input,
                    ProxyState& state, CycleReport& report) {
    const ContactScene<Field, NoBodyField> scene(field, shell, {}, q, edges);
    if (is_first) {
      memory->search.start(scene, {});
      memory->H_WD_last = state.H_WS;
    }
    is_first = false;
    return has_friction ? contact_cycle<true>(scene, input, *memory, state, report)
                        : contact_cycle<false>(scene, input, *memory, state, report);
  }
};

/// The first search of a face of 400 near points takes several cycles with a small budget of work. While points are
/// missing nobody knows whether the body starts inside: that must not hold it, and it does not, once all are seen.
TEST(ContactSubsteps, LetAFreeBodyGoWhoseFirstSearchTookSeveralCycles) {
  const AnalyticField field(HalfSpace{Vector3::UnitZ(), 0.0}, kSubstepVoxel);
  const SampledBody body = box_body(21);
  const Pointshell shell = body.pointshell();
  for (const double gap : {1.5, 10.0}) {
    for (const std::uint64_t budget : {12000u, 20000u, 40000u}) {
      Parameters q;
      q.mass = body.mass;
      q.voxel_size = kSubstepVoxel;
      q.margin = kSubstepMargin;
      q.work_budget = budget;
      const ContactScene<AnalyticField, NoBodyField> scene(field, shell, {}, q);
      const auto memory = std::make_unique<ContactMemory>();
      std::vector<std::uint32_t> words(ContactSearch::memory(shell, {}));
      memory->search.start(scene, words);
      ProxyState state;
      CycleReport report;
      CycleInput input;
      state.H_WS = input.H_WD = memory->H_WD_last = pose_at({0.0, 0.0, 0.015 + gap * kSubstepMargin});
      int inside = 0;
      for (int cycle = 0; cycle < 20; ++cycle) {
        ASSERT_EQ(contact_cycle<false>(scene, input, *memory, state, report), Status::kOk);
        inside += report.outcome == Outcome::kStartInside ? 1 : 0;
      }
      EXPECT_GT(inside, 0) << gap << ' ' << budget << ": or the search took one cycle";
      EXPECT_LT(inside, 10) << gap << ' ' << budget;
      EXPECT_FALSE(state.inside) << gap << ' ' << budget;
      input.H_WD.translation.z() += 0.003;
      for (int cycle = 0; cycle < 200; ++cycle) {
        ASSERT_EQ(contact_cycle<false>(scene, input, *memory, state, report), Status::kOk);
      }
      EXPECT_TRUE(state.H_WS == input.H_WD) << gap << ' ' << budget;
    }
  }
}

/// A budget of work ends cycles among the feature points, after a choice among the near sample points. The next cycle
/// goes on with the feature points: it does not choose again, so that no point is counted twice.
TEST(ContactSubsteps, ChooseOnceAmongThePointsOfASearchThatTakesSeveralCycles) {
  const AnalyticField field(HalfSpace{Vector3::UnitZ(), 0.0}, kSubstepVoxel);
  const SampledBody body = box_body(9);
  const SampledBody features = box_body(21);
  const Pointshell shell = body.pointshell();
  /// Returns the largest number of points that one of 20 cycles leaves out.
  const auto left_out = [&](std::uint64_t budget) {
    Parameters q;
    q.mass = body.mass;
    q.voxel_size = kSubstepVoxel;
    q.margin = kSubstepMargin;
    q.point_budget = 20;
    q.work_budget = budget;
    const ContactScene<AnalyticField, AnalyticField> scene(field, shell,
                                                           {&field, features.pointshell(), Vector3::Zero(), 0.05}, q);
    const auto memory = std::make_unique<ContactMemory>();
    std::vector<std::uint32_t> words(ContactSearch::memory(shell, features.pointshell()));
    memory->search.start(scene, words);
    ProxyState state;
    CycleReport report;
    CycleInput input;
    state.H_WS = input.H_WD = memory->H_WD_last = pose_at({0.0, 0.0, 0.015 + 1.5 * kSubstepMargin});
    std::uint32_t most = 0;
    for (int cycle = 0; cycle < 20; ++cycle) {
      EXPECT_EQ(contact_cycle<false>(scene, input, *memory, state, report), Status::kOk);
      most = std::max(most, report.dropped);
    }
    return most;
  };
  const std::uint32_t of_bottom = 9 * 9;
  for (const std::uint64_t budget : {10000u, 20000u, 30000u, 40000u}) {
    const std::uint32_t most = left_out(budget);
    EXPECT_GT(most, of_bottom / 2) << budget;
    EXPECT_LE(most, of_bottom) << budget;
  }
}

/// 2040 points lie at the bottom of a hollow ball, and 64 below its top, to which the device goes. Only bounds of these
/// are known until the first motion meets them; then eight of them get the last rows. The budget of work ends the cycle
/// before a motion is certified. The next cycle goes on with the lists and adds rows for the others, too: one sub-step
/// ends below the top, at the margin.
TEST(ContactSubsteps, AddRowsForBoundedPointsInTheCycleThatGoesOn) {
  constexpr int kTop = 64;
  constexpr int kAll = kTop + 2040;
  SurfaceSamples samples;
  for (int k = 0; k < kAll; ++k) {
    const double z = k < kTop ? 1.0 - 0.5 * (k + 0.5) / kTop : -1.0 + 1e-4 * (k - kTop) / kAll;
    const double aside = std::sqrt(1.0 - z * z);
    const double gap = k < kTop ? 1e-3 : 5e-5 + 3e-5 * k / kAll;
    const Vector3 out(aside * std::cos(2.4 * k), aside * std::sin(2.4 * k), z);
    samples.points.push_back((HollowBall::kRadius - gap) * out);
    samples.normals.push_back(-out);
  }
  const AnalyticField field(HollowBall{}, kSubstepVoxel);
  const SampledBody body(samples, Vector3::Constant(4e-3));
  const Pointshell shell = body.pointshell();
  for (const auto& [x, y] : {std::pair(2, -5), {2, -4}, {4, 4}}) {
    Parameters q;
    q.mass = body.mass;
    q.voxel_size = kSubstepVoxel;
    q.margin = kSubstepMargin;
    const ContactScene<AnalyticField, NoBodyField> scene(field, shell, {}, q);
    const auto memory = std::make_unique<ContactMemory>();
    std::vector<std::uint32_t> words(ContactSearch::memory(shell, {}));
    memory->search.start(scene, words);
    memory->last_step.motion.translation = Vector3::UnitX();  // long: the longest search radius
    ProxyState state;
    state.started = true;
    CycleReport report;
    CycleInput input;
    input.H_WD = pose_at({4e-4 * x, 4e-4 * y, 2e-3});
    q.work_budget = 1000000;
    ASSERT_EQ(contact_cycle<false>(scene, input, *memory, state, report), Status::kOk);
    ASSERT_TRUE(report.out_of_work && memory->kept.goes_on) << x << ' ' << y;
    ASSERT_EQ(memory->workspace.samples.bounded, 64u) << x << ' ' << y;
    ASSERT_TRUE(memory->workspace.rows.full()) << x << ' ' << y;
    EXPECT_GT(report.dropped, 0u) << "there is no room for other rows";
    q.work_budget = WorkMeter::kUnlimited;
    ASSERT_EQ(contact_cycle<false>(scene, input, *memory, state, report), Status::kOk);
    EXPECT_EQ(report.substeps, 1u) << x << ' ' << y;
    EXPECT_GT(state.H_WS.translation.z(), 5e-4) << x << ' ' << y;
    EXPECT_GT(smallest_distance(field, shell, state.H_WS), 0.99 * kSubstepMargin) << x << ' ' << y;
  }
}

/// The search radius grows if the first sub-step takes less than half of the budget, however much the others take.
TEST(ContactSubsteps, LearnTheSearchRadiusFromTheFirstSubstep) {
  const AnalyticField field(HalfSpace{Vector3::UnitZ(), 0.0}, kSubstepVoxel);
  const SampledBody body = box_body(4);
  const auto work_of_slide = [&](std::uint64_t budget, double& radius) {
    SubstepRun<false> run(field, body, pose_at({0.0, 0.0, 0.015 + kSubstepMargin}));
    WorkMeter of_balls;
    of_balls.start(1000);
    of_balls.add(Work::kBall, 10);
    run.cycle.memory->share.learn(of_balls, 0);  // to a half
    run.parameters.work_budget = budget;
    EXPECT_EQ(run.step(pose_at({0.02, 0.0, 0.0149})), Status::kOk);
    EXPECT_GE(run.report.substeps, 3u);
    EXPECT_FALSE(run.report.out_of_work);
    radius = run.memory().share.radius();
    return run.memory().work.spent();
  };
  double radius = 0.0;
  const std::uint64_t work = work_of_slide(WorkMeter::kUnlimited, radius);
  EXPECT_EQ(radius, 1.0);
  EXPECT_EQ(work_of_slide(work + work / 2, radius), work);
  EXPECT_EQ(radius, 0.5 * 1.125);
}

/// Far from any surface a cycle is one step to the device, whether its own search or an earlier one proves the way
/// free.
TEST(ContactSubsteps, GoToTheDeviceInOneStepWhereNothingIsNear) {
  Random random(21);
  const AnalyticField field(FarBelow{}, kSubstepVoxel);
  const SampledBody body = box_body(2);
  AnalyticRun<AnalyticField, EdgeCycle> run(field, body, pose_at({0.0, 0.0, 0.02}));
  for (int cycle = 0; cycle < 10; ++cycle) {
    const Pose before = run.state.H_WS;
    const Pose device = pose_at(random.in_cube(0.01), random.in_cube(0.1));
    ASSERT_EQ(run.step(device), Status::kOk);
    const auto path = run.cycle.memory->path.poses();
    ASSERT_EQ(path.size(), 1u) << cycle;
    EXPECT_TRUE(path[0] == device) << cycle;
    EXPECT_EQ(run.report.outcome, Outcome::kFree) << cycle;
    const Motion& stored = run.cycle.memory->last_step.motion;
    EXPECT_LT((stored.translation - get_motion(before.inverse() * device).translation).norm(), 1e-9) << cycle;
  }
}

/// The same with edges. A motion of 5 mm that starts 30 mm from all of them is one step, however many edges the bodies
/// have.
TEST(ContactSubsteps, GoToTheDeviceInOneStepFarFromManyEdges) {
  std::vector<std::pair<Vector3, Vector3>> low, high;
  for (int i = 0; i < 400; ++i) {
    const double x = 0.005 * i;
    low.emplace_back(Vector3(x, -0.001, 0.0), Vector3(x, 0.001, 0.0));
    high.emplace_back(Vector3(x, -0.001, 0.03), Vector3(x, 0.001, 0.03));
  }
  const EdgeSet moving(high), still(low);
  const AnalyticField field(FarBelow{}, kSubstepVoxel);
  const SampledBody body = box_body(2);
  AnalyticRun<AnalyticField, EdgeCycle> run(field, body, Pose{});
  run.parameters.margin = kSubstepMargin;
  run.cycle.edges = {moving.view(), still.view()};
  const Pose device = pose_at({0.004, 0.0, 0.003});
  ASSERT_EQ(run.step(device), Status::kOk);
  EXPECT_EQ(run.cycle.memory->path.poses().size(), 1u);
  EXPECT_TRUE(run.state.H_WS == device);
  EXPECT_EQ(run.report.outcome, Outcome::kFree);
}

/// No point is near, so the edges alone hold the body, however far it flew before and however fast it comes.
TEST(ContactSubsteps, HoldAnEdgeWhereNoPointIsNear) {
  const EdgeSet moving({{Vector3(0.0, -0.01, 0.0), Vector3(0.0, 0.01, 0.0)}});
  const EdgeSet still({{Vector3(-0.02, 0.0, 0.0), Vector3(0.02, 0.0, 0.0)}});
  const AnalyticField field(FarBelow{}, kSubstepVoxel);
  const SampledBody body = box_body(2);
  for (const double step : {2e-5, 3e-4, 8e-3}) {
    AnalyticRun<AnalyticField, EdgeCycle> run(field, body, pose_at({0.0, 0.0, 0.02}));
    run.parameters.margin = kSubstepMargin;
    run.cycle.edges = {moving.view(), still.view()};
    for (double z = 0.02; z > -0.003; z -= step) ASSERT_EQ(run.step(pose_at({0.0, 0.0, z})), Status::kOk);
    for (int k = 0; k < 20; ++k) ASSERT_EQ(run.step(pose_at({0.0, 0.0, -0.003})), Status::kOk);
    EXPECT_NEAR(run.state.H_WS.translation.z(), kSubstepMargin, 0.1 * kSubstepMargin) << step;
    EXPECT_NEAR(run.report.force.spring_W.force.z(), run.parameters.stiffness * (0.003 + kSubstepMargin), 0.05) << step;
    EXPECT_EQ(run.report.contacts, 1u) << step;
    // round the end of the still edge the way down is free
    for (double x = 0.0; x < 0.03; x += 1e-3) ASSERT_EQ(run.step(pose_at({x, 0.0, -0.003})), Status::kOk);
    EXPECT_EQ(run.report.contacts, 0u) << step;
    EXPECT_EQ(run.state.H_WS.translation.z(), -0.003) << step;
  }
}

/// After a start inside a god object may have lost its margin. Its vertical edge passes an edge of the block at 0.08
/// margins, and a point of it, a little higher, is 0.31 margins from that edge. Sliding down, the point comes as near
/// as the edges are: it must not hold the body.
TEST(ContactSubsteps, LetAPointPassAnEdgeThatIsNearerToItsEdge) {
  const EdgeSet moving({{Vector3(0.0, 0.0, -0.005), Vector3(0.0, 0.0, 0.005)}});
  EdgeSet still({{Vector3(-0.02, -0.02, 0.01), Vector3(-0.02, 0.02, 0.01)}});
  still.edges()[0].normal[0][0] = -1.0f;
  still.edges()[0].normal[1][2] = 1.0f;
  const AnalyticField field(Block{}, kSubstepVoxel);
  const SampledBody body{{{Vector3(0.0, 0.0, 0.3 * kSubstepMargin)}, {Vector3::UnitX()}}, Vector3::Constant(1e-4)};
  const Vector3 start(-0.02 - 0.08 * kSubstepMargin, 0.0, 0.01);
  AnalyticRun<AnalyticField, EdgeCycle> run(field, body, pose_at(start));
  run.parameters.margin = kSubstepMargin;
  run.cycle.edges = {moving.view(), still.view()};
  const Vector3 device = start + Vector3(0.5e-3, 0.0, -1e-3);
  for (int k = 0; k < 3; ++k) ASSERT_EQ(run.step(pose_at(device)), Status::kOk);
  EXPECT_NEAR(run.state.H_WS.translation.z(), device.z(), 0.1 * kSubstepMargin);
  EXPECT_LT(run.state.H_WS.translation.x(), start.x());
}

/// The top of the block lies under a point beside it only as a plane.
TEST(ContactSubsteps, KnowAFaceThatEndsBeforeAPoint) {
  const AnalyticField field(Block{}, kSubstepVoxel);
  ContactLengths lengths{};
  lengths.margin = kSubstepMargin;
  lengths.opening = 0.01 * kSubstepVoxel;
  const Vector3 up = Vector3::UnitZ();
  const double height = 0.01 + kSubstepMargin;
  EXPECT_FALSE(detail::face_ends_before(field, {0.0, 0.0, height}, up, lengths));
  EXPECT_FALSE(detail::face_ends_before(field, {0.02 - 1e-4, 0.0, height}, up, lengths));
  EXPECT_TRUE(detail::face_ends_before(field, {0.02 + 1e-4, 0.0, height}, up, lengths)) << "the side is nearer";
  EXPECT_FALSE(detail::face_ends_before(field, {0.02 + kSubstepMargin, 0.0, 0.0}, Vector3::UnitX(), lengths));
  EXPECT_TRUE(detail::face_ends_before(field, {0.0, 0.0, height}, Vector3(0.6, 0.0, 0.8), lengths)) << "no such face";
}

/// The top of a block, which ends on the left, with a wall on the right.
struct BlockWithAWall {
  static constexpr double kWall = 0.01;
  double distance(const Vector3& p) const noexcept { return std::min(Block{}.distance(p), kWall - p.x()); }
  Vector3 gradient(const Vector3& p) const noexcept {
    return Block{}.distance(p) < kWall - p.x() ? Block{}.gradient(p) : Vector3(-Vector3::UnitX());
  }
};

/// A body stands on two points: one at the end of a block's top, the other in front of a wall. The top is nearer to the
/// latter, so that only a second look sees the wall. The device presses the body down and against the wall, where it
/// rests already. The top ends beside the first point, but that point's row is not one of a second look: the body rests
/// in one sub-step, without a shortened motion.
TEST(ContactSubsteps, RestAtAWallWithAPointAtTheEndOfItsFace) {
  const AnalyticField field(BlockWithAWall{}, kSubstepVoxel);
  const double right = BlockWithAWall::kWall - kSubstepMargin - 1e-9;
  const double left = -0.02 + 0.5 * 0.01 * kSubstepVoxel;
  const double middle = 0.5 * (left + right);
  const SampledBody body{
      {{Vector3(left - middle, 0.0, 0.0), Vector3(right - middle, 0.0, 0.0)}, {-Vector3::UnitZ(), -Vector3::UnitZ()}},
      Vector3::Constant(1e-4)};
  const Pose start = pose_at({middle, 0.0, 0.01 + kSubstepMargin - 1e-9});
  SubstepRun<> run(field, body, start);
  const Pose device = pose_at(start.translation + Vector3(1e-3, 0.0, -1e-3));
  for (int cycle = 0; cycle < 5; ++cycle) {
    ASSERT_EQ(run.step(device), Status::kOk);
    EXPECT_LT((run.state.H_WS.translation - start.translation).norm(), 1e-7) << cycle;
    EXPECT_EQ(run.report.outcome, Outcome::kContact) << cycle;
    EXPECT_EQ(run.report.substeps, 1u) << cycle;
    EXPECT_NEAR(run.report.force.spring_W.force.x(), -run.parameters.stiffness * 1e-3, 1e-3) << cycle;
  }
}

/// A keel in a roof: convex edges that cross, far from all points.
struct KeelInRoof {
  EdgeSet moving{{{Vector3(0.0, -0.01, 0.0), Vector3(0.0, 0.01, 0.0)}}};
  EdgeSet still{{{Vector3(-0.02, 0.0, 0.0), Vector3(0.02, 0.0, 0.0)}}};
  AnalyticField field{FarBelow{}, kSubstepVoxel};
  SampledBody body = box_body(2);

  KeelInRoof() {
    for (int face = 0; face < 2; ++face) {
      const float side = face == 0 ? 0.8f : -0.8f;
      moving.edges()[0].normal[face][0] = still.edges()[0].normal[face][1] = side;
      moving.edges()[0].normal[face][2] = -0.6f;
      still.edges()[0].normal[face][2] = 0.6f;
    }
  }
};

/// Edges that overlap at the start come out by a share of their depth in each cycle, while the device stays. From then
/// on they hold.
TEST(ContactSubsteps, LeadEdgesOutThatOverlapAtTheStart) {
  KeelInRoof scene;
  for (const double depth : {0.05, 0.3, 0.6, 0.99}) {
    const double start = -depth * kSubstepVoxel;
    AnalyticRun<AnalyticField, EdgeCycle> run(scene.field, scene.body, pose_at({0.0, 0.0, start}));
    run.state.started = false;
    run.parameters.margin = kSubstepMargin;
    run.cycle.edges = {scene.moving.view(), scene.still.view()};
    double before = start;
    for (int cycle = 0; cycle < 200; ++cycle) {
      ASSERT_EQ(run.step(pose_at({0.0, 0.0, start})), Status::kOk);
      const double z = run.state.H_WS.translation.z();
      EXPECT_GE(z, before - 1e-12) << depth << ' ' << cycle;
      EXPECT_LE(z, before + 1.01 * kSubstepMargin) << depth << ' ' << cycle;
      EXPECT_EQ(run.report.contacts, 1u) << depth << ' ' << cycle;
      if (before < 0.0 && z < 0.0) {
        EXPECT_TRUE(run.cycle.memory->edges_may_overlap) << depth << ' ' << cycle;
      }
      if (before >= 0.0) {
        EXPECT_FALSE(run.cycle.memory->edges_may_overlap) << depth << ' ' << cycle;
      }
      before = z;
    }
    EXPECT_NEAR(before, kSubstepMargin, 0.1 * kSubstepMargin) << depth;
    // the device presses on: the roof holds, also beyond the depth that a start may have
    for (double z = start; z > -3.0 * kSubstepVoxel; z -= 0.1 * kSubstepVoxel) {
      ASSERT_EQ(run.step(pose_at({0.0, 0.0, z})), Status::kOk);
    }
    EXPECT_NEAR(run.state.H_WS.translation.z(), kSubstepMargin, 0.1 * kSubstepMargin) << depth;
  }
}

/// A session that has seen all edges apart and begins again leads edges out that overlap at its new start.
TEST(ContactSubsteps, LeadEdgesOutThatOverlapAtANewStart) {
  KeelInRoof scene;
  AnalyticRun<AnalyticField, EdgeCycle> run(scene.field, scene.body, pose_at({0.0, 0.0, 0.02}));
  run.parameters.margin = kSubstepMargin;
  run.cycle.edges = {scene.moving.view(), scene.still.view()};
  for (int cycle = 0; cycle < 5; ++cycle) ASSERT_EQ(run.step(pose_at({0.0, 0.0, 2.0 * kSubstepMargin})), Status::kOk);
  ASSERT_FALSE(run.cycle.memory->edges_may_overlap);
  run.cycle.memory->reset();
  run.state = ProxyState{};
  const Pose start = pose_at({0.0, 0.0, -0.5 * kSubstepVoxel});
  run.state.H_WS = start;
  for (int cycle = 0; cycle < 200; ++cycle) ASSERT_EQ(run.step(start), Status::kOk);
  EXPECT_NEAR(run.state.H_WS.translation.z(), kSubstepMargin, 0.1 * kSubstepMargin);
}

/// Two pairs that overlap come out together, in whatever directions: the first that is out stays a contact. The force
/// under a still device comes to rest.
TEST(ContactSubsteps, LeadTwoOverlapsOutTogether) {
  Random random(5);
  int came_out = 0;
  const AnalyticField field(FarBelow{}, kSubstepVoxel);
  const SampledBody body = box_body(2);
  for (int round = 0; round < 60; ++round) {
    EdgeSet moving({{Vector3::Zero(), Vector3::Zero()}, {Vector3::Zero(), Vector3::Zero()}});
    EdgeSet still({{Vector3::Zero(), Vector3::Zero()}, {Vector3::Zero(), Vector3::Zero()}});
    Vector3 out[2];
    for (std::size_t pair = 0; pair < 2; ++pair) {
      do out[pair] = random.in_cube(1.0).normalized();
      while (pair == 1 && out[1].dot(out[0]) < -0.5);
      const Vector3 across = out[pair].cross(random.in_cube(1.0)).normalized();
      const Vector3 along = out[pair].cross(across);
      const double depth = random.between(0.05, 0.95) * kSubstepVoxel;
      const Vector3 place = random.in_cube(0.02);
      const auto set = [&](format::SharpEdge& edge, const Vector3& middle, const Vector3& direction,
                           const Vector3& up) {
        const Vector3 side = direction.cross(up);
        for (int axis = 0; axis < 3; ++axis) {
          edge.end[0][axis] = middle[axis] - 0.02 * direction[axis];
          edge.end[1][axis] = middle[axis] + 0.02 * direction[axis];
          edge.normal[0][axis] = static_cast<float>(0.6 * up[axis] + 0.8 * side[axis]);
          edge.normal[1][axis] = static_cast<float>(0.6 * up[axis] - 0.8 * side[axis]);
        }
      };
      set(still.edges()[pair], place, across, out[pair]);
      set(moving.edges()[pair], place - depth * out[pair], along, -out[pair]);
    }
    AnalyticRun<AnalyticField, EdgeCycle> run(field, body, Pose{});
    run.state.started = false;
    run.parameters.margin = kSubstepMargin;
    run.cycle.edges = {moving.view(), still.view()};
    Vector3 force = Vector3::Zero();
    for (int cycle = 0; cycle < 200; ++cycle) {
      ASSERT_EQ(run.step(Pose{}), Status::kOk);
      const Vector3 now = run.report.force.spring_W.force;
      if (cycle > 150) {
        ASSERT_LT((now - force).norm(), 1e-3) << round << ' ' << cycle;
      }
      force = now;
    }
    // an edge of one pair may end in the wedge of the other pair's, which does not know it
    bool are_near = false;
    for (std::uint32_t pair = 0; pair < 2; ++pair) {
      const EdgeGap across = detail::gap_at(run.cycle.edges, {pair, 1 - pair}, run.state.H_WS, kSubstepVoxel);
      are_near = are_near || across.inside != EdgeInside::kNone;
    }
    EXPECT_EQ(run.cycle.memory->edges_may_overlap, are_near) << round;
    came_out += are_near ? 0 : 1;
    for (std::uint32_t pair = 0; pair < 2; ++pair) {
      const EdgeGap gap = detail::gap_at(run.cycle.edges, {pair, pair}, run.state.H_WS);
      EXPECT_GT(gap.normal.dot(out[pair]), 0.5) << "out on the right side, " << round;
      EXPECT_GE(gap.distance, 0.5 * kSubstepMargin) << round;
    }
  }
  EXPECT_GT(came_out, 50);
}

/// An edge that ends below a ridge, 0.4 voxels deep, and leaves the roof through a face. The end leads the body out.
TEST(ContactSubsteps, LeadAnOverlapAtAnEndOut) {
  const AnalyticField field(FarBelow{}, kSubstepVoxel);
  const SampledBody body = box_body(2);
  EdgeSet ridge({{Vector3(-0.02, 0, 0), Vector3(0.02, 0, 0)}});
  EdgeSet side({{Vector3(0, 0, -0.4 * kSubstepVoxel), Vector3(0, 0.02, -4e-3)}});
  for (int face = 0; face < 2; ++face) {
    ridge.edges()[0].normal[face][1] = face == 0 ? 0.8f : -0.8f;
    ridge.edges()[0].normal[face][2] = 0.6f;
    side.edges()[0].normal[face][0] = face == 0 ? 1.0f : -1.0f;
  }
  AnalyticRun<AnalyticField, EdgeCycle> run(field, body, Pose{});
  run.state.started = false;
  run.parameters.margin = kSubstepMargin;
  run.cycle.edges = {side.view(), ridge.view()};
  ASSERT_EQ(run.step(Pose{}), Status::kOk);
  EXPECT_TRUE(run.cycle.memory->edges_may_overlap);
  double height = run.state.H_WS.translation.z();
  // once it is out it may slide down beside the ridge, since the roof has no points here
  for (int cycle = 0; cycle < 100 && height < 0.4 * kSubstepVoxel; ++cycle) {
    ASSERT_EQ(run.step(Pose{}), Status::kOk);
    EXPECT_GT(run.state.H_WS.translation.z(), height) << "out, not to the device, " << cycle;
    EXPECT_TRUE(run.cycle.memory->edges_may_overlap) << "until a pose is found at which they do not, " << cycle;
    height = run.state.H_WS.translation.z();
  }
  EXPECT_GT(height, 0.4 * kSubstepVoxel);
  EXPECT_GT(detail::gap_at(run.cycle.edges, {0, 0}, run.state.H_WS).normal.z(), 0.5);
  ASSERT_EQ(run.step(Pose{}), Status::kOk);
  EXPECT_FALSE(run.cycle.memory->edges_may_overlap);
}

/// An edge of a body that reaches down from it, below a ridge and then above it: nothing holds the body there, and the
/// edges may overlap until it has left.
TEST(ContactSubsteps, KeepInMindWhatOverlapsAtAFace) {
  const AnalyticField field(FarBelow{}, kSubstepVoxel);
  const SampledBody body = box_body(2);
  EdgeSet ridge({{Vector3(-0.02, 0, 0), Vector3(0.02, 0, 0)}});
  EdgeSet across({{Vector3(0, -0.02, -0.4 * kSubstepVoxel), Vector3(0, 0.02, -0.4 * kSubstepVoxel)}});
  for (int face = 0; face < 2; ++face) {
    ridge.edges()[0].normal[face][1] = across.edges()[0].normal[face][0] = face == 0 ? 0.8f : -0.8f;
    ridge.edges()[0].normal[face][2] = across.edges()[0].normal[face][2] = 0.6f;
  }
  AnalyticRun<AnalyticField, EdgeCycle> run(field, body, Pose{});
  run.state.started = false;
  run.parameters.margin = kSubstepMargin;
  run.cycle.edges = {across.view(), ridge.view()};
  for (int cycle = 0; cycle < 20; ++cycle) {
    const Pose H_WD = pose_at({0.0, 0.0, 1e-3 * kSubstepVoxel * cycle});
    ASSERT_EQ(run.step(H_WD), Status::kOk);
    EXPECT_TRUE(run.cycle.memory->edges_may_overlap) << cycle;
    EXPECT_NEAR((run.state.H_WS.translation - H_WD.translation).norm(), 0.0, 1e-12) << "free, " << cycle;
  }
  for (int cycle = 0; cycle < 3; ++cycle) ASSERT_EQ(run.step(pose_at({0.0, 0.0, kSubstepVoxel})), Status::kOk);
  EXPECT_TRUE(run.cycle.memory->edges_may_overlap) << "over the ridge";
  for (int cycle = 0; cycle < 3; ++cycle) {
    ASSERT_EQ(run.step(pose_at({0.0, 0.0, 2.0 * kSubstepVoxel})), Status::kOk);
  }
  EXPECT_FALSE(run.cycle.memory->edges_may_overlap);
}

/// Edges that overlap on opposite sides at the start push against each other: no motion frees both. Under a device that
/// stays, however far away, the force is steady.
TEST(ContactSubsteps, RestBetweenEdgesThatPushAgainstEachOther) {
  constexpr double kHalf = 0.005;
  for (const double depth : {0.1, 0.3, 0.6}) {
    const double deep = depth * kSubstepVoxel;
    EdgeSet moving({{Vector3(0.0, -0.01, -kHalf), Vector3(0.0, 0.01, -kHalf)},
                    {Vector3(0.0, -0.01, kHalf), Vector3(0.0, 0.01, kHalf)}});
    EdgeSet still({{Vector3(-0.02, 0.0, deep - kHalf), Vector3(0.02, 0.0, deep - kHalf)},
                   {Vector3(-0.02, 0.0, kHalf - deep), Vector3(0.02, 0.0, kHalf - deep)}});
    for (int face = 0; face < 2; ++face) {
      for (const std::size_t edge : {0u, 1u}) {
        const float up = edge == 0 ? 0.6f : -0.6f;
        moving.edges()[edge].normal[face][0] = still.edges()[edge].normal[face][1] = face == 0 ? 0.8f : -0.8f;
        moving.edges()[edge].normal[face][2] = -up;
        still.edges()[edge].normal[face][2] = up;
      }
    }
    const AnalyticField field(FarBelow{}, kSubstepVoxel);
    const SampledBody body = box_body(2);
    for (const double device : {0.0, -0.1, -0.4, -0.9, -2.0}) {
      AnalyticRun<AnalyticField, EdgeCycle> run(field, body, Pose{});
      run.state.started = false;
      run.parameters.margin = kSubstepMargin;
      run.cycle.edges = {moving.view(), still.view()};
      ASSERT_EQ(run.step(Pose{}), Status::kOk);
      double force = 0.0;
      for (int cycle = 0; cycle < 200; ++cycle) {
        ASSERT_EQ(run.step(pose_at({0.0, 0.0, device * kSubstepVoxel})), Status::kOk);
        const double now = run.report.force.spring_W.force.z();
        if (cycle > 50) {
          ASSERT_NEAR(now, force, 1e-6) << depth << ' ' << device << ' ' << cycle;
        }
        force = now;
      }
      EXPECT_GE(force, -1e-6) << "it pulls back";
    }
  }
}

/// Edges may begin too deep in each other to be seen. While points lead the body out, these edges hold on neither side.
TEST(ContactSubsteps, LetPointsLeadEdgesOutFirst) {
  KeelInRoof scene;
  constexpr double kStart = -1.8 * kSubstepVoxel;
  for (const double points_out : {-0.5 * kSubstepVoxel, 0.5 * kSubstepVoxel}) {
    constexpr double kBottom = -0.015;  // of the body
    const AnalyticField field(HalfSpace{Vector3::UnitZ(), kBottom + points_out}, kSubstepVoxel);
    AnalyticRun<AnalyticField, EdgeCycle> run(field, scene.body, pose_at({0.0, 0.0, kStart}));
    run.state.started = false;
    run.parameters.margin = kSubstepMargin;
    run.cycle.edges = {scene.moving.view(), scene.still.view()};
    for (int cycle = 0; cycle < 100; ++cycle) {
      ASSERT_EQ(run.step(pose_at({0.0, 0.0, kStart})), Status::kOk);
      EXPECT_GE(run.report.force.spring_W.force.z(), 0.0) << points_out << ' ' << cycle;
    }
    EXPECT_EQ(run.report.outcome, Outcome::kContact) << points_out;
    EXPECT_NEAR(run.state.H_WS.translation.z(), std::max(0.0, points_out) + kSubstepMargin, 0.1 * kSubstepMargin);
    // a device that leaves at once, so that the edges are near although they are deep
    AnalyticRun<AnalyticField, EdgeCycle> leaving(field, scene.body, pose_at({0.0, 0.0, kStart}));
    leaving.state.started = false;
    leaving.parameters.margin = kSubstepMargin;
    leaving.cycle.edges = {scene.moving.view(), scene.still.view()};
    ASSERT_EQ(leaving.step(pose_at({0.0, 0.0, kStart})), Status::kOk);
    for (int cycle = 0; cycle < 20; ++cycle) ASSERT_EQ(leaving.step(pose_at({0.0, 0.0, 0.01})), Status::kOk);
    EXPECT_EQ(leaving.report.outcome, Outcome::kFree) << points_out;
  }
}

/// Near pairs that find no place in the list are counted in every cycle.
TEST(ContactSubsteps, CountEdgePairsThatFindNoPlace) {
  constexpr std::uint32_t kEdges = 17;
  std::vector<std::pair<Vector3, Vector3>> along_x, along_y;
  for (std::uint32_t i = 0; i < kEdges; ++i) {
    const double at_line = 1e-3 * i - 0.008;
    along_x.emplace_back(Vector3(-0.01, at_line, 0.0), Vector3(0.01, at_line, 0.0));
    along_y.emplace_back(Vector3(at_line, -0.01, 0.0), Vector3(at_line, 0.01, 0.0));
  }
  const EdgeSet moving(along_y), still(along_x);
  const AnalyticField field(FarBelow{}, kSubstepVoxel);
  const SampledBody body = box_body(2);
  AnalyticRun<AnalyticField, EdgeCycle> run(field, body, pose_at({0.0, 0.0, 1e-4}));
  run.parameters.margin = kSubstepMargin;
  run.cycle.edges = {moving.view(), still.view()};
  for (int cycle = 0; cycle < 3; ++cycle) {
    ASSERT_EQ(run.step(pose_at({0.0, 0.0, -1e-3})), Status::kOk);
    EXPECT_EQ(run.report.dropped, kEdges * kEdges - NearEdges::kCapacity) << cycle;
    EXPECT_EQ(run.report.outcome, Outcome::kOverflow) << cycle;
    EXPECT_GT(run.state.H_WS.translation.z(), 0.0) << cycle;
  }
}

/// A grid of 40 wires over another has more near pairs than find a place. One wire is 0.05 mm lower than the others:
/// with its pairs listed or not, the grid comes down no further than that wire.
TEST(ContactSubsteps, DoNotCrossEdgePairsThatFindNoPlace) {
  constexpr int kEdges = 40;
  constexpr double kLower = 5e-5;
  const AnalyticField field(FarBelow{}, kSubstepVoxel);
  const SampledBody body = box_body(2);
  for (const int low : {0, 13, 26, kEdges - 1}) {
    std::vector<std::pair<Vector3, Vector3>> along_x, along_y;
    for (int i = 0; i < kEdges; ++i) {
      const double at_line = 5e-4 * i - 0.01;
      const double height = i == low ? 0.0 : kLower;
      along_x.emplace_back(Vector3(-0.011, at_line, 0.0), Vector3(0.011, at_line, 0.0));
      along_y.emplace_back(Vector3(at_line, -0.011, height), Vector3(at_line, 0.011, height));
    }
    const EdgeSet moving(along_y), still(along_x);
    AnalyticRun<AnalyticField, EdgeCycle> run(field, body, pose_at({0.0, 0.0, 1e-4}));
    run.parameters.margin = kSubstepMargin;
    run.cycle.edges = {moving.view(), still.view()};
    for (int cycle = 0; cycle < 3; ++cycle) {
      ASSERT_EQ(run.step(pose_at({0.0, 0.0, -1e-3})), Status::kOk);
      EXPECT_GE(run.report.dropped, kEdges * kEdges - NearEdges::kCapacity) << low << ' ' << cycle;
      const auto& [first, second] = along_y[static_cast<std::size_t>(low)];
      const Vector3 from = run.state.H_WS * first;
      const Vector3 along = run.state.H_WS * second - from;
      for (const auto& [left, right] : along_x) {
        const double height = from.z() + (left.y() - from.y()) / along.y() * along.z();
        EXPECT_GT(height, 0.0) << low << ' ' << cycle << ' ' << left.y();
      }
    }
  }
}

/// A rod lies on a wire, is pressed down by 5 mm, and is to turn while it slides along itself. Both together would sink
/// it into the wire by 1.6 um, which costs forty times the energy that they gain. The slide alone gains four times as
/// much as the turn alone. The gap at the end of the motion shows it: in one cycle the rod slides on almost without the
/// turn.
TEST(ContactSubsteps, SlideARodOnAWireWithoutATurnThatCostsMore) {
  const EdgeSet moving({{Vector3(0.0, -5e-4, 0.0), Vector3(0.0, 5e-4, 0.0)}});
  const EdgeSet still({{Vector3(-0.01, 0.0, 0.0), Vector3(0.01, 0.0, 0.0)}});
  const AnalyticField field(FarBelow{}, kSubstepVoxel);
  const SampledBody body({{Vector3(0.0, -5e-4, 0.0), Vector3(0.0, 5e-4, 0.0)}, {Vector3::UnitY(), -Vector3::UnitY()}},
                         Vector3::Constant(1e-6));
  AnalyticRun<AnalyticField, EdgeCycle> run(field, body, pose_at({0.0, 0.0, kSubstepMargin}));
  run.parameters.margin = kSubstepMargin;
  run.parameters.coupling_rotation = 1e-8;  // a turn of 0.09 rad counts as much as 9 um
  run.cycle.edges = {moving.view(), still.view()};
  constexpr double kSlide = 1.8e-5;
  constexpr double kTurn = 0.09;
  ASSERT_EQ(run.step(pose_at({0.0, kSlide, kSubstepMargin - 5e-3}, {kTurn, 0.0, 0.0})), Status::kOk);
  EXPECT_GT(run.state.H_WS.translation.y(), 0.8 * kSlide);
  EXPECT_LT(std::fabs(log_rotation(run.state.H_WS.rotation).x()), 0.1 * kTurn);
  EXPECT_EQ(run.report.substeps, 1u);
}

/// A long rod across a wire turns about the place where they are nearest. No plane parts them in both poses, so free
/// balls, of 0.99 times the gap each, have to cover the way of the rod's ends. An attempt has 64 of them. The first
/// sub-step goes as far as they prove, not only a quarter of the way; the next ones complete the turn.
TEST(ContactSubsteps, TurnARodOverAWireAsFarAsBallsProveItsWayFree) {
  constexpr double kLever = 0.02;
  constexpr double kTurn = 0.09;
  const EdgeSet moving({{Vector3(0.0, -kLever, 0.0), Vector3(0.0, kLever, 0.0)}});
  const EdgeSet still({{Vector3(-0.01, 0.0, 0.0), Vector3(0.01, 0.0, 0.0)}});
  const AnalyticField field(FarBelow{}, kSubstepVoxel);
  const SampledBody body(
      {{Vector3(0.0, -kLever, 0.0), Vector3(0.0, kLever, 0.0)}, {Vector3::UnitY(), -Vector3::UnitY()}},
      Vector3::Constant(1e-4));
  AnalyticRun<AnalyticField, EdgeCycle> run(field, body, pose_at({0.0, 0.0, kSubstepMargin}));
  run.parameters.margin = kSubstepMargin;
  run.cycle.edges = {moving.view(), still.view()};
  run.cycle.memory->last_step.motion.translation = Vector3::UnitX();  // long: the longest search radius
  const Pose device = pose_at({0.0, 0.0, kSubstepMargin}, {kTurn, 0.0, 0.0});
  ASSERT_EQ(run.step(device), Status::kOk);
  const auto path = run.cycle.memory->path.poses();
  ASSERT_GT(path.size(), 1u);
  const double covered = kMostBallsOfChord * 0.99 * kSubstepMargin;
  EXPECT_NEAR(log_rotation(path[0].rotation).x(), covered / kLever, 0.01 * covered / kLever);
  EXPECT_NEAR(log_rotation(run.state.H_WS.rotation).x(), kTurn, 1e-6);
  EXPECT_LT((run.state.H_WS.translation - device.translation).norm(), 1e-6);
}

/// A plane that rises by 20 mrad.
struct Slope {
  Vector3 normal = Vector3(0.02, 0.0, 1.0).normalized();
  double distance(const Vector3& p) const noexcept { return normal.dot(p); }
  Vector3 gradient(const Vector3& /*p*/) const noexcept { return normal; }
};

/// In a wedge between a slope and a face of the workspace a lost margin is regained 50 times as far along the wedge. No
/// cycle leads by more than a margin farther from the device than rest, and the margin is regained in the end.
void expect_a_slow_regain(const SurfaceSamples& samples) {
  const AnalyticField field(Slope{}, kSubstepVoxel);
  const SampledBody body(samples, Vector3::Constant(1e-4));
  for (const double depth : {1e-4, 1e-3}) {
    const double lost = 0.75 * kSubstepMargin;
    SubstepRun<> run(field, body, pose_at((kSubstepMargin - lost) * Slope().normal));
    run.parameters.workspace = {.limited = true, .low = Vector3::Constant(-1.0), .high = Vector3(1.0, 1.0, 1.0)};
    run.parameters.workspace.high.z() = run.state.H_WS.translation.z();
    const Pose device = pose_at(run.state.H_WS.translation - Vector3(0.0, 0.0, depth));
    double farthest = 0.0;
    for (int cycle = 0; cycle < 400; ++cycle) {
      const double before = (run.state.H_WS.translation - device.translation).norm();
      ASSERT_EQ(run.step(device), Status::kOk);
      const double after = (run.state.H_WS.translation - device.translation).norm();
      farthest = std::max(farthest, after - before);
    }
    EXPECT_LT(farthest, 1.01 * kSubstepMargin) << depth;
    EXPECT_GT(Slope().distance(run.state.H_WS.translation), 0.9 * kSubstepMargin) << depth;
  }
}

TEST(ContactSubsteps, RegainALostMarginOfAWedgeSlowly) {
  expect_a_slow_regain({{Vector3::Zero()}, {Vector3::UnitZ()}});
}

/// The same with a row of points, more than there are rows: those that find no row at first regain no more.
TEST(ContactSubsteps, RegainTheMarginsOfMorePointsThanRowsSlowly) {
  SurfaceSamples samples;
  for (int k = 0; k < 5000; ++k) {
    samples.points.push_back({0.0, 1e-5 * (k - 2499.5), 0.0});
    samples.normals.push_back(Vector3::UnitZ());
  }
  expect_a_slow_regain(samples);
}

/// A table whose edge is the y axis.
struct TableEdge {
  double distance(const Vector3& p) const noexcept {
    return p.x() > 0.0 && p.z() > 0.0 ? std::hypot(p.x(), p.z()) : std::max(p.x(), p.z());
  }
  Vector3 gradient(const Vector3& p) const noexcept {
    if (p.x() > 0.0 && p.z() > 0.0) return Vector3(p.x(), 0.0, p.z()).normalized();
    return p.x() > p.z() ? Vector3::UnitX() : Vector3::UnitZ();
  }
};

/// An edge with sample points is drawn along itself over an edge of the table. It does not catch with its points: the
/// force stays across both edges. By itself the row of a point that comes over the edge leans by up to 45 degrees. A
/// fast point is held for one cycle by the row of the face that ends at the edge.
TEST(ContactSubsteps, DrawAnEdgeOverAnEdgeWithoutCatching) {
  const Vector3 along = Vector3(1.0, 0.0, -1.0).normalized();
  const Vector3 out = Vector3(1.0, 0.0, 1.0).normalized();
  SurfaceSamples samples;
  for (int i = -40; i <= 40; ++i) {
    samples.points.push_back(1e-3 * i * along);
    samples.normals.push_back(-out);
  }
  const SampledBody body(samples, Vector3(3e-4, 5e-4, 6e-4));
  const EdgeSet moving({{-0.04 * along, 0.04 * along}});
  const EdgeSet still({{Vector3(0.0, -0.1, 0.0), Vector3(0.0, 0.1, 0.0)}});
  const AnalyticField field(TableEdge{}, kSubstepVoxel);
  for (const auto& [step, bound] : {std::pair(4e-6, 1e-3), std::pair(3e-5, 1e-3), std::pair(2.1e-4, 0.1)}) {
    AnalyticRun<AnalyticField, EdgeCycle> run(field, body, pose_at(1e-3 * out));
    run.parameters.margin = kSubstepMargin;
    run.cycle.edges = {moving.view(), still.view()};
    for (double depth = -1e-3; depth < 3e-3; depth += 2e-5) ASSERT_EQ(run.step(pose_at(-depth * out)), Status::kOk);
    double most = 0.0;
    for (double x = 0.0; x < 4e-3; x += step) {
      ASSERT_EQ(run.step(pose_at(-3e-3 * out + x * along)), Status::kOk);
      const Vector3 force = run.report.force.spring_W.force;
      ASSERT_GT(force.norm(), 1.0);
      most = std::max(most, std::fabs(force.dot(run.state.H_WS.rotation._transformVector(along))) / force.norm());
    }
    EXPECT_LT(most, bound) << step;
  }
}

/// An edge with points lies over the table's edge, at the margin m. Pressed down, it is to slide along itself. A point
/// s before the table's edge has the distance D = hypot(s, m) from it, and may come nearer by D - m: the edge may slide
/// by D (D - m) / s, least for the nearest point. The edges imply the rows of all points. Of those that hold, three are
/// dropped in a sub-step, one after the other; the fourth one holds the edge.
TEST(ContactSubsteps, DropImpliedRowsThreeTimes) {
  const Vector3 along = Vector3(1.0, 0.0, -1.0).normalized();
  const Vector3 out = Vector3(1.0, 0.0, 1.0).normalized();
  constexpr double kSpacing = 2e-6;
  SurfaceSamples samples;
  samples.points = {-0.01 * along, 0.01 * along};
  for (int i = 1; i <= 8; ++i) samples.points.push_back(-kSpacing * i * along);
  samples.normals.assign(samples.points.size(), -out);
  const SampledBody body(samples, Vector3::Constant(4e-4));
  const EdgeSet moving({{-0.01 * along, 0.01 * along}});
  const EdgeSet still({{Vector3(0.0, -0.1, 0.0), Vector3(0.0, 0.1, 0.0)}});
  const AnalyticField field(TableEdge{}, kSubstepVoxel);
  const Vector3 start = kSubstepMargin * out;
  AnalyticRun<AnalyticField, EdgeCycle> run(field, body, pose_at(start));
  run.parameters.margin = kSubstepMargin;
  run.cycle.edges = {moving.view(), still.view()};
  ASSERT_EQ(run.step(pose_at(start - 1e-3 * out + 3e-5 * along)), Status::kOk);
  const auto path = run.cycle.memory->path.poses();
  ASSERT_FALSE(path.empty());
  const Vector3 first = path[0].translation - start;
  const double distance = std::hypot(4.0 * kSpacing, kSubstepMargin);
  EXPECT_NEAR(first.dot(along), distance * (distance - kSubstepMargin) / (4.0 * kSpacing), 2e-7);
  EXPECT_NEAR(first.dot(out), 0.0, 1e-7) << "the table's edge holds it";
}

/// The edge of a table whose stored distances are 1 um too small.
struct LowTableEdge : TableEdge {
  double distance(const Vector3& p) const noexcept { return TableEdge::distance(p) - 1e-6; }
};

/// An edge with a point lies on the table's edge, at the margin, and friction holds it. By the field the point has lost
/// 1 um and would lift the edge, but the row of the edges implies its row. The rays of the point's friction cone are
/// several forces of that one row; the row of the edges stays, and the edge rests.
TEST(ContactSubsteps, KeepTheRowsOfEdgesThatFrictionHolds) {
  const Vector3 along = Vector3(1.0, 0.0, -1.0).normalized();
  const Vector3 out = Vector3(1.0, 0.0, 1.0).normalized();
  const SampledBody body({{Vector3::Zero(), -0.01 * along, 0.01 * along}, {-out, -out, -out}}, Vector3::Constant(4e-4));
  const EdgeSet moving({{-0.01 * along, 0.01 * along}});
  const EdgeSet still({{Vector3(0.0, -0.1, 0.0), Vector3(0.0, 0.1, 0.0)}});
  const AnalyticField field(LowTableEdge{}, kSubstepVoxel);
  const Vector3 start = kSubstepMargin * out;
  AnalyticRun<AnalyticField, EdgeCycle> run(field, body, pose_at(start));
  run.parameters.margin = kSubstepMargin;
  run.parameters.friction = {0.2, 0.18, 0.0};
  run.cycle.edges = {moving.view(), still.view()};
  run.cycle.has_friction = true;
  ASSERT_EQ(run.step(pose_at(start - 1e-3 * out + 2e-5 * along)), Status::kOk);
  EXPECT_LT((run.state.H_WS.translation - start).norm(), 1e-8);
  const ConstrainedStep& last = run.cycle.memory->last_step;
  EXPECT_GT(last.force_count, 0u);
  for (std::uint32_t k = 0; k < last.force_count; ++k) EXPECT_TRUE(detail::is_edge_pair(last.forces[k].id)) << k;
}

/// A floor that rises by 8 um beyond x = 0.1 mm, which its gradient does not show.
struct HiddenRise {
  double distance(const Vector3& p) const noexcept {
    return p.z() - 8e-6 * std::clamp((p.x() - 1e-4) / 1e-4, 0.0, 1.0);
  }
  Vector3 gradient(const Vector3& /*p*/) const noexcept { return Vector3::UnitZ(); }
};

/// The motion of a point along the floor would end below the wanted margin. The surface that a second look sees there
/// allows the same motion, so looking again and again would not help: the motion is halved at once.
TEST(ContactSubsteps, HalveAMotionThatASecondLookDoesNotChange) {
  const AnalyticField field(HiddenRise{}, kSubstepVoxel);
  const SampledBody body({{Vector3::Zero()}, {-Vector3::UnitZ()}}, Vector3::Constant(4e-5));
  SubstepRun<> run(field, body, pose_at({0.0, 0.0, kSubstepMargin}));
  ASSERT_EQ(run.step(pose_at({2e-4, 0.0, -1e-3})), Status::kOk);
  const auto path = run.memory().path.poses();
  ASSERT_FALSE(path.empty());
  EXPECT_NEAR(path[0].translation.x(), 1e-4, 1e-6);
  EXPECT_NEAR(path[0].translation.z(), kSubstepMargin, 1e-7);
  EXPECT_LT(run.depth(), 0.0);
}

/// The walls of a slit as narrow as a point. The field has no direction there, and its distances fall twice as fast as
/// the walls come nearer.
struct NarrowSlit {
  double distance(const Vector3& p) const noexcept { return 1e-12 - 2.0 * std::fabs(p.x()); }
  Vector3 gradient(const Vector3& /*p*/) const noexcept { return Vector3::Zero(); }
};

/// No share of a motion through the walls is free, and no second look leads on. The god object stays exactly where it
/// is, and the cycle says that it cut the motion.
TEST(ContactSubsteps, StayWhereNoShareOfTheMotionIsFree) {
  const AnalyticField field(NarrowSlit{}, kSubstepVoxel);
  const SampledBody body({{Vector3::Zero()}, {-Vector3::UnitX()}}, Vector3::Constant(4e-5));
  const Pose start = pose_at({0.0, 0.01, 0.02}, {0.1, -0.2, 0.3});
  SubstepRun<> run(field, body, start);
  for (int cycle = 0; cycle < 3; ++cycle) {
    ASSERT_EQ(run.step(pose_at({1e-3, 0.01, 0.02}, {0.1, -0.2, 0.3})), Status::kOk);
    EXPECT_TRUE(run.state.H_WS == start) << cycle;
    EXPECT_LT(run.depth(), 0.0) << cycle;
    EXPECT_EQ(run.report.outcome, Outcome::kCut) << cycle;
    EXPECT_EQ(run.memory().last_step.motion.translation, Vector3::Zero()) << cycle;
  }
}

}  // namespace
}  // namespace godobject::test::contact_substeps_test
