#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "toolchain/command_line/progress.h"
#include "toolchain/command_line/run.h"
#include "toolchain/figures/arm_figure.h"
#include "toolchain/figures/arm_run.h"
#include "toolchain/figures/claims.h"
#include "toolchain/figures/figure.h"
#include "toolchain/figures/page.h"
#include "toolchain/figures/plan.h"
#include "toolchain/figures/scene_facts.h"
#include "toolchain/figures/statistics.h"
#include "toolchain/figures/table.h"
#include "toolchain/files/atomic_file.h"
#include "toolchain/files/input_file.h"
#include "toolchain/files/output_target.h"
#include "toolchain/files/scene_image.h"

namespace {

using namespace godobject::figures;
namespace command = godobject::command;
namespace files = godobject::files;
namespace fs = std::filesystem;

const char* const kFooter = R"(Example:
  godobject-figures figures.toml --images images --solvers paper,corrected,contact -o out

Inputs:
  FIGURES.toml   tables [[scene]] with the keys name, image, title and text; optional are markers = { A = 0.4 } [s] and
                 barrier = [x, y, z, nx, ny, nz], a plane of W [m] on whose side the god object must stay. Optional
                 tables [[run]] have the same keys and device, the device file of an arm. Optional tables [[study]]
                 have the keys name, title and text.
  for a scene    LOGS/NAME/SOLVER.csv of godobject-replay, IMAGES/IMAGE.scene of godobject-scenec
  for a run      LOGS/NAME/telemetry.csv and LOGS/NAME/hand.csv of godobject-controller, and the image
  for a study    OUT/NAME/report.html of godobject-report, to which the page links
  optional       pictures OUT/NAME/SOLVER_MOMENT.png and OUT/NAME/telemetry_MOMENT.png of godobject-view; a moving
                 picture OUT/NAME/replay.html of godobject-page
Outputs:
  OUT/NAME/figure.svg (with gnuplot), OUT/statistics.csv, OUT/index.html; on stdout the table (the CSV file has more
  columns) and verdicts on the claims of the paper and of the solver contact, those on contact last

Percentiles are nearest-rank, over the cycles in contact; "over 1 ms" counts all cycles.

Exit codes: 0 done (missed claims included), 64 usage, 65 bad image or replay, 66 an input is missing or unreadable,
70 gnuplot fails or is not installed, 74 cannot write, 77 no permission to write, 78 not TOML, or a bad key.)";

struct Options {
  std::string plan, images, output, logs;
  std::vector<std::string> solvers;
};

void write(const fs::path& file, const std::string& text) {
  files::AtomicFile out(file);
  out.write(text);
  out.commit();
}

/// Refuses missing inputs and outputs that cannot be written, before the work.
void check_files(const Options& options, const Plan& plan) {
  const fs::path output = options.output;
  const fs::path logs = options.logs;
  for (const char* file : {"statistics.csv", "index.html"}) files::output_target(output / file);
  for (const ScenePlan& scene : plan.scenes) {
    for (const std::string& solver : options.solvers)
      files::require_input(logs / scene.name / (solver + ".csv"), "make it with godobject-replay");
    files::output_target(output / scene.name / "figure.svg");
  }
  for (const StudyPlan& study : plan.studies)
    files::require_input(output / study.name / "report.html", "make it with godobject-report");
  for (const ArmPlan& run : plan.runs) {
    for (const char* file : {"telemetry.csv", "hand.csv"})
      files::require_input(logs / run.scene.name / file, "make it with godobject-controller --log");
    files::output_target(output / run.scene.name / "figure.svg");
  }
}

files::SceneImage read_image(const Options& options, const ScenePlan& plan) {
  return files::SceneImage::read(fs::path(options.images) / (plan.image + ".scene"));
}

