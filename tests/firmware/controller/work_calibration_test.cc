#include "firmware/controller/work_calibration.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/small_scenes.h"
#include "toolchain/files/aligned_bytes.h"

namespace godobject::firmware::work_calibration_test {
namespace {

/// A clock on which every reading takes a microsecond.
class Ticking final : public hal::Clock {
 public:
  std::int64_t now_ns() noexcept override { return now_ += 1000; }
  void sleep_until(std::int64_t) noexcept override {}

 private:
  std::int64_t now_ = 0;
};

class WorkCalibration : public testing::Test {
 protected:
  test::SceneImage image_ = test::ball_over_plate();
  SceneView scene_ = test::open_scene(image_);
  files::AlignedBytes memory_{GodObject::memory_size(Scene::of(scene_))};
  Pose start_{Quaternion::Identity(), Vector3(0.0, 0.0, 0.06)};
};

/// From the start to the middle of the plate, in steps no longer than a thousandth of the way and the swing.
TEST_F(WorkCalibration, MovesFromTheStartToTheMiddleOfTheStillBody) {
  start_.rotation = exp_rotation({0.3, -0.2, 0.5});
  const std::vector<Pose> path = calibration_path(scene_, start_);
  const Vector3& p = scene_.H_MB.translation;
  EXPECT_LT((path.front().translation - start_.translation).norm(), 1e-12);
  EXPECT_LT((path.front().rotation.coeffs() - start_.rotation.coeffs()).norm(), 1e-12);
  Vector3 middle;
  for (int axis = 0; axis < 3; ++axis) {
    middle[axis] = 0.5 * (scene_.grid.surface_min[axis] + scene_.grid.surface_max[axis]);
  }
  double nearest = std::numeric_limits<double>::infinity();
  const double way = (start_ * p - middle).norm();
  for (std::size_t k = 0; k < path.size(); ++k) {
    EXPECT_NEAR(path[k].rotation.norm(), 1.0, 1e-12);
    nearest = std::min(nearest, (path[k] * p - middle).norm());
    if (k == 0) continue;
    EXPECT_LT((path[k] * p - path[k - 1] * p).norm(), 0.006 * way) << k;
    EXPECT_LT(log_rotation(path[k].rotation * path[k - 1].rotation.conjugate()).norm(), 0.01) << k;
  }
  EXPECT_LT(nearest, 1e-12);
  start_.translation = middle - start_.rotation * p;  // no way to go
  for (const Pose& H : calibration_path(scene_, start_)) EXPECT_TRUE(H.translation.allFinite());
}

/// The worst cycle by hand: all take the same time, so it is the one with the least work.
TEST_F(WorkCalibration, TakesTheWorstCycle) {
  const std::vector<Pose> path = calibration_path(scene_, start_);
  GodObject god_object;
  ASSERT_EQ(god_object.start(Scene::of(scene_), Solver::kContact, true, memory_.span()), Status::kOk);
  std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
  std::uint32_t contacts = 0;
  CycleReport report;
  for (const Pose& H : path) {
    ASSERT_EQ(god_object.update({H, Motion{}}, report), Status::kOk);
    least = std::min(least, report.work);
    contacts += report.contacts > 0 ? 1 : 0;
  }
  Ticking clock;
  const WorkCost cost = measure_work(scene_, true, path, memory_.span(), clock);
  EXPECT_DOUBLE_EQ(cost.longest, 1e-6);
  EXPECT_DOUBLE_EQ(cost.unit, 1e-6 / static_cast<double>(least));
  EXPECT_EQ(cost.contacts, contacts);
  EXPECT_GT(contacts, 100u);
}

TEST_F(WorkCalibration, TellsABudgetThatHoldsTheGodObject) {
  const std::vector<Pose> path = calibration_path(scene_, start_);
  const BudgetTrial none = try_budget(scene_, true, path, memory_.span(), std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(none.cycles, path.size());
  EXPECT_EQ(none.ended, 0u);
  EXPECT_LT(none.short_by, 1e-5);
  const BudgetTrial one = try_budget(scene_, true, path, memory_.span(), 1);
  EXPECT_EQ(one.ended, one.cycles);
  EXPECT_GT(one.short_by, 0.02) << "it stays at the start";
  const BudgetTrial enough = try_budget(scene_, true, path, memory_.span(), 400000);
  EXPECT_LT(enough.short_by, 1e-4);
}

/// A scene without friction, or memory that is too small, gives no cost: the cycle's own start tells why.
TEST_F(WorkCalibration, HasNoCostWhereTheGodObjectDoesNotStart) {
  const std::vector<Pose> path = calibration_path(scene_, start_);
  Ticking clock;
  EXPECT_EQ(measure_work(scene_, true, path, {}, clock).unit, 0.0);
  EXPECT_EQ(try_budget(scene_, true, path, {}, 1).cycles, 0u);
}

}  // namespace
}  // namespace godobject::firmware::work_calibration_test
