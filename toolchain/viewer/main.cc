#include <cstdio>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "toolchain/command/failure.h"
#include "toolchain/command/progress.h"
#include "toolchain/command/run.h"
#include "toolchain/figures/replay_log.h"
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

const char* const kFooter = R"(Example:
  godobject-view bunny-teapot.toml corrected.csv --at 0.6 --at 1.2 -o pictures --up y

The still body is green, the moving one red where the device has it and blue where the god object is. Without --camera a
direction is chosen from which the contact is seen. A picture's name is that of the replay and its time: corrected_1.200.png,
or what -o says if it ends in .png.)";

struct Options {
  std::string scene, replay, output;
  std::vector<double> times;
  std::vector<double> camera;
  std::vector<double> cut;
  std::string up = "z";
  std::string size = "800x600";
};

/// "800x600" -> width and height.
std::pair<int, int> parse_size(const std::string& text) {
  int width = 0;
  int height = 0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest) != 2 || width < 16 || height < 16 || width > 8192 || height > 8192) {
    throw Failure(ExitCode::kUsage, fmt::format("--size {}: must be WIDTHxHEIGHT, 16 .. 8192 pixels each, such as 800x600", text));
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

/// Where the picture of time t goes.
fs::path picture_path(const Options& options, double t) {
  const fs::path output = options.output;
  if (output.extension() == ".png") {
    if (options.times.size() > 1) throw Failure(ExitCode::kUsage, "-o names one picture, but --at is given more than once; name a folder");
    return output;
  }
  std::error_code error;
  fs::create_directories(output, error);
  if (error) throw Failure(ExitCode::kIo, fmt::format("{}: cannot be made ({})", output.string(), error.message()));
  return output / fmt::format("{}_{:.3f}.png", fs::path(options.replay).stem().string(), t);
}

void render_all(const Options& options) {
  const auto log = godobject::figures::read_replay_log(options.replay);
  const auto bodies = viewer::read_scene_bodies(options.scene);
  viewer::Picture picture;
  std::tie(picture.width, picture.height) = parse_size(options.size);
  picture.cut = cut(options.cut);
  godobject::command::Progress progress;
  for (std::size_t i = 0; i < options.times.size(); ++i) {
    progress.show("pictures", static_cast<double>(i) / static_cast<double>(options.times.size()));
    const auto& row = godobject::figures::row_at(log, options.times[i], options.replay);
    picture.H_WD = row.H_WD;
    picture.H_WS = row.H_WS;
    picture.camera = viewer::make_camera({.still = bodies.still,
                                          .moving = bodies.moving,
                                          .H_WD = row.H_WD,
                                          .H_WS = row.H_WS,
                                          .up_axis = options.up[0] - 'x',
                                          .zoom = options.camera.size() > 2 ? options.camera[2] : 1.0,
                                          .direction = direction(options.camera)});
    viewer::render(viewer::pov_text(bodies.still, bodies.moving, picture), picture.width, picture.height, picture_path(options, row.t));
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Renders pictures of a replay with POV-Ray.", "godobject-view");
  app.footer(kFooter);
  Options options;
  app.add_option("SCENE", options.scene, "scene file, TOML")->required();
  app.add_option("REPLAY", options.replay, "output of godobject-replay, CSV")->required();
  app.add_option("--at", options.times, "time to show [s]; may be given often")->required()->expected(1)->multi_option_policy(
      CLI::MultiOptionPolicy::TakeAll);
  app.add_option("-o,--output", options.output, "folder, or one picture X.png")->required();
  app.add_option("--camera", options.camera, "AZIMUTH,ELEVATION[,ZOOM]: from the body to the eye [degrees]; zoom 2 is twice as near")
      ->delimiter(',')
      ->expected(2, 3);
  app.add_option("--up", options.up, "axis of W that points up: x, y or z; default: z")->check(CLI::IsMember({"x", "y", "z"}));
  app.add_option("--cut", options.cut, "X,Y,Z,NX,NY,NZ: cuts away the still body (closed) beyond this plane of W [m]")->delimiter(',')->expected(6);
  app.add_option("--size", options.size, "WIDTHxHEIGHT [pixels]; default: 800x600");
  return godobject::command::run(app, argc, argv, [&] { render_all(options); });
}