void add_scene(const Options& options, const ScenePlan& plan, PageContent& content) {
  const auto image = read_image(options, plan);
  const godobject::SceneView& scene = image.scene;
  const fs::path folder = fs::path(options.output) / plan.name;
  Figure figure{.title = plan.title,
                .facts = scene_facts(scene),
                .voxel_size = scene.grid.voxel_size,
                .markers = plan.markers,
                .series = {}};
  for (const std::string& solver : options.solvers) {
    ReplayLog log = read_replay_log(fs::path(options.logs) / plan.name / (solver + ".csv"));
    Entry entry{plan.name, solver, figure.voxel_size, statistics(log, scene.grid.band), {}};
    if (plan.barrier) entry.crossing = furthest_crossing(log, scene, *plan.barrier);
    content.entries.push_back(std::move(entry));
    figure.series.push_back({solver, std::move(log)});
  }
  draw(figure, folder / "figure.svg");
  content.figures.push_back(std::move(figure));
}

void add_run(const Options& options, const ArmPlan& plan, PageContent& content) {
  const auto image = read_image(options, plan.scene);
  const godobject::SceneView& scene = image.scene;
  const fs::path folder = fs::path(options.output) / plan.scene.name;
  ArmFigure figure{plan.scene.title, scene_facts(scene), plan.scene.markers,
                   read_arm_log(fs::path(options.logs) / plan.scene.name, plan.device)};
  ArmRun run = arm_run(figure.log, scene.grid.band);
  run.name = plan.scene.name;
  run.voxel_size = scene.grid.voxel_size;
  if (plan.scene.barrier) run.crossing = furthest_crossing(rendered(figure.log.cycles), scene, *plan.scene.barrier);
  draw(figure, folder / "figure.svg");
  content.runs.push_back(std::move(run));
  content.arm_figures.push_back(std::move(figure));
}

void make_figures(const Options& options) {
  PageContent content;
  content.plan = read_plan(options.plan);
  content.logs = options.logs;
  check_files(options, content.plan);
  {
    command::Progress progress;
    const double all = static_cast<double>(content.plan.scenes.size() + content.plan.runs.size());
    for (const ScenePlan& plan : content.plan.scenes) {
      progress.show("figures", static_cast<double>(content.figures.size()) / all);
      add_scene(options, plan, content);
    }
    for (const ArmPlan& plan : content.plan.runs) {
      progress.show("figures", static_cast<double>(content.figures.size() + content.runs.size()) / all);
      add_run(options, plan, content);
    }
  }
  content.verdicts = judge(content.entries);
  content.run_verdicts = judge_arm_runs(content.runs);
  const fs::path output = options.output;
  write(output / "statistics.csv", csv_table(content.entries));
  write(output / "index.html", page(content, output));
  fmt::print("{}\n", text_table(content.entries));
  const auto print = [](const std::vector<std::string>& verdicts) {
    for (const std::string& verdict : verdicts) fmt::print("{}\n", verdict);
  };
  print(content.verdicts.compared);
  fmt::print("\nTimes; a busy machine makes them longer:\n");
  print(content.verdicts.times);
  if (!content.runs.empty()) fmt::print("\n{}", arm_table(content.runs));
  fmt::print("\nThe solver contact:\n");
  print(content.verdicts.contact);
  print(content.run_verdicts);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Statistics and figures of replays and of runs on an arm: tables, plots, one HTML page.",
               "godobject-figures");
  app.footer(kFooter);
  Options options;
  app.add_option("FIGURES.toml", options.plan, "what to show")->required()->type_name("");
  app.add_option("--images", options.images, "folder of the scene images")->required()->type_name("FOLDER");
  app.add_option("--solvers", options.solvers, "names of the replays to show: a colour each, the last on top")
      ->delimiter(',')
      ->required()
      ->option_text("SOLVER[,SOLVER ...] REQUIRED");
  app.add_option("-o,--output", options.output, "folder of the pictures, and of what is written")
      ->required()
      ->type_name("OUT");
  app.add_option("--logs", options.logs, "folder of the replays and of the logs of runs; default: OUT")
      ->type_name("LOGS");
  return command::run(app, argc, argv, [&] {
    if (options.logs.empty()) options.logs = options.output;
    make_figures(options);
  });
}
