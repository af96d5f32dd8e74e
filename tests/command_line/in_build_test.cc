#include "toolchain/command_line/in_build.h"

#include <gtest/gtest.h>

#include "toolchain/command_line/failure.h"

namespace godobject::command {
namespace {

using format::Solver;

TEST(InBuild, LetsAllPipelinesOfAWholeBuildRun) {
  const SceneView scene;
  for (const Solver solver : {Solver::kPaper, Solver::kCorrected, Solver::kContact}) {
    for (const bool friction : {false, true}) EXPECT_NO_THROW(require_in_build("x.scene", scene, solver, friction));
  }
}

TEST(InBuild, NamesTheSceneThePartAndTheOptionToDrop) {
  constexpr SceneTraits kBall{.paper = false, .corrected = false, .friction = false, .features = false, .edges = false};
  SceneView scene;
  const auto message = [&](Solver solver, bool friction) -> std::string {
    try {
      require_in_build("x.scene", scene, solver, friction, kBall);
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.exit_code(), ExitCode::kBadConfig);
      return failure.what();
    }
    return {};
  };
  EXPECT_EQ(message(Solver::kContact, false), "");
  for (const std::string& said :
       {message(Solver::kPaper, false), message(Solver::kCorrected, false), message(Solver::kContact, true)}) {
    EXPECT_EQ(said.find("x.scene: needs "), 0u) << said;
    EXPECT_NE(said.find("-DGODOBJECT_SCENE"), std::string::npos) << said;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  }
  EXPECT_NE(message(Solver::kPaper, false).find("the solver paper"), std::string::npos);
  EXPECT_NE(message(Solver::kContact, true).find("needs friction"), std::string::npos);
  const std::array<format::SharpEdge, 1> edge{};
  scene.edges.edges = edge;
  EXPECT_NE(message(Solver::kContact, false).find("edge against edge"), std::string::npos);
  scene.features.size = 1;
  EXPECT_NE(message(Solver::kContact, false).find("the second direction"), std::string::npos);
}

}  // namespace
}  // namespace godobject::command
