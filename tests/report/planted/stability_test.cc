// Each row of the chapter on stability is held in the sound loop and missed with a planted fault.
#include "tests/report/planted/planted.h"
#include "tests/support/folder_test.h"
#include "toolchain/report/stability/bounds.h"
#include "toolchain/report/stability/chapter.h"

namespace godobject::report {
namespace {

namespace bound = stability_bound;

struct Planted {
  std::string study_case;  ///< without "stability."
  Bound bound;
  LoopFault fault;
};

const std::vector<Planted>& all() {
  static const std::vector<Planted> planted = {
      {"passivity", bound::kNeededDamping, {.gain = 1.01}},
      {"passivity", bound::kNeededDelayed, {.gain = 1.01}},
      {"passivity", bound::kNeededOfSpring, {.late = 0.01}},
      {"boundary-1ms", bound::kRule, {.late = 0.05}},
      {"boundary-1ms", bound::kTable, {.gain = 1.001}},
      {"boundary-1ms", bound::kAxis, {.gain = 1.001}},
      {"boundary-1ms", bound::kWrongSide, {.late = 0.1}},
      {"boundary-1ms", bound::kNoneStable, {.damping_gain = 0.7}},
      {"random-loops", bound::kRandomGrow, {.gain = 1.1}},
      {"random-loops", bound::kRandomDecay, {.gain = 0.9}},
      {"damping-limit", bound::kDampingStated, {.damping_gain = 1.05}},
      {"damping-limit", bound::kDampingExact, {.damping_gain = 1.02}},
      {"quantisation", bound::kQuantised, {.gain = 1.01}},
      {"quantisation", bound::kRestless, {.gain = 3.0}},
      {"energy", bound::kEnergyOfSpring, {.gain = 1.01}},
      {"energy", bound::kEnergyDamped, {.damping_gain = -1.0}},
      {"energy", bound::kDelay, {.late = 0.01}},
      {"frame-loss", bound::kLossStated, {.loss_gain = 0.0}},
      {"frame-loss", bound::kLossExact, {.loss_gain = 0.0}},
      {"frame-loss", bound::kLossStable, {.loss_gain = 3.0}},
      {"observer", bound::kLaw, {.late = 1.0}},
      {"pipeline-observer", bound::kPlate, {.late = 1.0}},
      {"passivity-controller", bound::kControlled, {.gain = 1.2}},
      {"passivity-force", bound::kControlledForce, {.damping_gain = -1.0}},
      {"arm-lwr", bound::kArm, {.late = 0.2}},
      {"arm-lwr", bound::kArmWrongSide, {.late = 0.2}},
      {"arm-lwr", bound::kGainsInUse, {.gain = 10.0}},
      {"passive-arm-lwr", bound::kLeastPassive, {.gain = 1.1}},
      {"bus-lwr", bound::kBus, {.gain = 1.05}},
      {"bus-lwr", bound::kBusDelay, {.late = 2.0}},
      {"rate-desktop6", bound::kRate, {.late = 0.2}},
      {"rate-desktop6", bound::kRatePlan, {.late = 0.2}},
      {"rate-desktop6", bound::kStiffer, {.late = 7.0}},
      {"gyration", bound::kTilt, {.gain = 1.05}},
      {"z-width-paper-1ms", bound::z_width(Solver::kPaper), {.gain = 1.3}},
      {"z-width-corrected-1ms", bound::z_width(Solver::kCorrected), {.gain = 1.3}},
      {"z-width-contact-1ms", bound::z_width(Solver::kContact), {.gain = 1.05}},
      {"z-width-contact-1ms", bound::kPlateExact, {.late = 0.1}},
  };
  return planted;
}

Chapter chapter(const LoopFault& fault) {
  return stability_chapter({.devices = GODOBJECT_DEVICES_DIR, .quick = true, .fault = fault, .one_place = true});
}

TEST(StabilityRows, HaveAFaultEach) {
  std::vector<Bound> covered;
  for (const Planted& planted : all()) covered.push_back(planted.bound);
  EXPECT_EQ(planting::without_fault(chapter({}).bounds, covered), "");
}

class StabilityRow : public test::FolderTest, public testing::WithParamInterface<std::size_t> {};

TEST_P(StabilityRow, IsHeldAndWithItsFaultMissed) {
  const Planted& planted = all()[GetParam()];
  const std::vector<std::string> cases = {"stability." + planted.study_case};
  planting::expect(true, planted.bound, planting::findings(chapter({}), cases, folder_));
  planting::expect(false, planted.bound, planting::findings(chapter(planted.fault), cases, folder_));
}

INSTANTIATE_TEST_SUITE_P(All, StabilityRow, testing::Range<std::size_t>(0, all().size()));

}  // namespace
}  // namespace godobject::report
