// Each row of the chapter on precision is held and missed with a planted fault; a tilted block
// on a block replaces the scenes.
#include <fstream>

#include "tests/report/planted/planted.h"
#include "tests/support/folder_test.h"
#include "toolchain/report/contact_quality/meshes.h"
#include "toolchain/report/work_precision/bounds.h"
#include "toolchain/report/work_precision/chapter.h"

namespace godobject::report {
namespace {

const char* const kScenes[] = {"bunny-teapot", "bunny-plate", "peg-hole"};

/// Returns the bounds of all errors in a scene.
std::vector<Bound> errors(const std::string& scene) {
  std::vector<Bound> all;
  for (const auto& [setting, friction] : {std::pair{"as written", false},
                                          {"as written", true},
                                          {"plain", false},
                                          {"plain", true},
                                          {kRecommended, true}}) {
    const ErrorBounds bounds = error_bounds(scene, setting, friction);
    all.insert(all.end(), {bounds.force, bounds.torque, bounds.penetration});
  }
  return all;
}

class PrecisionRow : public test::FolderTest, public testing::WithParamInterface<const char*> {
 protected:
  PrecisionRow() {
    std::filesystem::create_directories(folder_ / "paths");
    write_ply(box_mesh(Vector3(-0.02, -0.02, -0.02), Vector3(0.02, 0.02, 0.0)), folder_ / "block.ply");
    write_ply(box_mesh(Vector3(-0.012, -0.008, -0.006), Vector3(0.012, 0.008, 0.006)), folder_ / "body.ply");
    for (const char* const scene : kScenes) {
      std::ofstream(folder_ / (std::string(scene) + ".toml"))
          << "[still]\nmesh = \"block.ply\"\nvoxel_size = 0.001\n[moving]\nmesh = \"body.ply\"\npoints = 1500\n"
             "levels = 4\n[friction]\nstatic = 0.2\n";
    }
    std::ofstream(folder_ / "paths" / "through-plate.toml") << motion_toml();
    std::ofstream(folder_ / "paths" / "peg-hole.toml") << motion_toml();
    std::ofstream csv(folder_ / "paths" / "bunny-teapot.csv");
    csv << "t,px,py,pz,qw,qx,qy,qz\n";
    for (int k = 0; k < 60; ++k)
      csv << 1e-3 * k << ',' << 5e-5 * k << ",0.004," << 0.0126 - 5e-5 * k << ",0.968912,0.123701,0.206169,0.0494805\n";
  }

  /// Returns the motion of the CSV file.
  static std::string motion_toml() {
    return "[[keyframe]]\nt = 0.0\nposition = [0.0, 0.004, 0.0126]\naxis_angle = [0.3, 0.5, 0.12, 28.6]\n"
           "[[keyframe]]\nt = 0.06\nposition = [0.003, 0.004, 0.0096]\naxis_angle = [0.3, 0.5, 0.12, 28.6]\n";
  }

  std::vector<Finding> found(const PrecisionFault& fault) {
    const Chapter chapter =
        work_precision_chapter({.scenes = folder_, .kept = folder_ / "kept", .quick = false, .fault = fault});
    const std::string scene = std::string("precision.") + GetParam();
    return planting::findings(chapter, {scene + "-as-written", scene + "-as-written-times", scene + "-voxel-1-plain"},
                              folder_);
  }
};

TEST(PrecisionRows, HaveAFaultEach) {
  std::vector<Bound> covered;
  for (const char* const scene : kScenes) {
    for (const Bound& bound : errors(scene)) covered.push_back(bound);
    covered.insert(covered.end(), {cost_bound(scene), paper_bound(scene)});
  }
  EXPECT_EQ(planting::without_fault(precision_bounds(), covered), "");
}

TEST_P(PrecisionRow, IsHeldAndWithItsFaultMissed) {
  constexpr double kFast = 1e-3;  // every setting is within the budget on a busy machine, too
  const std::vector<Finding> sound = found({.time_gain = kFast});
  const std::vector<Finding> smaller = found({.body_scale = 0.7, .time_gain = kFast});
  for (const Bound& bound : errors(GetParam())) {
    planting::expect(true, bound, sound);
    planting::expect(false, bound, smaller);
  }
  planting::expect(true, paper_bound(GetParam()), sound);
  planting::expect(false, paper_bound(GetParam()), smaller);
  planting::expect(true, cost_bound(GetParam()), sound);
  planting::expect(false, cost_bound(GetParam()), found({.time_gain = kFast, .slower = 1e6}));
}

INSTANTIATE_TEST_SUITE_P(All, PrecisionRow, testing::ValuesIn(kScenes));

}  // namespace
}  // namespace godobject::report
