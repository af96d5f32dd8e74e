// Each row of the chapter on contact quality is held and missed with a planted fault.
#include <algorithm>

#include "tests/report/planted/planted.h"
#include "tests/support/folder_test.h"
#include "toolchain/report/contact_quality/chapter.h"
#include "toolchain/report/contact_quality/faulty_world.h"
#include "toolchain/report/contact_quality/measure.h"
#include "toolchain/report/contact_quality/meshes.h"

namespace godobject::report {
namespace {

struct PlantedFault {
  Quantity quantity;
  CycleFault fault;
};

/// Rows that are measured in one scene with some of its motions.
struct Planted {
  std::string name;
  SceneSpec scene;
  std::vector<PlantedFault> faults;
};

SceneSpec scene(const std::string& name, WorldKind kind, const Motions& motions) {
  const std::vector<SceneSpec> all = scenes();
  SceneSpec found = *std::find_if(all.begin(), all.end(), [&](const SceneSpec& each) {
    return each.name == name && (each.kind == kind || name == "box-plate");
  });
  found.kind = kind;
  found.motions = motions;
  return found;
}

std::vector<Planted> make_all() {
  using enum Quantity;
  constexpr std::int64_t kSlower_ns = 1'000'000;
  SceneSpec edge = scene("box-edge", WorldKind::kCompiled, {.press = true});
  edge.still.mesh = box_mesh({-0.05, -0.04, -0.04}, {0.0, 0.04, 0.0});  // smaller, and so compiled sooner
  SceneSpec smooth = edge;
  smooth.sharp = false;
  const Vector3 deeper = 5e-4 * edge.H_WO.rotation._transformVector(edge.placement.into);
  return {
      {"press",
       scene("sphere-plane", WorldKind::kAnalytic, {.press = true}),
       {{kPenetration, {.shift_W = {0.0, 0.0, -1e-4}}},
        {kOptimum, {.shift_W = {0.0, 0.0, 2e-4}}},
        {kChatterPlain, {.push_W = {0.0, 0.0, 0.5}, .every = 2}},
        {kSolveMedian, {.slower_ns = kSlower_ns}},
        {kSolveP99, {.slower_ns = kSlower_ns}}}},
      {"slide",
       scene("sphere-plane", WorldKind::kAnalytic, {.slide = true, .retreat = true}),
       {{kDrag, {.push_W = {0.1, 0.0, 0.0}}}, {kPull, {.push_W = {0.0, 0.0, -1.0}}}}},
      {"friction",
       scene("sphere-plane", WorldKind::kAnalytic, {.friction_slide = true, .tremor = true}),
       {{kRatio, {.push_W = {0.3, 0.2, 0.0}}},
        {kDirection, {.turn = 0.05}},
        {kDrift, {.drift_W = {1e-8, 0.0, 0.0}}},
        {kFrictionMedian, {.slower_ns = kSlower_ns}},
        {kFrictionP99, {.slower_ns = kSlower_ns}}}},
      {"groove",
       scene("sphere-groove-90", WorldKind::kAnalytic, {.friction_slide = true}),
       {{kRatioGroove, {.push_W = {0.0, 0.5, 0.0}}}}},
      {"moved",
       scene("sphere-groove-90", WorldKind::kMoved, {.press = true}),
       {{kMovedPose, {.shift_W = {1e-5, 0.0, 0.0}}},
        {kMovedForce, {.push_W = {0.1, 0.0, 0.0}}},
        {kChatterElsewhere, {.push_W = {0.0, 0.0, 2.0}, .every = 2}}}},
      {"slot",
       scene("box-slot", WorldKind::kAnalytic, {.press = true}),
       {{kOptimumTight, {.shift_W = {0.0, 2e-3, 0.0}}}}},
      {"slip", scene("sphere-off-edge", WorldKind::kAnalytic, {.slip = true}), {{kSlipTime, {.late = 100}}}},
      {"dash",
       scene("box-plate", WorldKind::kAnalytic, {.dashes = true}),
       {{kCrossings, {.shift_W = {0.0, 0.0, -0.01}}}}},
      {"sharp", edge, {{kTruePenetrationSharp, {.shift_W = deeper}}}},
      {"smooth", smooth, {{kTruePenetrationSmooth, {.shift_W = deeper}}}},
  };
}

const std::vector<Planted>& all() {
  static const std::vector<Planted> planted = make_all();
  return planted;
}

TEST(ContactRows, HaveAFaultEach) {
  std::vector<Bound> covered;
  for (const Planted& planted : all()) {
    for (const PlantedFault& each : planted.faults) covered.push_back(bound_of(spec(each.quantity)));
  }
  EXPECT_EQ(planting::without_fault(contact_bounds(), covered), "");
}

class ContactRow : public test::FolderTest, public testing::WithParamInterface<std::size_t> {};

TEST_P(ContactRow, IsHeldAndWithItsFaultMissed) {
  const auto& [name, scene, faults] = all()[GetParam()];
  const Body body = make_body(report::name(scene.body), body_mesh(scene.body, {}), body_points(scene.body), folder_);
  const WorldSettings settings{.voxel_size = scene.voxel_size, .safety_distance = 1.5 * scene.voxel_size};
  const auto world = scene.kind == WorldKind::kCompiled
                         ? make_compiled_world(scene.name, placed(scene), body, settings, folder_)
                         : make_analytic_world(scene.solid.moved(scene.H_WO), body, settings);
  const auto still = make_analytic_world(scene.solid, body, settings);
  const World* const still_world = scene.kind == WorldKind::kMoved ? still.get() : nullptr;
  const Effort effort{.dashes = 1, .tremor_s = 2.0};
  const auto measured = [&](const CycleFault& fault) {
    return measure(scene, FaultyWorld(*world, fault), still_world, Solver::kContact, effort);
  };
  const std::vector<Measurement> sound = measured({});
  for (const auto& [quantity, fault] : faults) {
    const auto held = judge(sound, quantity, Solver::kContact);
    const auto missed = judge(measured(fault), quantity, Solver::kContact);
    ASSERT_TRUE(held && missed) << spec(quantity).title;
    const bool timed = bound_of(spec(quantity)).timed;  // other programs may run beside this one
    EXPECT_TRUE(held->held || timed) << spec(quantity).title << " " << held->value;
    EXPECT_FALSE(missed->held) << spec(quantity).title << " " << missed->value;
  }
}

INSTANTIATE_TEST_SUITE_P(All, ContactRow, testing::Range<std::size_t>(0, all().size()),
                         [](const auto& row) { return all()[row.param].name; });

}  // namespace
}  // namespace godobject::report
