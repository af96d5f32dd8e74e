// Sessions that the fuzzer's generator draws, each short, with the watch on every cycle. Analytic worlds and compiled
// scenes, with and without friction, all options together.
#include <algorithm>
#include <random>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "tests/support/folder_test.h"
#include "toolchain/report/extremes/run.h"

namespace godobject::watch {
namespace {

struct World {
  const char* name;
  bool is_compiled;
};

constexpr World kWorlds[] = {{"plane", false},      {"slot", false},      {"groove", false},     {"bore", false},
                             {"plate", false},      {"heap", false},      {"mesh-box", true},    {"mesh-ball", true},
                             {"mesh-turned", true}, {"mesh-plate", true}, {"mesh-cavity", true}, {"mesh-shell", true}};
constexpr int kAnalyticSessions = 14;  // of each world
constexpr int kCompiledSessions = 2;   // with and without friction

class WatchedSessions : public test::FolderTest, public ::testing::WithParamInterface<std::tuple<int, int>> {};

/// Returns the session number `number` in a world, drawn for the `attempt`-th time. Even numbers have friction.
report::Setup session_in(const World& world, std::size_t at, int number, int attempt) {
  const auto seed = 1000 * at + 31 * static_cast<std::size_t>(number) + 17 + 500 * static_cast<std::size_t>(attempt);
  std::mt19937 random(static_cast<std::uint32_t>(seed));
  report::Setup setup = report::any_setup(random);
  setup.world = world.name;
  setup.friction = number % 2 == 0;
  setup.solver = format::Solver::kContact;
  setup.cycles = 600;
  setup.points = std::min(setup.points, 100);
  if (world.is_compiled) {
    const char* const bodies[] = {"box", "ell", "ball"};
    setup.body = bodies[(at + static_cast<std::size_t>(number)) % 3];
    setup.points = std::max(setup.points, 41);  // as many as the tree's levels need
    setup.voxel = std::max(setup.voxel, 0.15);
    setup.scale = 0.02;
    setup.far = 0.0;
    setup.body_scale = 1.0;
    setup.bad_every = 37;
  }
  return setup;
}

TEST_P(WatchedSessions, HoldEveryProperty) {
  const auto [at, number] = GetParam();
  const World& world = kWorlds[at];
  constexpr int kAttempts = 4;
  bool touches = false;
  for (int attempt = 0; attempt < kAttempts && !touches; ++attempt) {  // some drawn sessions never touch
    const report::Setup setup = session_in(world, static_cast<std::size_t>(at), number, attempt);
    const Findings found = run_setup(setup, *make_rig(setup, folder_));
    EXPECT_EQ(found.violations(), 0) << case_file(setup, found.first());
    touches = found.touching > 0;
  }
  EXPECT_TRUE(touches) << "no session touches";
}

std::string name_of(const ::testing::TestParamInfo<std::tuple<int, int>>& info) {
  std::string name = kWorlds[std::get<0>(info.param)].name;
  std::erase(name, '-');
  return name + "_" + std::to_string(std::get<1>(info.param));
}

INSTANTIATE_TEST_SUITE_P(Analytic, WatchedSessions,
                         ::testing::Combine(::testing::Range(0, 6), ::testing::Range(0, kAnalyticSessions)), name_of);
INSTANTIATE_TEST_SUITE_P(Compiled, WatchedSessions,
                         ::testing::Combine(::testing::Range(6, 12), ::testing::Range(0, kCompiledSessions)), name_of);

}  // namespace
}  // namespace godobject::watch
