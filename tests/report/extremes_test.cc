// The fuzzer's checks find planted violations, and a case file repeats a run.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "toolchain/report/extremes/run.h"
#include "toolchain/report/extremes/setup.h"

namespace godobject::report {
namespace {

/// A solver that plays a trick in one cycle and follows the device in the others.
class Cheat final : public Rig {
 public:
  enum class Trick { kNone, kRefuses, kNan, kLongRotation, kFallsThrough, kPushesTooHard, kRunsAway, kStepsOut };
  explicit Cheat(Trick trick, std::vector<Touch> touches = {}) : trick_(trick), touches_(std::move(touches)) {}

  Status update(const Pose& H_WD, const Motion&, CycleReport& report) override {
    report = CycleReport{};
    report.H_WS = H_WD;
    gap_ = 1.0;
    if (++cycle_ != 100) return Status::kOk;
    switch (trick_) {
      case Trick::kNone: break;
      case Trick::kRefuses: return Status::kNotFinite;
      case Trick::kNan: report.force.total_W.torque.y() = std::nan(""); break;
      case Trick::kLongRotation: report.H_WS.rotation.coeffs() *= 1.0 + 1e-8; break;
      case Trick::kFallsThrough: gap_ = -1e-6; break;
      case Trick::kPushesTooHard: report.force.total_W.force.x() = 1e3; break;
      case Trick::kRunsAway: report.H_WS.translation.x() += 1.0; break;
      case Trick::kStepsOut: report.H_WS.translation.x() += 0.25 * parameters_.voxel_size; break;
    }
    return Status::kOk;
  }
  double smallest_gap(const Pose&) const override { return gap_; }
  std::vector<Touch> touches(const Pose&) const override { return touches_; }
  const Parameters& parameters() const override { return parameters_; }

 private:
  Trick trick_;
  std::vector<Touch> touches_;
  int cycle_ = 0;
  double gap_ = 1.0;
  Parameters parameters_;
};

Violations with(Cheat::Trick trick, std::vector<Touch> touches = {}) {
  Cheat cheat(trick, std::move(touches));
  return run_setup({.row = "test", .motion = "rest", .cycles = 200}, cheat);
}

TEST(Watch, SeesEachViolationOnce) {
  EXPECT_EQ(with(Cheat::Trick::kNone).all(), 0);
  EXPECT_EQ(with(Cheat::Trick::kNone).cycles, 200);
  EXPECT_EQ(with(Cheat::Trick::kRefuses).bad_status, 1);
  EXPECT_EQ(with(Cheat::Trick::kNan).not_finite, 1);
  EXPECT_EQ(with(Cheat::Trick::kLongRotation).not_unit, 1);
  EXPECT_EQ(with(Cheat::Trick::kFallsThrough).crossings, 1);
  EXPECT_EQ(with(Cheat::Trick::kPushesTooHard).unbounded, 1);
  EXPECT_EQ(with(Cheat::Trick::kRunsAway).pulled_away, 1);
  for (const auto trick : {Cheat::Trick::kRefuses, Cheat::Trick::kFallsThrough, Cheat::Trick::kRunsAway}) {
    EXPECT_EQ(with(trick).all(), 1);
    EXPECT_EQ(with(trick).first.substr(0, 9), "cycle 99:");
  }
}

TEST(Watch, AllowsTheWayOutOfALostMarginAndNoMore) {
  const std::vector<Touch> inside = {{Vector3::Zero(), Vector3::UnitX(), -1.0}};
  const std::vector<Touch> otherwise = {{Vector3::Zero(), -Vector3::UnitX(), -1.0}};
  EXPECT_EQ(with(Cheat::Trick::kStepsOut).pulled_away, 1) << "nothing is lost";
  EXPECT_EQ(with(Cheat::Trick::kStepsOut, inside).all(), 0);
  EXPECT_EQ(with(Cheat::Trick::kRunsAway, inside).pulled_away, 1);
  EXPECT_EQ(with(Cheat::Trick::kStepsOut, otherwise).all(), 0) << "as far from the device as the way out";
  EXPECT_EQ(with(Cheat::Trick::kRunsAway, otherwise).pulled_away, 1);
}

TEST(CaseFile, BringsARunBack) {
  std::mt19937 random(5);
  for (int i = 0; i < 50; ++i) {
    report::Setup setup = any_setup(random);
    if (setup.world == "compiled") setup.world = "heap";
    setup.cycles = 40;
    const std::string text = case_file(setup, "nothing");
    const report::Setup read = read_case(text);
    EXPECT_EQ(case_file(read, "nothing"), text);
    const auto rig = make_rig(setup, {});
    const auto again = make_rig(read, {});
    CycleReport report;
    CycleReport repeated;
    for (const Pose& H_WD : device_path(setup)) {
      ASSERT_EQ(rig->update(H_WD, {}, report), again->update(H_WD, {}, repeated));
      ASSERT_EQ(report.H_WS.translation, repeated.H_WS.translation);
    }
  }
}

TEST(CaseFile, OfAnotherGeneratorIsRefused) {
  const std::string text = case_file({}, "");
  EXPECT_NO_THROW(static_cast<void>(read_case(text)));
  EXPECT_THROW(static_cast<void>(read_case("{}")), std::exception);
  EXPECT_THROW(static_cast<void>(read_case("no JSON")), std::exception);
  std::string other = text;
  other.replace(other.find("\"generator\": 1"), 14, "\"generator\": 0");
  EXPECT_THROW(static_cast<void>(read_case(other)), std::exception);
}

/// Each family of setups has the property of its row.
TEST(SetupOf, EachRowIsOfThatRow) {
  std::mt19937 random(6);
  double widest = 0.0;
  double narrowest = 1e9;
  for (int i = 0; i < 300; ++i) {
    for (std::size_t r = 0; r < kRowCount; ++r) {
      const report::Setup setup = setup_of(kRows[r], random);
      EXPECT_EQ(setup.row, kRows[r]);
      if (r == 0) widest = std::max(widest, setup.scale);
      if (r == 0) narrowest = std::min(narrowest, setup.scale);
      if (r == 5) {
        EXPECT_GE(setup.points, 1000);
      }
      for (const Pose& H_WD : device_path(setup)) ASSERT_TRUE(H_WD.is_finite());
    }
  }
  EXPECT_GT(widest, 500.0);
  EXPECT_LT(narrowest, 2e-3);
}

}  // namespace
}  // namespace godobject::report
