#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "firmware/command/failure.h"
#include "firmware/command/run.h"
#include "toolchain/bench/chapters.h"
#include "toolchain/bench/machine.h"
#include "toolchain/bench/scene_cache.h"
#include "toolchain/command/atomic_file.h"
#include "toolchain/command/output_target.h"
#include "toolchain/command/progress.h"

namespace {

using namespace godobject;
using namespace godobject::bench;

const char* const kFooter = R"(Example:
  godobject-bench -o bench
  godobject-bench --only peers

Chapters: cycles, whole cycles #1-#7 of every solver with and without friction on the bunny and the teapot, an ear in
its handle, the peg in the hole and the thin plate, warm and cold; peers, brute force over all points and FCL at the same poses.
Scenes are compiled at the first run (some minutes) and kept in --cache.

Exit codes: 0 done, 64 usage, 65 bad mesh, 66 an input is missing or may not be read, 74 cannot write, 77 no right to write.)";

void write(const std::filesystem::path& file, const std::string& text) {
  command::AtomicFile out(file);
  out.write(text);
  out.commit();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Measures run times: cycles, steps, and peers in the same run.", "godobject-bench");
  app.footer(kFooter);
  std::string only;
  std::string output;
  BenchRequest request;
  request.scenes = "toolchain/scenes";
  request.cache = default_cache_folder();
  app.add_option("--only", only, "one chapter; default: all")
      ->check(CLI::IsMember({"cycles", "peers"}))
      ->option_text("CHAPTER");
  app.add_flag("--full", request.full, "more passes, larger scenes");
  app.add_option("--scenes", request.scenes, "folder of the scene files; default: toolchain/scenes")
      ->type_name("FOLDER");
  app.add_option("--cache", request.cache, "folder of compiled scenes; default: ~/.cache/godobject-bench")
      ->type_name("FOLDER");
  app.add_option("-o,--out", output, "folder for CSV files and a page; made where it is not there")->type_name("DIR");
  return command::run(app, argc, argv, [&] {
    if (!output.empty()) command::make_output_folder(output);
    Chapter all;
    {
      command::Progress progress;
      request.progress = [&](std::string_view phase, double done) { progress.show(phase, done); };
      const std::vector<std::pair<std::string, Chapter (*)(const BenchRequest&)>> chapters = {
          {"cycles", &cycles_chapter}, {"peers", &peers_chapter}};
      for (const auto& [name, make] : chapters) {
        if (!only.empty() && only != name) continue;
        Chapter chapter = make(request);
        for (auto& table : chapter.tables) all.tables.push_back(std::move(table));
        for (auto& table : chapter.details) all.details.push_back(std::move(table));
        for (auto& remark : chapter.remarks) all.remarks.push_back(std::move(remark));
      }
    }
    for (const auto& [key, value] : machine_facts()) fmt::print("{}: {}\n", key, value);
    for (const Table& table : all.tables) fmt::print("\n{}", text_of(table));
    if (!all.remarks.empty()) fmt::print("\n{}\n", fmt::join(all.remarks, "\n"));
    if (output.empty()) return;
    for (const auto* tables : {&all.tables, &all.details}) {
      for (const Table& table : *tables) write(std::filesystem::path(output) / (table.name + ".csv"), csv_of(table));
    }
  });
}
