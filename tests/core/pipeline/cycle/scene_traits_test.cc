#include "core/pipeline/cycle/scene_traits.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace godobject::scene_traits_test {
namespace {

using format::Solver;

/// All builds, solvers and scenes: a part is missing if and only if the pipeline needs it and the build lacks it.
TEST(SceneTraits, LackExactlyThePartsThatAPipelineNeeds) {
  for (unsigned bits = 0; bits < 128; ++bits) {
    const auto bit = [bits](int i) { return (bits >> i & 1u) != 0u; };
    const SceneTraits traits{bit(0), bit(1), bit(2), bit(3), bit(4), bit(5), bit(6)};
    for (const Solver solver : {Solver::kPaper, Solver::kCorrected, Solver::kContact}) {
      for (unsigned scene = 0; scene < 16; ++scene) {
        const bool friction = (scene & 1u) != 0u;
        const bool has_features = (scene & 2u) != 0u;
        const bool ball = (scene & 4u) != 0u;
        const bool has_edges = (scene & 8u) != 0u;
        std::vector<Part> missing;
        if (solver == Solver::kPaper && !traits.paper) missing.push_back(Part::kPaper);
        if (solver == Solver::kCorrected && !traits.corrected) missing.push_back(Part::kCorrected);
        if (solver == Solver::kContact) {
          if (!traits.contact) missing.push_back(Part::kContact);
          if (has_features && !traits.features) missing.push_back(Part::kFeatures);
          if (has_edges && !traits.edges) missing.push_back(Part::kEdges);
          // only a ball without friction needs no points
          const bool needs_points = !(ball && !friction);
          if (needs_points && !traits.points) missing.push_back(Part::kPoints);
        }
        if (friction && !traits.friction) missing.push_back(Part::kFriction);
        EXPECT_EQ(missing_part(traits, solver, friction, has_features, ball, has_edges),
                  missing.empty() ? Part::kNone : missing.front())
            << "build " << bits << ", scene " << scene;
      }
    }
  }
}

TEST(SceneTraits, OfThisBuildAreAll) {
  const SceneTraits first;
  EXPECT_TRUE(first.paper && first.corrected && first.contact && first.friction && first.features && first.edges &&
              first.points);
  EXPECT_TRUE(kSceneTraits.paper && kSceneTraits.corrected && kSceneTraits.contact);
  EXPECT_TRUE(kSceneTraits.friction && kSceneTraits.features && kSceneTraits.edges && kSceneTraits.points);
  EXPECT_EQ(missing_part(SceneTraits{}, Solver::kContact, true, true), Part::kNone);
}

/// A scene of up to two sample points.
struct Points {
  std::array<float, 2> x{}, y{}, z{};
  SceneView scene(std::size_t count) {
    SceneView view;
    view.pointshell.size = count;
    view.pointshell.x = x.data();
    view.pointshell.y = y.data();
    view.pointshell.z = z.data();
    return view;
  }
};

TEST(IsBall, IsOnePointAtTheCentreOfMass) {
  Points points;
  EXPECT_TRUE(is_ball(points.scene(1)));
  EXPECT_FALSE(is_ball(points.scene(2)));
  EXPECT_FALSE(is_ball(points.scene(0)));
  for (std::array<float, 2>* axis : {&points.x, &points.y, &points.z}) {
    (*axis)[0] = 1e-20f;
    EXPECT_FALSE(is_ball(points.scene(1)));
    (*axis)[0] = 0.0f;
    (*axis)[1] = 1.0f;  // not a point of a scene of one
    EXPECT_TRUE(is_ball(points.scene(1)));
    EXPECT_FALSE(is_ball(points.scene(2)));
    (*axis)[1] = 0.0f;
  }
  SceneView with_features = points.scene(1);
  with_features.features.size = 1;
  EXPECT_FALSE(is_ball(with_features));
}

}  // namespace
}  // namespace godobject::scene_traits_test
