// The choice for a budget, with made-up costs and errors.
#include <new>

#include <gtest/gtest.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/precision/recommendation.h"

namespace godobject::precision {
namespace {

scene_compiler::SceneConfig scene() {
  scene_compiler::SceneConfig config;
  config.voxel_size = 0.002;
  config.body_voxel_size = 0.001;
  config.thickness = 0.003;
  config.field_tolerance = 0.05;
  config.between_points = 0.002;
  config.points = 5000;
  config.levels = 7;
  config.settings.safety_distance = 0.003;
  config.settings.margin = 2e-5;
  return config;
}

/// Finer images cost more and are better; `contact` costs twice what `paper` does and is ten times as good.
std::vector<Result> made_up(const ImageSetting& image) {
  std::vector<Result> results;
  for (const Solver solver : {Solver::kPaper, Solver::kContact}) {
    const bool is_paper = solver == Solver::kPaper;
    Result result;
    result.setting = {.image = image, .solver = solver, .friction = true, .margin = 1e-5};
    result.cost.p99_ns = (is_paper ? 1.0 : 2.0) * static_cast<double>(image.points) * (image.refined ? 1.0 : 0.5);
    result.wrench.relative = (is_paper ? 1.0 : 0.1) * image.voxel_size;
    results.push_back(result);
  }
  return results;
}

TEST(Recommendation, TakesTheSmallestErrorOfWhatIsQuickEnough) {
  const auto images = candidate_images(scene());
  const Recommendation found = recommend(images, 10'000.0, made_up);
  ASSERT_EQ(found.tried.size(), 2 * images.size());
  ASSERT_TRUE(found.chosen);
  const Result& chosen = found.tried[*found.chosen];
  EXPECT_EQ(chosen.setting.solver, Solver::kContact);
  EXPECT_DOUBLE_EQ(chosen.setting.image.voxel_size, 0.001) << "the finest, 10 us";
  const std::string words = text(found, 10'000.0);
  EXPECT_NE(words.find("paper's best under this budget: 0.1 %, 10 times as much"), std::string::npos) << words;
  EXPECT_EQ(json(found, 10'000.0)["chosen"]["solver"], "contact");
  EXPECT_EQ(json(found, 10'000.0)["tried"].size(), found.tried.size());
}

TEST(Recommendation, TakesTheCheaperSolverWhereTheBetterOneIsTooSlow) {
  const Recommendation found = recommend({image_setting(scene())}, 9'999.0, made_up);
  ASSERT_TRUE(found.chosen);
  EXPECT_EQ(found.tried[*found.chosen].setting.solver, Solver::kPaper);
}

TEST(Recommendation, TakesNothingWhereAllCostMore) {
  const Recommendation found = recommend(candidate_images(scene()), 100.0, made_up);
  EXPECT_FALSE(found.chosen);
  EXPECT_TRUE(json(found, 100.0)["chosen"].is_null());
}

TEST(Recommendation, ListsRefusedImagesAndChoosesAmongTheOthers) {
  const auto images = candidate_images(scene());
  const Recommendation all = recommend(images, 10'000.0, made_up);
  for (std::size_t refused = 0; refused < images.size(); ++refused) {
    const auto evaluate = [&](const ImageSetting& image) {
      if (name(image) == name(images[refused])) {
        if (refused % 2 == 0) throw command::Failure(command::ExitCode::kBadData, "a wall is too thin; refine");
        throw std::bad_alloc();
      }
      return made_up(image);
    };
    const Recommendation found = recommend(images, 10'000.0, evaluate);
    EXPECT_EQ(found.tried.size(), all.tried.size() - 2);
    ASSERT_EQ(found.refused.size(), 1u);
    ASSERT_TRUE(found.chosen);
    EXPECT_NE(name(found.tried[*found.chosen].setting.image), name(images[refused]));
    const std::string words = text(found, 10'000.0);
    EXPECT_NE(words.find("refused: " + name(images[refused]) + ": " + found.refused[0].reason), std::string::npos)
        << words;
    EXPECT_EQ(json(found, 10'000.0)["refused"][0]["points"], images[refused].points);
    EXPECT_EQ(json(found, 10'000.0)["refused"][0]["reason"], found.refused[0].reason);
  }
  EXPECT_FALSE(json(all, 10'000.0).contains("refused"));
}

TEST(Recommendation, SaysWhyNothingIsChosen) {
  const auto images = candidate_images(scene());
  const auto refuse = [&](const ImageSetting& image) -> std::vector<Result> {
    throw command::Failure(command::ExitCode::kBadData, image.refined ? "thin wall; refine" : "no inside; cut");
  };
  const Recommendation none = recommend(images, 1e9, refuse);
  EXPECT_FALSE(none.chosen);
  EXPECT_EQ(none.refused.size(), images.size());
  EXPECT_EQ(reason_for_nothing(none), "the compiler refused all 8 images: thin wall; refine | no inside; cut");
  EXPECT_NE(reason_for_nothing(recommend(images, 100.0, made_up)).find("none of the 16 settings"), std::string::npos);
}

TEST(Recommendation, EndsWhereAFileFails) {
  const auto fail = [&](const ImageSetting&) -> std::vector<Result> {
    throw command::Failure(command::ExitCode::kIo, "the disk is full");
  };
  EXPECT_THROW(recommend(candidate_images(scene()), 1e9, fail), command::Failure);
}

TEST(Setting, ChangesOneThingAtATimeAndLengthsWithTheVoxels) {
  const auto images = candidate_images(scene());
  for (std::size_t i = 0; i < images.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(name(images[i]), name(images[j])) << "tried twice";
  }
  ImageSetting coarse = image_setting(scene());
  coarse.voxel_size = 0.004;
  const auto changed = with(scene(), coarse);
  EXPECT_DOUBLE_EQ(changed.settings.safety_distance, 0.006);
  EXPECT_DOUBLE_EQ(changed.settings.margin, 4e-5);
  EXPECT_DOUBLE_EQ(changed.body_voxel_size, 0.002);
  EXPECT_DOUBLE_EQ(changed.thickness, 0.004) << "a shell is a voxel thick at least";
  EXPECT_DOUBLE_EQ(changed.field_tolerance, 0.05);
  const auto same = with(scene(), image_setting(scene()));
  EXPECT_DOUBLE_EQ(same.thickness, 0.003);
  EXPECT_EQ(same.points, 5000u);
  EXPECT_EQ(same.levels, 7u);
}

TEST(Budget, IsATimeWithItsUnit) {
  EXPECT_DOUBLE_EQ(parse_budget_ns("20us"), 20'000.0);
  EXPECT_DOUBLE_EQ(parse_budget_ns("0.5 ms"), 500'000.0);
  EXPECT_DOUBLE_EQ(parse_budget_ns("750ns"), 750.0);
  for (const char* bad : {"", "20", "us", "-1us", "0us", "nanus", "20 s", "20us ", "1e999us"}) {
    EXPECT_THROW(parse_budget_ns(bad), command::Failure) << bad;
  }
}

}  // namespace
}  // namespace godobject::precision
