#include <cstdio>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "toolchain/command_line/failure.h"
#include "toolchain/command_line/progress.h"
#include "toolchain/command_line/run.h"
#include "toolchain/figures/replay_log.h"
#include "toolchain/files/output_target.h"
#include "toolchain/viewer/camera.h"
#include "toolchain/viewer/pov_text.h"
#include "toolchain/viewer/render.h"
#include "toolchain/viewer/scene_bodies.h"

namespace {

using godobject::Vector3;
using godobject::command::ExitCode;
using godobject::command::Failure;
namespace fs = std::filesystem;
namespace viewer = godobject::viewer;

const char* const kFooter = R"(Examples:
  godobject-view bunny-teapot.toml paper.csv corrected.csv contact.csv --at 0.6 --at deepest -o pictures --up y
  godobject-view peg-hole.toml contact.csv --at 1.9 -o tilted.png --cut 0,0,0,0,-1,0 --camera -80,20

The still body is green. The moving body is red at the device pose and blue at the pose of the god object. Each replay
gets a picture of its own; all pictures of a moment share one camera. Of a telemetry.csv only the cycles that rendered
count. Without --camera the command chooses a direction from which the contact is visible. A picture is named after
replay and moment (contact_0.600.png, contact_deepest.png), unless -o ends in .png. The command prints the names of
the pictures. A picture takes some seconds.

Exit codes: 0 done, 64 usage, 65 bad mesh or replay, or no such time in it, 66 an input is missing or unreadable,
70 POV-Ray fails or is not installed, 74 cannot write, 77 no permission to write, 78 bad scene file.)";

struct Options {
  std::string scene, output;
  std::vector<std::string> replays;
  std::vector<std::string> moments;
  std::vector<double> camera;
  std::vector<double> cut;
  std::string up = "z";
  std::string size = "800x600";
};

/// Returns width and height of a size such as "800x600".
std::pair<int, int> parse_size(const std::string& text) {
  int width = 0;
  int height = 0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest) != 2 || width < 16 || height < 16 || width > 8192 ||
      height > 8192) {
    throw Failure(ExitCode::kUsage,
                  fmt::format("--size {}: must be WIDTHxHEIGHT, 16 .. 8192 pixels each, such as 800x600", text));
  }
  return {width, height};
}

std::optional<viewer::ViewDirection> direction(const std::vector<double>& camera) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  if (camera.empty()) return std::nullopt;
  return viewer::ViewDirection{camera[0] * kDegree, camera[1] * kDegree};
}

std::optional<viewer::Cut> cut(const std::vector<double>& numbers) {
  if (numbers.empty()) return std::nullopt;
  const Vector3 normal(numbers[3], numbers[4], numbers[5]);
  if (!(normal.norm() > 1e-9)) throw Failure(ExitCode::kUsage, "--cut: the normal must not be zero");
  return viewer::Cut{Vector3(numbers[0], numbers[1], numbers[2]), normal.normalized()};
}

bool names_one_picture(const Options& options) { return fs::path(options.output).extension() == ".png"; }

/// Creates the output folder. Refuses an output that cannot be written, before the work.
void prepare_output(const Options& options) {
  if (!names_one_picture(options)) return godobject::files::make_output_folder(options.output);
  if (options.moments.size() * options.replays.size() > 1)
    throw Failure(ExitCode::kUsage, "-o names one picture, but several replays or times are given; name a folder");
  godobject::files::output_target(options.output);
}

/// Returns the file of the picture of a replay at a moment.
fs::path picture_path(const Options& options, const fs::path& replay, const std::string& moment) {
  const fs::path output = options.output;
  if (names_one_picture(options)) return output;
  return output / fmt::format("{}_{}.png", replay.stem().string(), moment);
}

/// A moment and the poses of every replay at that moment; they share one camera.
struct Moment {
  std::string name;
  std::vector<viewer::Placement> placements;
};

