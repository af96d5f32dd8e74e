#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include "toolchain/command_line/failure.h"
#include "toolchain/command_line/run.h"
#include "toolchain/figures/replay_log.h"
#include "toolchain/files/atomic_file.h"
#include "toolchain/files/output_target.h"
#include "toolchain/page/player_file.h"
#include "toolchain/page/replay_page.h"

namespace {

using godobject::command::ExitCode;
using godobject::command::Failure;
using godobject::page::PageScene;
namespace fs = std::filesystem;

const char* const kFooter = R"(Examples:
  godobject-page bunny-teapot.toml contact.csv -o page.html --up y
  godobject-page nut-m16.toml contact.csv paper.csv -o page.html --title "A nut on its bolt, two solvers"

Opens in any browser, from a disk or a mail, without a network. The page plays the replays of one motion side by side, in
3D and as plots. Of a telemetry.csv only the cycles that rendered count. Of more than 20000 cycles the page stores every
n-th, and the extremes of all plots.

The player, the script in the page, is ../share/godobject/player.js beside the commands; --player names another one.

Exit codes: 0 done, 64 usage, 65 bad mesh or replay, or replays of different motions, 66 an input is missing or unreadable
(the player, too), 74 cannot write, 77 no permission to write, 78 bad scene file.)";

constexpr std::size_t kMostReplays = 3;  // more pictures side by side are too small

struct Options {
  std::string scene, output, title, player;
  std::vector<std::string> replays;
  std::string up = "z";
};

/// Returns the names of replays: those of the files without the extension, with the folder if two are alike.
std::vector<std::string> replay_names(const std::vector<std::string>& files) {
  std::vector<std::string> names;
  for (const fs::path file : files) names.push_back(file.stem().string());
  std::vector<std::string> sorted = names;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end()) return names;
  names.clear();
  for (const fs::path file : files)
    names.push_back((fs::absolute(file).parent_path().filename() / file.stem()).string());
  return names;
}

PageScene read_scene(const Options& options) {
  PageScene scene;
  const std::vector<std::string> names = replay_names(options.replays);
  for (std::size_t i = 0; i < names.size(); ++i)
    scene.replays.push_back({names[i], godobject::figures::read_replay_log(options.replays[i])});
  static_cast<godobject::page::PageBodies&>(scene) = godobject::page::read_page_bodies(options.scene);
  scene.up_axis = options.up[0] - 'x';
  return scene;
}

void write_page(const Options& options) {
  if (options.replays.size() > kMostReplays) {
    throw Failure(ExitCode::kUsage, fmt::format("{} replays are given, a page shows at most {}; make several pages",
                                                options.replays.size(), kMostReplays));
  }
  godobject::files::output_target(options.output);  // refused before the work
  const std::string script = godobject::page::read_player(options.player);
  const PageScene scene = read_scene(options);
  std::vector<std::string> names;
  for (const auto& replay : scene.replays) names.push_back(replay.name);
  const std::string title =
      !options.title.empty() ? options.title
                             : fmt::format("{}: {}", fs::path(options.scene).stem().string(), fmt::join(names, ", "));
  const std::string html = godobject::page::replay_page(scene, title, script);
  godobject::files::AtomicFile out(options.output);
  out.write(html);
  out.commit();
  fmt::print("{}: {} cycles, {:.2f} MB\n", options.output, scene.replays.front().log.size(),
             1e-6 * static_cast<double>(html.size()));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Writes a web page that plays replays of a scene: one file, without a server or a network.",
               "godobject-page");
  app.footer(kFooter);
  Options options;
  app.add_option("SCENE.toml", options.scene, "scene file with the meshes")->required()->type_name("");
  app.add_option("REPLAY.csv", options.replays,
                 "one to three outputs of godobject-replay for one path, or a telemetry.csv of godobject-controller")
      ->required()
      ->type_name("");
  app.add_option("-o,--output", options.output, "page to write")->required()->type_name("PAGE.html");
  app.add_option("--title", options.title, "default: the names of the scene and the replays")->type_name("WORDS");
  app.add_option("--up", options.up, "axis of W that points up: x, y or z; default: z")
      ->check(CLI::IsMember({"x", "y", "z"}))
      ->option_text("x|y|z");
  app.add_option("--player", options.player, "script in the page; default: the built one")->type_name("PLAYER.js");
  return godobject::command::run(app, argc, argv, [&] { write_page(options); });
}
