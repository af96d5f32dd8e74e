// Sessions in worlds from the scene compiler, with the watch on every cycle: one of each kind of mesh, both directions.
#include <cstdint>
#include <memory>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/folder_test.h"
#include "toolchain/report/extremes/compiled_world.h"
#include "toolchain/report/extremes/run.h"

namespace godobject::watch {
namespace {

constexpr const char* kWorlds[] = {"mesh-box", "mesh-ball", "mesh-plate", "mesh-turned", "mesh-cavity", "mesh-shell"};

/// Draws setups until one has this world and, of the bodies, `center` or another one.
report::Setup session_in(const std::string& world, bool center, std::mt19937& random) {
  report::Setup setup;
  do {
    setup = report::any_setup(random);
    report::choose_mesh(setup);
  } while (setup.world != world || (setup.body == "center") != center);
  setup.solver = format::Solver::kContact;
  setup.motion = "seek";
  setup.voxel = std::max(setup.voxel, 0.2);  // compiles in a second or two
  setup.cycles = 1500;
  return setup;
}

using CompiledSessions = test::FolderTest;

TEST_F(CompiledSessions, HoldEveryPropertyAndJudgeEach) {
  std::mt19937 random(3);
  Findings all;
  int with_features = 0;
  int moved = 0;
  bool friction = false;
  const auto run = [&](const std::string& world, bool center) {
    report::Setup setup = session_in(world, center, random);
    setup.friction = friction = !friction;
    moved += setup.far > 0.0 ? 1 : 0;
    const auto rig = make_rig(setup, folder_);
    const WatchedSession watched = rig->watched();
    with_features += watched.directions.size() > 1 ? 1 : 0;
    const Findings found = run_setup(setup, *rig);
    EXPECT_EQ(found.violations(), 0) << case_file(setup, found.first());
    EXPECT_GT(found.touching, 0) << case_file(setup, "never touches");
    EXPECT_GT(found[Property::kMesh].judged, 0) << case_file(setup, "the exact mesh is not looked at");
    all.add(found);
  };
  for (const char* const world : kWorlds) run(world, false);
  run("mesh-box", true);
  EXPECT_GT(with_features, 3);
  EXPECT_GT(moved, 0);
  for (std::size_t i = 0; i < kPropertyCount; ++i) {
    const auto property = static_cast<Property>(i);
    EXPECT_GT(all[property].judged, 0) << describe(property);
  }
}

/// A case file brings back a later session of a world, though it compiles the world again.
TEST_F(CompiledSessions, LaterOnesComeBackFromTheirCaseFiles) {
  std::mt19937 random(6);
  const report::Setup first = session_in("mesh-turned", false, random);
  const auto world = std::make_shared<const report::CompiledWorld>(first, folder_);
  std::int64_t touching = 0;
  for (int i = 0; i < 3; ++i) {
    report::Setup setup = any_session_in(first, random);
    setup.cycles = 400;
    const auto rig = make_rig_in(world, setup);
    const Findings found = run_setup(setup, *rig);
    EXPECT_EQ(found.violations(), 0) << case_file(setup, found.first());
    const report::Setup read = report::read_case(case_file(setup, ""));
    const auto again = make_rig(read, folder_);
    const Findings repeated = run_setup(read, *again);
    EXPECT_EQ(repeated.touching, found.touching);
    for (std::size_t k = 0; k < kPropertyCount; ++k) {
      EXPECT_EQ(repeated.tallies[k].judged, found.tallies[k].judged);
      EXPECT_EQ(repeated.tallies[k].worst, found.tallies[k].worst) << describe(static_cast<Property>(k));
    }
    EXPECT_NE(found.touching, touching) << "another motion";
    touching = found.touching;
  }
}

}  // namespace
}  // namespace godobject::watch
