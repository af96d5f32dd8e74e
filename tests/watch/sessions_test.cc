// Sessions that the fuzzer's generator draws, each short, with the watch on every cycle: analytic worlds, with and
// without friction, all options together. compiled_sessions_test.cc has worlds from the scene compiler.
#include <algorithm>
#include <random>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "toolchain/report/extremes/run.h"

namespace godobject::watch {
namespace {

constexpr const char* kWorlds[] = {"plane", "slot", "groove", "bore", "plate", "heap"};
constexpr int kSessions = 40;  // of each world

class WatchedSessions : public ::testing::TestWithParam<std::tuple<int, int>> {};

/// Returns the session number `number` in a world, drawn for the `attempt`-th time. Even numbers have friction.
report::Setup session_in(int world, int number, int attempt) {
  const int seed = 1000 * world + 31 * number + 17 + 500 * attempt;
  std::mt19937 random(static_cast<std::uint32_t>(seed));
  report::Setup setup = report::any_setup(random);
  setup.world = kWorlds[world];
  setup.friction = number % 2 == 0;
  setup.solver = format::Solver::kContact;
  setup.cycles = 600;
  setup.points = std::min(setup.points, 100);
  return setup;
}

TEST_P(WatchedSessions, HoldEveryProperty) {
  const auto [world, number] = GetParam();
  constexpr int kAttempts = 4;
  bool touches = false;
  for (int attempt = 0; attempt < kAttempts && !touches; ++attempt) {  // some drawn sessions never touch
    const report::Setup setup = session_in(world, number, attempt);
    const Findings found = run_setup(setup, *make_rig(setup, {}));
    EXPECT_EQ(found.violations(), 0) << case_file(setup, found.first());
    // a reference that did not converge judges nothing; thin bodies between solids have the most of these
    EXPECT_LE(found.not_converged, 3 + found[Property::kNoPull].judged / 50) << case_file(setup, "not converged");
    touches = found.touching > 0;
  }
  EXPECT_TRUE(touches) << "no session touches";
}

std::string name_of(const ::testing::TestParamInfo<std::tuple<int, int>>& info) {
  return std::string(kWorlds[std::get<0>(info.param)]) + "_" + std::to_string(std::get<1>(info.param));
}

INSTANTIATE_TEST_SUITE_P(All, WatchedSessions,
                         ::testing::Combine(::testing::Range(0, 6), ::testing::Range(0, kSessions)), name_of);

}  // namespace
}  // namespace godobject::watch
