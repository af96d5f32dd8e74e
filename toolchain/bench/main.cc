#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "toolchain/bench/chapters.h"
#include "toolchain/bench/machine.h"
#include "toolchain/bench/micro.h"
#include "toolchain/bench/page.h"
#include "toolchain/bench/scene_cache.h"
#include "toolchain/bench/target.h"
#include "toolchain/command_line/failure.h"
#include "toolchain/command_line/progress.h"
#include "toolchain/command_line/run.h"
#include "toolchain/files/output_target.h"

namespace {

using namespace godobject;
using namespace godobject::bench;

const char* const kFooter = R"(Example:
  godobject-bench -o bench
  godobject-bench --only peers

Chapters:
  cycles   whole cycles #1-#7 of every solver with and without friction, warm and cold: the bunny on the teapot, an ear
           in the handle, the peg in its hole, the bunny at the thin plate
  peers    brute force over all points, and FCL, at the same poses
  scaling  the sliding bunny with 10^3 to 10^5 points and voxels of 2 and 1 mm; with --full to 10^6 points and 0.25 mm
  parts    look-ups, searches and solvers one by one, by Google Benchmark, whose options it takes
           (--benchmark_filter=look-up, ...)

The first run compiles the scenes (some minutes) and stores them in --cache. A later run takes less than two minutes,
with --full ten.

Exit codes: 0 done, 64 usage, 65 bad mesh, 66 an input is missing or unreadable, 74 cannot write, 77 no permission to
write.)";

}  // namespace

int main(int argc, char** argv) {
  // Google Benchmark gets its own options
  std::vector<char*> ours;
  std::vector<std::string> for_benchmark;
  for (int i = 0; i < argc; ++i) {
    if (i > 0 && std::string_view(argv[i]).starts_with("--benchmark_")) {
      for_benchmark.emplace_back(argv[i]);
    } else {
      ours.push_back(argv[i]);
    }
  }
  CLI::App app("Measures run times of cycles and steps, beside alternatives in the same run.", "godobject-bench");
  app.footer(kFooter);
  std::string only;
  std::string output;
  BenchRequest request;
  request.scenes = "toolchain/scenes";
  request.cache = default_cache_folder();
  app.add_option("--only", only, "one chapter; default: all")
      ->check(CLI::IsMember({"cycles", "peers", "scaling", "parts"}))
      ->option_text("CHAPTER");
  app.add_flag("--full", request.full, "more passes, larger scenes");
  app.add_option("--scenes", request.scenes, "folder of the scene files; default: toolchain/scenes")
      ->type_name("FOLDER");
  app.add_option("--cache", request.cache, "folder of compiled scenes; default: ~/.cache/godobject-bench")
      ->type_name("FOLDER");
  app.add_option("-o,--out", output, "folder for CSV files and a page; created if it is missing")->type_name("DIR");
  return command::run(app, static_cast<int>(ours.size()), ours.data(), [&] {
    if (!output.empty()) files::make_output_folder(output);
    start_google_benchmark(request.full, for_benchmark);
    Chapter all;
    std::vector<Target> targets;
    {
      command::Progress progress;
      request.progress = [&](std::string_view phase, double done) { progress.show(phase, done); };
      const std::vector<std::pair<std::string, Chapter (*)(const BenchRequest&)>> chapters = {
          {"cycles", &cycles_chapter},
          {"peers", &peers_chapter},
          {"scaling", &scaling_chapter},
          {"parts", &micro_chapter}};
      for (const auto& [name, make] : chapters) {
        if (!only.empty() && only != name) continue;
        Chapter chapter = make(request);
        for (auto& table : chapter.tables) all.tables.push_back(std::move(table));
        for (auto& table : chapter.details) all.details.push_back(std::move(table));
        for (auto& plot : chapter.plots) all.plots.push_back(std::move(plot));
        for (auto& target : chapter.targets) targets.push_back(std::move(target));
        for (auto& remark : chapter.remarks) all.remarks.push_back(std::move(remark));
      }
    }
    if (!targets.empty()) all.tables.push_back(table_of(targets));
    const auto machine = machine_facts();
    for (const auto& [key, value] : machine) fmt::print("{}: {}\n", key, value);
    for (const Table& table : all.tables) fmt::print("\n{}", text_of(table));
    if (!all.remarks.empty()) fmt::print("\n{}\n", fmt::join(all.remarks, "\n"));
    if (!output.empty()) write_page(all, machine, output);
  });
}
