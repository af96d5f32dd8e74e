// Each row of the chapter on extremes is held and missed with a planted fault.
#include <cmath>

#include "tests/report/planted/planted.h"
#include "tests/support/folder_test.h"
#include "toolchain/report/extremes/bounds.h"
#include "toolchain/report/extremes/chapter.h"
#include "toolchain/report/extremes/setup.h"
#include "toolchain/report/extremes/torque_places.h"

namespace godobject::report {
namespace {

namespace bound = extremes_bound;

struct PlantedFault {
  std::vector<Bound> bounds;
  ExtremesFault fault;
};

struct Planted {
  std::string study_case;  ///< without "extremes."
  std::vector<PlantedFault> faults;
};

/// Returns the faults of a generated row, one for each property of the watch.
std::vector<PlantedFault> violations(const std::string& row) {
  std::vector<PlantedFault> all;
  for (std::size_t i = 0; i < watch::kPropertyCount; ++i) {
    const auto property = static_cast<watch::Property>(i);
    all.push_back({{bound::of_property(row, property)}, {.violated = property}});
  }
  return all;
}

/// Returns the faults at a place: a solver that jumps without a torque limiter, and an arm that is too fast.
std::vector<PlantedFault> torques(const std::string& place) {
  return {{{bound::sent_torque(place), bound::computed_torque(place)},
           {.cycle = {.push_W = {0.0, 0.0, 300.0}, .every = 50}, .limits = {.rate = 2.0}}},
          {{bound::idle_runs(place)}, {.jump = 0.2}}};
}

std::vector<Planted> make_all() {
  std::vector<Planted> all = {
      {"bad-meshes",
       {{{bound::kNotFinite}, {.distance_gain = std::nan("")}},
        {{bound::kWrongSign, bound::kNotReported}, {.distance_gain = -1.0, .hides_flaws = true}},
        {{bound::kRefused}, {.refuses_meshes = true}}}},
      {"gap", {{{bound::kGap}, {.hides_flaws = true}}}},
      {"scale", {{{bound::kScale}, {.cycle = {.shift_W = {0.0, 0.0, 1e-6}}}}}},
      {"long-run",
       {{{bound::kOffUnit}, {.cycle = {.rotation_length = 1.0 + 1e-12}}},
        {{bound::kDrift}, {.cycle = {.drift_W = {1e-12, 0.0, 0.0}}}}}},
      {"closed-path",
       {{{bound::kNetWork}, {.cycle = {.late = 10}}}, {{bound::kReplay}, {.cycle = {.shift_W = {1e-9, 0.0, 0.0}}}}}},
      {"bad-input", {{{bound::kAccepted, bound::kForce, bound::kChanged}, {.accepts_poses = true}}}},
      {"fuzzer-000", violations("fuzzer")}};
  for (std::size_t i = 0; i < kRowCount; ++i) all.push_back({"row-" + std::to_string(i + 1), violations(kRows[i])});
  for (std::size_t i = 0; i < kPlaceCount; ++i) {
    all.push_back({"torque-" + std::to_string(i + 1), torques(kPlaceNames[i])});
  }
  return all;
}

const std::vector<Planted>& all() {
  static const std::vector<Planted> planted = make_all();
  return planted;
}

Chapter chapter(const ExtremesFault& fault) {
  return extremes_chapter({.devices = GODOBJECT_DEVICES_DIR, .quick = true, .fault = fault, .one_place = true});
}

TEST(ExtremesRows, HaveAFaultEach) {
  std::vector<Bound> covered;
  for (const Planted& planted : all()) {
    for (const PlantedFault& each : planted.faults) {
      covered.insert(covered.end(), each.bounds.begin(), each.bounds.end());
    }
  }
  EXPECT_EQ(planting::without_fault(chapter({}).bounds, covered), "");
}

class ExtremesRow : public test::FolderTest, public testing::WithParamInterface<std::size_t> {};

TEST_P(ExtremesRow, IsHeldAndWithItsFaultMissed) {
  const Planted& planted = all()[GetParam()];
  const std::vector<std::string> cases = {"extremes." + planted.study_case};
  const std::vector<Finding> sound = planting::findings(chapter({}), cases, folder_);
  for (const PlantedFault& each : planted.faults) {
    const std::vector<Finding> faulty = planting::findings(chapter(each.fault), cases, folder_);
    for (const Bound& bound : each.bounds) {
      planting::expect(true, bound, sound);
      planting::expect(false, bound, faulty);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, ExtremesRow, testing::Range<std::size_t>(0, all().size()));

}  // namespace
}  // namespace godobject::report
