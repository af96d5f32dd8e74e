#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "firmware/machine/signals.h"
#include "toolchain/command_line/failure.h"
#include "toolchain/command_line/run.h"
#include "toolchain/files/input_file.h"
#include "toolchain/files/text_file.h"
#include "toolchain/live/live_page.h"
#include "toolchain/live/live_server.h"
#include "toolchain/live/simulated_run.h"
#include "toolchain/live/telemetry_follower.h"
#include "toolchain/page/player_file.h"
#include "toolchain/scene_compiler/scene_config.h"
#include "toolchain/viewer/scene_bodies.h"

namespace {

using namespace godobject;
using command::ExitCode;
using command::Failure;
namespace fs = std::filesystem;

const char* const kFooter = R"(Examples:
  godobject-live bunny-plate.toml lwr-bunny-plate.toml --hand
  godobject-live bunny-plate.toml lwr-bunny-plate.toml --follow logs

Prints an address; open it in a browser. The page shows both bodies, the hand, the god object, forces and contacts, the arm
and plots. Ctrl-C ends.

Without --follow the arm is simulated here, as by godobject-controller, slowed to real time. Its hand repeats
simulation.path. With --hand the mouse is the hand: drag the moving body. Solver, friction and gains can be changed
meanwhile. With --follow the page looks at a controller in another process, simulated or real, through the telemetry.csv
that it writes to DIR. Nothing that a page does reaches that controller or any bus.

The page is served on this machine only, to who has the token in the address. --listen serves it to others: whoever sees
the address then sees the page, and with --hand moves the simulated arm.

Exit codes: 0 ended by a signal, 64 usage, 65 bad mesh, scene image or path, 66 an input is missing or unreadable, 69 the
port cannot be opened or the controller has stopped, 78 bad scene file or configuration.)";

struct Options {
  std::string scene, controller, image, follow, player;
  std::string up = "z";
  std::string listen = "127.0.0.1";
  int port = 8642;
  bool hand = false;
};

firmware::ControllerConfig read_configuration(const Options& options) {
  firmware::ControllerConfig config = firmware::read_controller_file(options.controller);
  if (!options.image.empty()) config.scene.image = options.image;
  if (!options.follow.empty()) config.telemetry.folder = options.follow;
  if (config.scene.image.empty()) {
    throw Failure(ExitCode::kBadConfig,
                  fmt::format("{}: scene.image is missing; add it or give --image", options.controller));
  }
  return config;
}

std::unique_ptr<live::LiveSource> make_source(const Options& options, const firmware::ControllerConfig& config) {
  if (!options.follow.empty()) return std::make_unique<live::TelemetryFollower>(config);
  return std::make_unique<live::SimulatedRun>(config, options.hand);
}

/// Refuses meshes that are not those of the image, as far as the size of the moving body tells.
void require_same_scene(const Options& options, const page::PageBodies& bodies, const SceneView& scene) {
  constexpr double kShare = 0.05;  // of the radius; sample points lie on the mesh
  const Pose H_BM = scene.H_MB.inverse();
  double farthest = 0.0;
  for (const Vector3& vertex : bodies.bodies.moving.vertices) farthest = std::max(farthest, (H_BM * vertex).norm());
  double stored = 0.0;
  for (std::size_t i = 0; i < scene.pointshell.size; ++i) stored = std::max(stored, scene.pointshell.point(i).norm());
  if (scene.pointshell.size > 0 && std::abs(stored - farthest) <= kShare * farthest) return;
  throw Failure(
      ExitCode::kBadConfig,
      fmt::format("{}: its moving body reaches {:.4g} m from its centre of mass, that of the scene image {:.4g} m; "
                  "name the scene file that the image was compiled from",
                  options.scene, farthest, stored));
}

std::string make_page(const Options& options, const firmware::ControllerConfig& config,
                      const live::LiveSource& source) {
  const std::string script = page::read_player(options.player);
  live::LivePage page;
  page.bodies = page::read_page_bodies(options.scene);
  page.bodies.up_axis = options.up[0] - 'x';
  require_same_scene(options, page.bodies, source.scene());
  page.start = config.workspace.start;
  page.force = config.limits.force;
  page.torque = config.limits.torque;
  page.period = config.device.bus.period;
  page.hand = options.hand;
  page.source = fmt::format("{}, {}", options.follow.empty() ? "simulated arm" : "telemetry of another process",
                            fs::path(options.controller).filename().string());
  return live_page(page, fs::path(options.scene).stem().string(), script);
}

/// The page's side of the connection between source and viewers.
class Desk {
 public:
  Desk(const Options& options, const firmware::ControllerConfig& config)
      : options_(options),
        source_(make_source(options, config)),
        message_(source_->scene(), source_->placement()),
        token_(live::make_token()),
        server_({options.listen, options.port, make_page(options, config, *source_), token_},
                {[this](auto viewer, auto message) { return answer(viewer, message); },
                 [this](auto viewer) { leave(viewer); }}) {}

