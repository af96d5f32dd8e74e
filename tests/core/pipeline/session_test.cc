// A session of one solver, on a field that counts its look-ups.

#include "core/pipeline/session.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "tests/support/counted_field.h"
#include "tests/support/small_scenes.h"

namespace godobject::test::session_test {
namespace {

/// The budget of work bounds the look-ups of a first cycle as those of any other: a point costs at least 100 units.
TEST(Session, KeepsToTheBudgetOfWorkInTheFirstCycle) {
  const SceneImage image = ball_and([](const Vector3& p) { return ball_distance(p, 0.021); }, Vector3::Constant(0.021));
  SceneView scene;
  ASSERT_EQ(SceneView::open(image.bytes(), scene), Status::kOk);
  using Field = Counted<Voxelmap>;
  const Field field{scene.voxelmap};
  const auto session = std::make_unique<Session<Field, NoBodyField>>();
  std::vector<std::uint32_t> words(session->search_words(scene.pointshell, {}));
  for (const double off : {0.0, 0.001, 0.04}) {  // in the middle all points are near
    int unbounded = 0;
    for (const std::uint64_t budget : {WorkMeter::kUnlimited, std::uint64_t{10000}, std::uint64_t{30000}}) {
      Parameters q = Parameters::make(scene);
      q.work_budget = budget;
      session->start(field, scene.pointshell, {}, q, Solver::kContact, false, words);
      CycleInput input;
      input.H_WD.translation = Vector3(0.0, 0.0, off);
      CycleReport report;
      const int before = field.looks();
      ASSERT_EQ(session->update(input, report), Status::kOk);
      if (budget == WorkMeter::kUnlimited) {
        unbounded = field.looks() - before;
      } else {
        EXPECT_LE(field.looks() - before, 100 + static_cast<int>(budget / 100)) << off << " of " << unbounded;
      }
    }
  }
}

/// A first cycle that is refused leaves the god object where it was placed. Started inside, the body is pushed, and the
/// damping of a velocity near the largest number is infinite.
TEST(Session, StaysWhereItWasPlacedIfTheFirstCycleIsRefused) {
  const SceneImage image = ball_and([](const Vector3& p) { return ball_distance(p, 0.021); }, Vector3::Constant(0.021));
  SceneView scene;
  ASSERT_EQ(SceneView::open(image.bytes(), scene), Status::kOk);
  const auto session = std::make_unique<Session<Voxelmap, NoBodyField>>();
  std::vector<std::uint32_t> words(session->search_words(scene.pointshell, {}));
  Parameters q = Parameters::make(scene);
  q.damping = 1e6;
  session->start(scene.voxelmap, scene.pointshell, {}, q, Solver::kCorrected, false, words);
  Pose placed;
  placed.translation = Vector3(0.3, -0.2, 0.1);
  session->place(placed);
  CycleInput input;
  input.H_WD.translation = Vector3(0.0, 0.0, 0.04);
  input.velocity_W.translation = Vector3(0.0, 0.0, -1e307);
  CycleReport report;
  ASSERT_EQ(session->update(input, report), Status::kNotFinite);
  EXPECT_TRUE(session->state().H_WS == placed);
  EXPECT_FALSE(session->state().started);
  EXPECT_FALSE(session->state().inside);
}

}  // namespace
}  // namespace godobject::test::session_test
