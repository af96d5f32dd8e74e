#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "firmware/command/input_file.h"
#include "firmware/command/run.h"
#include "toolchain/command/atomic_file.h"
#include "toolchain/command/output_target.h"
#include "toolchain/command/progress.h"
#include "toolchain/command/scene_image.h"
#include "toolchain/figures/claims.h"
#include "toolchain/figures/figure.h"
#include "toolchain/figures/page.h"
#include "toolchain/figures/plan.h"
#include "toolchain/figures/scene_facts.h"
#include "toolchain/figures/statistics.h"
#include "toolchain/figures/table.h"

namespace {

using namespace godobject::figures;
namespace command = godobject::command;
namespace fs = std::filesystem;

const char* const kFooter = R"(Example:
  godobject-figures figures.toml --images images --solvers paper,corrected,contact -o out

FIGURES.toml holds tables [[scene]] with the keys name, image, title, text and, if wanted, markers =
{ A = 0.4 } [s] and barrier = [x, y, z, nx, ny, nz]: the god object is to stay on that side of a plane of W [m]. For each of them
OUT/NAME/SOLVER.csv (of godobject-replay) and IMAGES/IMAGE.scene (of godobject-scenec) must be there. Writes OUT/NAME/figure.png
with gnuplot, OUT/statistics.csv and OUT/index.html, and prints the table, what is missed of the paper's claims and of
what contact promises, and what holds; the CSV table has more columns than the printed one. Pictures OUT/NAME/SOLVER_MOMENT.png
(of godobject-view) are shown if they are there.
Percentiles are of nearest rank, over the cycles in contact; "over 1 ms" counts all cycles.

Exit codes: 0 done (whatever is missed), 64 usage, 65 bad image, replay or TOML, 66 an input is missing or may not be read,
70 gnuplot fails or is not installed, 74 cannot write, 77 no right to write, 78 bad key.)";

struct Options {
  std::string plan, images, output;
  std::vector<std::string> solvers;
};

void write(const fs::path& file, const std::string& text) {
  command::AtomicFile out(file);
  out.write(text);
  out.commit();
}

void make_figures(const Options& options) {
  const fs::path output = options.output;
  const fs::path statistics_file = output / "statistics.csv";
  const fs::path page_file = output / "index.html";
  for (const fs::path& file : {statistics_file, page_file}) command::output_target(file);  // refused before the work
  const std::vector<ScenePlan> plans = read_plan(options.plan);
  for (const ScenePlan& plan : plans) {
    for (const std::string& solver : options.solvers)
      command::require_input(output / plan.name / (solver + ".csv"), "make it with godobject-replay");
    command::output_target(output / plan.name / "figure.png");
  }
  std::vector<Entry> entries;
  std::vector<Figure> figures;
  {
    command::Progress progress;
    for (const ScenePlan& plan : plans) {
      progress.show("figures",
                    static_cast<double>(entries.size()) / static_cast<double>(plans.size() * options.solvers.size()));
      const auto image = command::SceneImage::read(fs::path(options.images) / (plan.image + ".scene"));
      const godobject::Scene& scene = image.scene;
      Figure figure{.title = plan.title,
                    .facts = scene_facts(scene),
                    .voxel_size = scene.grid.voxel_size,
                    .markers = plan.markers,
                    .series = {}};
      for (const std::string& solver : options.solvers) {
        ReplayLog log = read_replay_log(output / plan.name / (solver + ".csv"));
        Entry entry{plan.name, solver, figure.voxel_size, statistics(log, scene.grid.band), {}};
        if (plan.barrier) entry.crossing = furthest_crossing(log, scene, *plan.barrier);
        entries.push_back(std::move(entry));
        figure.series.push_back({solver, std::move(log)});
      }
      draw(figure, output / plan.name / "figure.png");
      figures.push_back(std::move(figure));
    }
  }
  const std::vector<std::string> verdicts = judge(entries);
  write(statistics_file, csv_table(entries));
  write(page_file, page(plans, figures, entries, verdicts, output));
  fmt::print("{}\n", text_table(entries));
  for (const std::string& verdict : verdicts) fmt::print("{}\n", verdict);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Statistics and figures of replays: tables, plots, one HTML page.", "godobject-figures");
  app.footer(kFooter);
  Options options;
  app.add_option("FIGURES.toml", options.plan, "what to show")->required()->type_name("");
  app.add_option("--images", options.images, "folder of the scene images")->required()->type_name("FOLDER");
  app.add_option("--solvers", options.solvers, "names of the replays to show: a colour each, the last on top")
      ->delimiter(',')
      ->required()
      ->option_text("SOLVER[,SOLVER ...] REQUIRED");
  app.add_option("-o,--output", options.output, "folder of the replays, and of what is written")
      ->required()
      ->type_name("OUT");
  return command::run(app, argc, argv, [&] { make_figures(options); });
}
