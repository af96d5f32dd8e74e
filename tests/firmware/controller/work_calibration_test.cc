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

/// The path leads from the start to the middle of the plate. A step is at most 0.6 % of that way, and 0.01 rad.
TEST_F(WorkCalibration, MovesFromTheStartToTheMiddleOfTheStillBody) {
  start_.rotation = exp_rotation({0.3, -0.2, 0.5});
  for (int axis = 0; axis < 3; ++axis) scene_.grid.surface_max[axis] += 0.004 * (axis + 1);  // off the origin
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
  // a press turns about two axes, the second one half as often: at some pose about that one alone
  const Vector3 along = (middle - start_ * p).normalized();
  const bool turns_about_second = std::any_of(path.begin(), path.end(), [&](const Pose& pose) {
    const Vector3 turn = log_rotation(pose.rotation * start_.rotation.conjugate());
    return turn.norm() > 0.04 && std::abs(turn.dot(along)) < 0.1 * turn.norm();
  });
  EXPECT_TRUE(turns_about_second);
  start_.translation = middle - start_.rotation * p;  // no way to go
  for (const Pose& H : calibration_path(scene_, start_)) EXPECT_TRUE(H.translation.allFinite());
}

/// Every reading of the clock takes a microsecond, so that each cycle takes one.
TEST_F(WorkCalibration, TimesEachCycleOfAPath) {
  const std::vector<Pose> path = calibration_path(scene_, start_);
  GodObject god_object;
  ASSERT_EQ(god_object.start(Scene::of(scene_), Solver::kContact, true, memory_.span()), Status::kOk);
  constexpr std::uint64_t kUnits = 16000;
  god_object.set_work_budget(kUnits);
  std::uint32_t contacts = 0, ended = 0;
  CycleReport report;
  for (const Pose& H : path) {
    ASSERT_EQ(god_object.update({H, Motion{}}, report), Status::kOk);
    contacts += report.contacts > 0 ? 1 : 0;
    ended += report.out_of_work ? 1 : 0;
  }
  Ticking clock;
  const TimedPath timed = time_path(scene_, true, path, memory_.span(), kUnits, clock);
  EXPECT_DOUBLE_EQ(timed.longest, 1e-6);
  EXPECT_EQ(timed.cycles, path.size());
  EXPECT_EQ(timed.contacts, contacts);
  EXPECT_EQ(timed.ended, ended);
  EXPECT_GT(contacts, 50u);
  EXPECT_GT(ended, 0u);
}

/// A clock on which one cycle of a path takes long.
class Slow final : public hal::Clock {
 public:
  explicit Slow(std::int64_t reading) : reading_(reading) {}
  std::int64_t now_ns() noexcept override {
    ++readings_;
    return now_ += (readings_ - 1) % (2 * 401) + 1 == reading_ ? 50'000 : 1000;
  }
  void sleep_until(std::int64_t) noexcept override {}

 private:
  std::int64_t reading_;
  std::int64_t readings_ = 0;
  std::int64_t now_ = 0;
};

TEST_F(WorkCalibration, FindsABudgetForATime) {
  const std::vector<Pose> path = calibration_path(scene_, start_);
  ASSERT_EQ(path.size(), 401u);
  Ticking quick;
  const WorkBudget nominal = find_budget(scene_, true, path, memory_.span(), 100e-6, quick);
  EXPECT_EQ(nominal.units, 400000u) << "each cycle is short enough";
  for (const int reading : {2, 4, 2 * 401}) {  // the first cycle counts as any other
    Slow slow(reading);
    const WorkBudget shorter = find_budget(scene_, true, path, memory_.span(), 10e-6, slow);
    EXPECT_DOUBLE_EQ(shorter.with.longest, 50e-6) << "no budget helps: the caller sees it";
    EXPECT_LT(shorter.units, 40u) << "eight trials, each a fifth of the last one or less";
  }
}

