// The sub-steps of one cycle: the path, the motion that the next cycle starts from, and the report agree; a cycle goes
// on past an edge.

#include "core/pipeline/contact/contact_substeps.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include <gtest/gtest.h>

#include "core/pipeline/contact/contact_cycle.h"
#include "tests/support/analytic_worlds.h"
#include "tests/support/random.h"

namespace godobject::test {
namespace {

constexpr double kVoxel = 0.002;
constexpr double kMargin = 2e-5;

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

Pose at(const Vector3& position, const Vector3& turn = Vector3::Zero()) {
  Pose pose;
  pose.translation = position;
  pose.rotation = exp_rotation(turn);
  return pose;
}

template <class Shape, bool kFriction = false>
struct SubstepRun : AnalyticRun<AnalyticField<Shape>, ContactCycle<kFriction>> {
  using Base = AnalyticRun<AnalyticField<Shape>, ContactCycle<kFriction>>;
  SubstepRun(const AnalyticField<Shape>& f, const SampledBody& b, const Pose& start) : Base(f, b, start) {
    this->parameters.margin = kMargin;
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
  const AnalyticField<Block> field({}, kVoxel);
  const SampledBody body = box_body(4);
  SubstepRun<Block, kFriction> run(field, body, at({0.0, 0.0, 0.06}));
  run.parameters.workspace = workspace;
  Pose device = run.state.H_WS;
  Motion velocity;
  Seen seen;
  for (int cycle = 0; cycle < 600; ++cycle) {
    if (cycle % 30 == 0) velocity = random.motion(std::pow(10.0, random.between(-5.0, -2.3)), 0.05);
    if (cycle % 150 == 149) device = at(random.in_cube(0.07), random.in_cube(1.0));
    device = device * set_matrix(velocity);
    if (device.translation.norm() > 0.08) device.translation *= 0.9;
    device.translation = workspace.nearest(device.translation);
    const Pose before = run.state.H_WS;
    EXPECT_EQ(run.step(device), Status::kOk);
    const auto path = run.memory().path.poses();
    EXPECT_FALSE(path.empty());
    if (path.empty()) return seen;
    // the stored motion is the sum of the motions of the sub-steps, each in the frame of its start; the last one, on
    // which nothing holds the body any more, need not count; the motion of a free cycle is that to the device
    Motion sum, before_last;
    Pose from = before;
    for (const Pose& to : path) {
      const Motion part = get_motion(from.inverse() * to);
      before_last = sum;
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
    const bool ends_free = path.size() > 1 && last.follows && from == device;
    const Motion wanted = get_motion(before.inverse() * device);
    EXPECT_TRUE(stored(sum) || (ends_free && (stored(before_last) || stored(wanted)))) << cycle;
    EXPECT_TRUE(run.memory().H_WD_last == device);
    // the report is that of the last sub-step
    EXPECT_EQ(run.report.contacts, last.contact_count);
    EXPECT_EQ(last.force_count > 0, last.contact_count > 0);
    EXPECT_LE(last.contact_count, last.force_count);
    EXPECT_GE(run.report.substeps, 1u);
    EXPECT_LE(run.report.substeps, kMaxSubsteps);
    EXPECT_LE(run.report.substeps, std::max<std::size_t>(1, path.size()));
    const bool at_device = run.state.H_WS == device;
    if (at_device && last.force_count == 0) {
      EXPECT_EQ(run.report.outcome, Outcome::kFree) << cycle;
      EXPECT_EQ(run.report.force.spring_W.force, Vector3::Zero());
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

/// A point slides on the top of a block and past its edge. The device is 0.3 mm below the top. Beyond the edge nothing
/// holds the point: in the same cycle it goes to the device.
TEST(ContactSubsteps, GoDownToTheDevicePastAnEdgeInTheSameCycle) {
  const AnalyticField<Block> field({}, kVoxel);
  const SampledBody body({{Vector3::Zero()}, {-Vector3::UnitZ()}}, Vector3::Constant(4e-5));
  for (const double begin : {0.0, 1e-4, 2.5e-4, 4e-4}) {
    SubstepRun<Block> run(field, body, at({0.018 + begin, 0.0, 0.0101}));
    for (int i = 1; i < 10; ++i) {
      const double x = 0.018 + begin + 5e-4 * i;
      ASSERT_EQ(run.step(at({x, 0.0, 0.0097})), Status::kOk);
      const Vector3 here = run.state.H_WS.translation;
      ASSERT_NEAR(here.x(), x, 1e-7) << "without friction it keeps up";
      if (x < 0.02 - 1e-9) {
        EXPECT_NEAR(here.z(), 0.01 + kMargin, 0.1 * kMargin) << x;
        EXPECT_EQ(run.report.outcome, Outcome::kContact);
      } else if (x > 0.02 + 1e-4) {
        EXPECT_NEAR(here.z(), 0.0097, 1e-9) << x;
        EXPECT_EQ(run.report.outcome, Outcome::kFree) << x;
        EXPECT_EQ(run.report.contacts, 0u);
      }
    }
  }
}

/// The memory of a cycle does not outlive a reset.
TEST(ContactMemory, ForgetsTheLastCycleWhenReset) {
  const auto memory = std::make_unique<ContactMemory>();
  memory->last_step.motion = {Vector3(1.0, 2.0, 3.0), Vector3(4.0, 5.0, 6.0)};
  memory->last_step.force_count = 2;
  memory->H_WD_last = at({1.0, 2.0, 3.0}, {0.1, 0.2, 0.3});
  memory->path.push(memory->H_WD_last);
  memory->reset();
  EXPECT_EQ(memory->last_step.motion.translation, Vector3::Zero());
  EXPECT_EQ(memory->last_step.motion.rotation, Vector3::Zero());
  EXPECT_EQ(memory->last_step.force_count, 0u);
  EXPECT_TRUE(memory->H_WD_last == Pose{});
  EXPECT_TRUE(memory->path.poses().empty());
}

}  // namespace
}  // namespace godobject::test