  std::string address() const {
    const bool everywhere = options_.listen == "0.0.0.0";
    return fmt::format("http://{}:{}/?token={}", everywhere ? "ADDRESS-OF-THIS-MACHINE" : options_.listen,
                       server_.port(), token_);
  }

  void run() {
    constexpr std::int64_t kInterval_us = 16'000;
    std::exception_ptr error;  // kept, because the server's library cannot pass it on
    server_.run(kInterval_us, [&] {
      try {
        return tick();
      } catch (...) {
        error = std::current_exception();
        return false;
      }
    });
    if (error) std::rethrow_exception(error);
    if (const std::string failure = source_->failure(); !failure.empty()) {
      throw Failure(ExitCode::kUnavailable, failure);
    }
  }

 private:
  bool tick() {
    samples_.clear();
    source_->take(samples_);
    for (const live::LiveSample& sample : samples_) message_.add(sample);
    if (!samples_.empty() && server_.viewers() > 0) publish();
    return source_->failure().empty() && !firmware::signal_requests().end;
  }

  void publish() {
    const std::string text = message_.text(source_->settings(), source_->speed(), source_->lost());
    server_.publish([&](live::ViewerNumber viewer) {
      const char* const hand = holder_ == 0 ? "free" : holder_ == viewer ? "yours" : "other";
      return fmt::format("{},\"hand\":\"{}\",\"viewers\":{}}}", text, hand, server_.viewers());
    });
  }

  std::string answer(live::ViewerNumber viewer, std::string_view message) {
    const auto request = live::read_request(message);
    if (const auto* error = std::get_if<std::string>(&request)) return refusal(*error);
    return carry_out(viewer, std::get<live::Request>(request));
  }

  /// One viewer at a time has the hand: the first that moves it, until it releases the hand or leaves.
  std::string carry_out(live::ViewerNumber viewer, const live::Request& request) {
    const bool of_hand = std::holds_alternative<live::HandRequest>(request);
    if (of_hand && holder_ != 0 && holder_ != viewer) return refusal("another viewer has the hand");
    const std::string why_not = source_->answer(request);
    if (!why_not.empty()) return refusal(why_not);
    if (of_hand) holder_ = viewer;
    if (std::holds_alternative<live::ReleaseRequest>(request)) leave(viewer);
    return of_hand ? "" : nlohmann::json{{"type", "answer"}, {"ok", true}, {"text", ""}}.dump();
  }

  void leave(live::ViewerNumber viewer) {
    if (holder_ == viewer) holder_ = 0;
  }

  static std::string refusal(const std::string& why) {
    const nlohmann::json answer{{"type", "answer"}, {"ok", false}, {"text", why}};
    return answer.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  }

  const Options& options_;
  std::unique_ptr<live::LiveSource> source_;
  live::StateMessage message_;
  std::string token_;
  live::LiveServer server_;
  live::ViewerNumber holder_ = 0;  // of the hand; 0: nobody
  std::vector<live::LiveSample> samples_;
};

void serve(const Options& options) {
  if (options.hand && !options.follow.empty()) {
    throw Failure(ExitCode::kUsage, "--hand moves a simulated arm of its own; it does not go with --follow");
  }
  Desk desk(options, read_configuration(options));
  firmware::catch_end_signals();
  firmware::ignore_write_signals();
  fmt::print("open {}\n", desk.address());
  std::fflush(stdout);
  desk.run();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Shows a running controller as a page in the browser; with --hand the mouse is the hand.",
               "godobject-live");
  app.footer(kFooter);
  Options options;
  app.add_option("SCENE.toml", options.scene, "scene file with the meshes")->required()->type_name("");
  app.add_option("CONTROLLER.toml", options.controller, "controller file, as for godobject-controller")
      ->required()
      ->type_name("");
  app.add_option("--image", options.image, "scene image, instead of scene.image")->type_name("X.scene");
  app.add_flag("--hand", options.hand, "the mouse moves the hand of the simulated arm");
  app.add_option("--follow", options.follow, "show the controller that writes its telemetry to this folder")
      ->type_name("DIR");
  app.add_option("--port", options.port, "port of the page; 0: any free one; default: 8642")
      ->check(CLI::Range(0, 65535))
      ->option_text("NUMBER");
  app.add_option("--listen", options.listen, "address to serve on; 0.0.0.0: all; default: 127.0.0.1, this machine only")
      ->type_name("ADDRESS");
  app.add_option("--up", options.up, "axis of W that points up: x, y or z; default: z")
      ->check(CLI::IsMember({"x", "y", "z"}))
      ->option_text("x|y|z");
  app.add_option("--player", options.player, "script in the page; default: the built one")->type_name("PLAYER.js");
  return command::run(app, argc, argv, [&] { serve(options); });
}
