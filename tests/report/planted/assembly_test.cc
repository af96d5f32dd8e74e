// Each row of the chapter on assemblies is held and missed with a planted fault.
#include <algorithm>

#include "tests/report/planted/planted.h"
#include "tests/support/folder_test.h"
#include "toolchain/report/assembly/bounds.h"
#include "toolchain/report/assembly/chapter.h"

namespace godobject::report {
namespace {

namespace bound = assembly_bound;

/// Faults that do not disturb each other's rows, planted together in one run of a pair, which takes seconds.
struct PlantedFault {
  std::vector<Bound> bounds;
  AssemblyFault fault;
};

struct Planted {
  std::string study_case;  ///< without "assembly."
  std::vector<PlantedFault> faults;
};

/// Adds the rows of every pair to those of this pair. The shift is along y: the loads on a peg, in the plane y = 0, do
/// not follow it.
std::vector<PlantedFault> with_pair(const std::string& pair, PlantedFault first, PlantedFault second) {
  first.bounds.insert(first.bounds.end(), {bound::overlap(pair), bound::overflow(pair)});
  first.fault.cycle.shift_W = {0.0, 2e-4, 0.0};
  first.fault.outcome = Outcome::kOverflow;
  second.bounds.push_back(bound::started_inside(pair));
  second.fault.outcome = Outcome::kStartInside;
  return {first, second};
}

std::vector<PlantedFault> cavity() {
  return with_pair(bound::kCavity, {}, {{bound::kPress, bound::kTwist}, {.cycle = {.gain = 1.02}}});
}

std::vector<PlantedFault> round_peg() {
  const char* const pair = bound::kRoundPeg;
  return with_pair(pair, {}, {{bound::wedging(pair)}, {.friction_gain = 1.1}});
}

std::vector<PlantedFault> rectangular_peg() {
  const char* const pair = bound::kRectangularPeg;
  return with_pair(pair, {{bound::wedging(pair), bound::jamming(pair)}, {.friction_gain = 1.05}},
                   {{bound::wrong_side(pair)}, {.friction_gain = 1.15}});
}

std::vector<PlantedFault> nut() {
  const char* const pair = bound::kNut;
  return with_pair(pair, {{bound::climb(pair), bound::self_locking(pair)}, {.friction_gain = 1.05, .turn_gain = 1.02}},
                   {{bound::torque(pair), bound::comes_free(pair)}, {.cycle = {.push_W = {0.0, 0.0, 1.0}}}});
}

std::vector<PlantedFault> turnstile() {
  return with_pair(bound::kGear, {{bound::backlash(bound::kGear)}, {.turn_gain = 1.5}}, {});
}

const std::vector<Planted>& all() {
  static const std::vector<Planted> planted = {{"small-cavity", cavity()},
                                               {"short-round-peg", round_peg()},
                                               {"short-rectangular-peg", rectangular_peg()},
                                               {"coarse-nut", nut()},
                                               {"turnstile", turnstile()}};
  return planted;
}

Chapter chapter(const std::filesystem::path& kept, const AssemblyFault& fault) {
  return assembly_chapter({.scenes = {}, .kept = kept, .quick = true, .fault = fault});
}

TEST(AssemblyRows, HaveAFaultEach) {
  std::vector<Bound> covered;
  for (const Planted& planted : all()) {
    for (const PlantedFault& each : planted.faults) {
      covered.insert(covered.end(), each.bounds.begin(), each.bounds.end());
    }
  }
  EXPECT_EQ(planting::without_fault(chapter({}, {}).bounds, covered), "");
}

class AssemblyRow : public test::FolderTest, public testing::WithParamInterface<std::size_t> {};

TEST_P(AssemblyRow, IsHeldAndWithItsFaultMissed) {
  const auto& [name, faults] = all()[GetParam()];
  const std::vector<std::string> cases = {"assembly." + name};
  const std::filesystem::path kept = GODOBJECT_KEPT_FOLDER;  // all runs share the image, with the quick report
  const std::vector<Finding> sound = planting::findings(chapter(kept, {}), cases, folder_);
  for (const auto& [bounds, fault] : faults) {
    const std::vector<Finding> found = planting::findings(chapter(kept, fault), cases, folder_);
    for (const Bound& each : bounds) {
      planting::expect(true, each, sound);
      planting::expect(false, each, found);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, AssemblyRow, testing::Range<std::size_t>(0, all().size()), [](const auto& row) {
  std::string name = all()[row.param].study_case;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace
}  // namespace godobject::report