std::vector<Moment> read_moments(const Options& options) {
  std::vector<godobject::figures::ReplayLog> logs;
  for (const std::string& replay : options.replays) logs.push_back(godobject::figures::read_replay_log(replay));
  std::vector<const godobject::figures::ReplayLog*> views;
  for (const auto& log : logs) views.push_back(&log);
  std::vector<Moment> moments;
  for (const std::string& name : options.moments) {
    const std::optional<double> t = godobject::figures::moment(name, views);
    if (!t) throw Failure(ExitCode::kUsage, fmt::format("--at {}: must be a time [s] or the word deepest", name));
    Moment moment{name == "deepest" ? name : fmt::format("{:.3f}", *t), {}};
    for (std::size_t i = 0; i < logs.size(); ++i) {
      const auto& row = godobject::figures::row_at(logs[i], *t, options.replays[i]);
      moment.placements.push_back({row.H_WD, row.H_WS});
    }
    moments.push_back(std::move(moment));
  }
  return moments;
}

void render_all(const Options& options) {
  prepare_output(options);
  const std::vector<Moment> moments = read_moments(options);
  const auto bodies = viewer::read_scene_bodies(options.scene);
  viewer::Picture picture;
  std::tie(picture.width, picture.height) = parse_size(options.size);
  picture.cut = cut(options.cut);
  std::vector<fs::path> written;
  {
    godobject::command::Progress progress;
    const double all = static_cast<double>(moments.size() * options.replays.size());
    for (const Moment& moment : moments) {
      picture.camera = viewer::make_camera({.still = bodies.still,
                                            .moving = bodies.moving,
                                            .placements = moment.placements,
                                            .up_axis = options.up[0] - 'x',
                                            .zoom = options.camera.size() > 2 ? options.camera[2] : 1.0,
                                            .direction = direction(options.camera)});
      for (std::size_t i = 0; i < options.replays.size(); ++i) {
        progress.show("pictures", static_cast<double>(written.size()) / all);
        picture.placement = moment.placements[i];
        const fs::path png = picture_path(options, options.replays[i], moment.name);
        viewer::render(viewer::pov_text(bodies.still, bodies.moving, picture), picture.width, picture.height, png);
        written.push_back(png);
      }
    }
  }
  for (const fs::path& png : written) fmt::print("{}\n", png.string());
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Renders pictures of a replay, or of a run on an arm, with POV-Ray.", "godobject-view");
  app.footer(kFooter);
  Options options;
  app.add_option("SCENE.toml", options.scene, "scene file with the meshes")->required()->type_name("");
  app.add_option("REPLAY.csv", options.replays,
                 "outputs of godobject-replay for one path, or a telemetry.csv of godobject-controller")
      ->required()
      ->type_name("");
  app.add_option("--at", options.moments,
                 "time to show [s], or deepest: the time of the largest depth; may be repeated")
      ->required()
      ->type_name("TIME|deepest")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_option("-o,--output", options.output, "folder of the pictures (created if it is missing), or one picture")
      ->required()
      ->type_name("FOLDER|X.png");
  app.add_option("--camera", options.camera,
                 "direction from the body to the eye [degrees]; zoom 2 doubles all sizes; default: automatic, zoom 1")
      ->option_text("AZIMUTH,ELEVATION[,ZOOM]")
      ->delimiter(',')
      ->expected(2, 3);
  app.add_option("--up", options.up, "axis of W that points up: x, y or z; default: z")
      ->check(CLI::IsMember({"x", "y", "z"}))
      ->option_text("x|y|z");
  app.add_option("--cut", options.cut, "cuts away the still body (closed) beyond this plane of W [m]")
      ->option_text("X,Y,Z,NX,NY,NZ")
      ->delimiter(',')
      ->expected(6);
  app.add_option("--size", options.size, "[pixels]; default: 800x600")->type_name("WIDTHxHEIGHT");
  return godobject::command::run(app, argc, argv, [&] { render_all(options); });
}
