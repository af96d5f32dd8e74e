// Each row of the chapter on precision is held and missed with a planted fault; a ball on a block replaces the scenes.
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
    write_ply(ball_mesh(0.012, 24), folder_ / "ball.ply");
    for (const char* const scene : kScenes) {
      std::ofstream(folder_ / (std::string(scene) + ".toml"))
          << "[still]\nmesh = \"block.ply\"\nvoxel_size = 0.001\n[moving]\nmesh = \"ball.ply\"\npoints = 1500\n"
             "levels = 4\n[friction]\nstatic = 0.2\n";
    }
    std::ofstream(folder_ / "paths" / "through-plate.toml") << motion_toml();
    std::ofstream(folder_ / "paths" / "peg-hole.toml") << motion_toml();
    std::ofstream csv(folder_ / "paths" / "bunny-teapot.csv");
    csv << "t,px,py,pz,qw,qx,qy,qz\n";
    for (int k = 0; k < 60; ++k) csv << 1e-3 * k << ',' << 5e-5 * k << ",0.004," << 0.013 - 5e-5 * k << ",1,0,0,0\n";
  }

  /// Returns the motion of the CSV file.
  static std::string motion_toml() {
    return "[[keyframe]]\nt = 0.0\nposition = [0.0, 0.004, 0.013]\n"
           "[[keyframe]]\nt = 0.06\nposition = [0.003, 0.004, 0.010]\n";
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
  const std::vector<Finding> sound = found({});
  const std::vector<Finding> smaller = found({.body_scale = 0.7});
  for (const Bound& bound : errors(GetParam())) {
    planting::expect(true, bound, sound);
    planting::expect(false, bound, smaller);
  }
  planting::expect(true, paper_bound(GetParam()), sound);
  planting::expect(false, paper_bound(GetParam()), smaller);
  planting::expect(false, cost_bound(GetParam()), found({.slower = 1e3}));
}

INSTANTIATE_TEST_SUITE_P(All, PrecisionRow, testing::ValuesIn(kScenes));

}  // namespace
}  // namespace godobject::report