/// A clock on which the cycles of the first trial take `first` nanoseconds, and those of later ones a nanosecond.
class SlowAtFirst final : public hal::Clock {
 public:
  explicit SlowAtFirst(std::int64_t first) : first_(first) {}
  std::int64_t now_ns() noexcept override {
    constexpr std::int64_t kReadings = 2 * 401 * 5;  // of a trial, at most
    return now_ += readings_++ < kReadings ? first_ : 1;
  }
  void sleep_until(std::int64_t) noexcept override {}

 private:
  std::int64_t first_;
  std::int64_t readings_ = 0;
  std::int64_t now_ = 0;
};

/// If the time is in proportion to the units, the second trial takes less than the time, but not by much.
TEST_F(WorkCalibration, TriesABudgetNextThatTakesSomewhatLess) {
  const std::vector<Pose> path = calibration_path(scene_, start_);
  for (const int times : {2, 3, 10}) {
    SlowAtFirst clock(times * 100'000);
    const WorkBudget found = find_budget(scene_, true, path, memory_.span(), 100e-6, clock);
    EXPECT_LT(found.units, 400000u / static_cast<unsigned>(times)) << times;
    EXPECT_GT(found.units, 400000u / static_cast<unsigned>(times) / 2) << times;
  }
}

TEST_F(WorkCalibration, TellsABudgetThatHoldsTheGodObject) {
  const std::vector<Pose> path = calibration_path(scene_, start_);
  EXPECT_LT(distance_left(scene_, true, path, memory_.span(), GodObject::kNoBudget), 1e-5);
  EXPECT_GT(distance_left(scene_, true, path, memory_.span(), 1), 0.02) << "it stays at the start";
  EXPECT_LT(distance_left(scene_, true, path, memory_.span(), 400000), 1e-4);
}

/// With memory that is too small the cycle's own start tells why.
TEST_F(WorkCalibration, FindsNothingWhereTheGodObjectDoesNotStart) {
  const std::vector<Pose> path = calibration_path(scene_, start_);
  Ticking clock;
  EXPECT_EQ(time_path(scene_, true, path, {}, 1000, clock).cycles, 0u);
  EXPECT_EQ(find_budget(scene_, true, path, {}, 1e-4, clock).with.cycles, 0u);
  EXPECT_EQ(distance_left(scene_, true, path, {}, 1), 0.0);
}

TEST_F(WorkCalibration, SaysWhatTheBudgetIsAndWhatItDoes) {
  const WorkBudget budget{.units = 400000, .with = {.longest = 80e-6, .cycles = 900, .contacts = 500, .ended = 30}};
  EXPECT_EQ(describe(budget, 100e-6),
            "budget: 100 us a cycle for the god object, 400000 units. With them the longest cycle of a test motion "
            "takes 80 us; they end 30 of 900 cycles, 500 of which have contact");
  EXPECT_EQ(too_long_for(budget, 80e-6), "");
  EXPECT_EQ(too_little_for(1e-4, 80e-6), "");
}

TEST_F(WorkCalibration, SaysThatABudgetDoesNotHoldOrHoldsTheGodObject) {
  const WorkBudget budget{.units = 400000, .with = {.longest = 120e-6}};
  const std::string cure =
      "; raise loop.compute, and loop.cycle_budget if it is set, or compile the scene with fewer points or with "
      "point_budget";
  EXPECT_EQ(too_long_for(budget, 100e-6),
            "no budget of work keeps cycles within 100 us: the longest of a test motion takes 120 us" + cure);
  EXPECT_EQ(too_long_for(budget, 120e-6), "");
  EXPECT_EQ(too_little_for(2.5e-3, 100e-6),
            "with 100 us a cycle the god object stops on the way: after a test motion it is still 2.5 mm from the "
            "position that it reaches without a budget" +
                cure);
  EXPECT_EQ(too_little_for(0.0, 100e-6), "");
}

}  // namespace
}  // namespace godobject::firmware::work_calibration_test
