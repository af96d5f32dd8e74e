// The plant of the study: closed forms compared with hand-computed motions and a fine integration.
#include "toolchain/report/stability/axis_loop.h"

#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "core/device/stability.h"
#include "tests/support/random.h"
#include "toolchain/report/stability/cases.h"

namespace godobject::report {
namespace {

TEST(FreeAxis, MovesAsByHand) {
  FreeAxis::State state{.x = 1.0, .v = 2.0};
  FreeAxis(2.0, 0.0, 0.5).advance(6.0, state);  // 3 m/s^2 for half a second
  EXPECT_DOUBLE_EQ(state.v, 3.5);
  EXPECT_DOUBLE_EQ(state.x, 1.0 + 1.0 + 0.375);
  state = {.x = 0.0, .v = 1.0};
  FreeAxis(1.0, 2.0, std::log(2.0) / 2.0).advance(0.0, state);  // the velocity halves
  EXPECT_NEAR(state.v, 0.5, 1e-15);
  EXPECT_NEAR(state.x, 0.25, 1e-15);
}

TEST(FreeAxis, IsTheSameInOneStepAndInMany) {
  test::Random random(1);
  for (int trial = 0; trial < 100; ++trial) {
    const double mass = random.between(0.1, 5.0);
    const double damping = trial % 4 == 0 ? 1e-5 * mass : random.between(0.0, 20.0);
    const double force = random.between(-5.0, 5.0);
    FreeAxis::State once{random.between(-1.0, 1.0), random.between(-1.0, 1.0)};
    FreeAxis::State often = once;
    FreeAxis(mass, damping, 0.1).advance(force, once);
    const FreeAxis part(mass, damping, 1e-4);
    for (int i = 0; i < 1000; ++i) part.advance(force, often);
    EXPECT_NEAR(once.x, often.x, 1e-12);
    EXPECT_NEAR(once.v, often.v, 1e-12);
  }
}

TEST(DryFriction, SlidesToRestAndSticks) {
  FreeAxis::State state{.x = 0.0, .v = 1.0};
  advance_with_friction(1.0, 0.0, 2.0, 0.0, 10.0, state);  // 2 m/s^2: half a second, a quarter of a metre
  EXPECT_DOUBLE_EQ(state.v, 0.0);
  EXPECT_DOUBLE_EQ(state.x, 0.25);
  advance_with_friction(1.0, 0.0, 2.0, 2.0, 1.0, state);
  EXPECT_DOUBLE_EQ(state.x, 0.25) << "held up to c";
  advance_with_friction(1.0, 0.0, 2.0, -3.0, 1.0, state);
  EXPECT_DOUBLE_EQ(state.x, -0.25) << "1 m/s^2 beyond it";
  state = {.x = 0.0, .v = 1.0};
  advance_with_friction(1.0, 0.0, 2.0, -3.0, 1.2, state);  // stops after 0.2 s at 0.1 m, back at 1 m/s^2 for 1 s
  EXPECT_NEAR(state.x, 0.1 - 0.5, 1e-15);
}

TEST(DelayedHold, BringsEachForceLateByItsDelay) {
  for (const double delay : {0.0, 0.3, 1.0, 2.75}) {
    DelayedHold hold(delay);
    const int whole = static_cast<int>(std::floor(delay));
    for (int k = 0; k < 20; ++k) {
      hold.send(k + 1.0);
      EXPECT_DOUBLE_EQ(hold.after(), std::max(0.0, k + 1.0 - whole)) << delay;
      EXPECT_DOUBLE_EQ(hold.before(), std::max(0.0, k - 1.0 + 1.0 - whole)) << delay;
    }
    EXPECT_NEAR(hold.share_before(), delay - whole, 1e-15);
  }
}

TEST(ImposedWork, OfATriangleIsThatOfTheHold) {
  // back and forth between 0 and a: -K a a acts on the way back to 0, no force on the way there
  const ImposedWork work = imposed_work({0.0, 2.0}, {.stiffness = 3.0}, 0.0);
  EXPECT_DOUBLE_EQ(work.generated, 3.0 * 2.0 * 2.0);
  EXPECT_DOUBLE_EQ(work.square_motion, 2.0 * 4.0 / 1e-3);
  EXPECT_DOUBLE_EQ(imposed_work({0.0, 2.0}, {.stiffness = 3.0}, 1.0).generated, -12.0) << "a period later it brakes";
}

/// The plant, its hold and delay share no code with the theory.
TEST(SimulatedBoundary, IsTheExactOne) {
  test::Random random(2);
  for (int trial = 0; trial < 12; ++trial) {
    AxisSetup setup{.mass = random.between(0.2, 3.0),
                    .damping = random.between(0.5, 5.0),
                    .delay = 1e-3 * random.between(0.0, 3.0)};
    setup.virtual_damping = trial % 3 == 0 ? 0.0 : random.between(0.0, 0.2) * setup.mass / setup.period;
    AxisLoop loop;
    loop.mass = setup.mass;
    loop.damping = setup.damping;
    loop.virtual_damping = setup.virtual_damping;
    loop.timing = {setup.period, setup.delay, 2};
    const double exact = stability_boundary(loop);
    EXPECT_NEAR(simulated_boundary(setup), exact, 1e-3 * exact);
  }
}

/// Above the boundary the damping needs all the force that a plate can exert, and the swing remains: the plate is not
/// stable.
TEST(StiffestStablePlate, DoesNotCountASwingThatStays) {
  const std::filesystem::path work = testing::TempDir() + "/stiffest_stable_plate";
  std::filesystem::create_directories(work);
  const AxisSetup setup{.damping = 2.0, .virtual_damping = 400.0, .delay = 2e-3};
  const double exact = stability_boundary(
      {.mass = setup.mass, .damping = setup.damping, .virtual_damping = 400.0, .timing = {1e-3, setup.delay, 2}});
  const double measured = stiffest_stable_plate(Solver::kContact, setup.delay, 400.0, 8000, work);
  EXPECT_NEAR(measured / exact, 1.0, 0.02);
  std::filesystem::remove_all(work);
}

}  // namespace
}  // namespace godobject::report
