// The chapter on error against run time, with a ball on a block in place of a real scene.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "tests/support/folder_test.h"
#include "toolchain/command_line/failure.h"
#include "toolchain/report/contact_quality/meshes.h"
#include "toolchain/report/study/study.h"
#include "toolchain/report/work_precision/chapter.h"
#include "toolchain/report/work_precision/settings_tried.h"

namespace godobject::report {
namespace {

class WorkPrecisionTest : public test::FolderTest {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(folder_ / "paths");
    write_ply(box_mesh(Vector3(-0.04, -0.04, -0.03), Vector3(0.04, 0.04, 0.0)), folder_ / "block.ply");
    write_ply(ball_mesh(0.012, 8), folder_ / "ball.ply");
    std::ofstream(folder_ / "bunny-teapot.toml") << "[still]\nmesh = \"block.ply\"\nvoxel_size = 0.004\n[moving]\n"
                                                    "mesh = \"ball.ply\"\npoints = 400\nlevels = 4\n[friction]\n"
                                                    "static = 0.2\n";
    std::ofstream path(folder_ / "paths" / "bunny-teapot.csv");
    path << "t,px,py,pz,qw,qx,qy,qz\n";
    for (int k = 0; k < 60; ++k) {
      path << 1e-3 * k << ',' << 5e-5 * k << ",0," << 0.013 - 5e-5 * k << ",1,0,0,0\n";
    }
  }

  std::string text_of(const std::filesystem::path& file) const {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  static std::size_t files_in(const std::filesystem::path& folder, const std::string& ending) {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) count += entry.path().extension() == ending;
    return count;
  }
};

TEST_F(WorkPrecisionTest, GivesTheSameErrorsFromSingleCasesAndSeveralThreads) {
  const std::vector<Chapter> chapters{work_precision_chapter({folder_, folder_ / "kept", true})};
  const auto together = folder_ / "together";
  const auto single = folder_ / "single";
  for (const auto& output : {together, single}) std::filesystem::create_directories(case_folder(output));
  run_cases(all_cases(chapters), {.folder = case_folder(together), .threads = 2, .progress = {}});
  std::filesystem::remove_all(folder_ / "kept");
  for (const StudyCase* study_case : all_cases(chapters)) {
    run_cases({&study_case, 1}, {.folder = case_folder(single), .threads = 1, .progress = {}});
  }
  EXPECT_EQ(files_in(folder_ / "kept", ".scene"), 2u) << "one for each image, errors and times";
  EXPECT_EQ(files_in(folder_ / "kept", ".cycles"), 2u) << "the reference, without and with friction";
  static_cast<void>(merge(chapters, together, "x"));
  static_cast<void>(merge(chapters, single, "x"));
  const std::string errors = text_of(together / "work_precision_errors.csv");
  EXPECT_EQ(text_of(single / "work_precision_errors.csv"), errors);
  EXPECT_NE(errors.find("bunny-teapot,contact,on,4,no,no,1000,"), std::string::npos) << errors;
  EXPECT_NE(text_of(report_file(single)).find("under a budget of 20 us a cycle"), std::string::npos)
      << "a setting, or on a busy machine that there is none";
}

TEST_F(WorkPrecisionTest, TriesEachImageOnceUnderAName) {
  const precision::ImageSetting written{.voxel_size = 0.002, .points = 5587, .levels = 7};
  for (const bool quick : {true, false}) {
    std::set<std::string> names;
    std::set<std::string> settings;
    const auto images = tried_images(written, quick, true);
    for (const TriedImage& image : images) {
      names.insert(image.name);
      settings.insert(precision::name(image.setting));
    }
    EXPECT_EQ(names.size(), images.size());
    EXPECT_EQ(settings.size(), images.size());
  }
}

TEST_F(WorkPrecisionTest, RefusesAFolderWithoutScenes) {
  EXPECT_THROW(work_precision_chapter({folder_ / "nowhere", {}, true}), command::Failure);
  EXPECT_THROW(work_precision_chapter({folder_, {}, false}), command::Failure) << "the other scenes are not there";
}

}  // namespace
}  // namespace godobject::report
