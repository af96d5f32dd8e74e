#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "firmware/machine/signals.h"
#include "hal/linux/monotonic_clock.h"
#include "toolchain/command_line/failure.h"
#include "toolchain/command_line/run.h"
#include "toolchain/live/foxglove_viewers.h"
#include "toolchain/live/live_page.h"
#include "toolchain/live/live_server.h"
#include "toolchain/live/page_viewers.h"
#include "toolchain/live/recorded_run.h"
#include "toolchain/live/same_scene.h"
#include "toolchain/live/simulated_run.h"
#include "toolchain/live/telemetry_follower.h"
#include "toolchain/page/player_file.h"

namespace {

using namespace godobject;
using command::ExitCode;
using command::Failure;
namespace fs = std::filesystem;

const char* const kFooter = R"(Examples:
  godobject-live bunny-plate.toml lwr-bunny-plate.toml --hand
  godobject-live bunny-plate.toml lwr-bunny-plate.toml --follow logs
  godobject-live bunny-plate.toml --replay contact.csv --image bunny-plate.scene

Prints an address; open it in a browser. The page shows both bodies, the hand, the god object, forces and contacts, the arm
and plots. Ctrl-C ends.

Without --follow the arm is simulated here, as by godobject-controller, slowed to real time. Its hand repeats
simulation.path. With --hand the mouse is the hand: drag the moving body. Solver, friction and gains can be changed
meanwhile. With --follow the page looks at a controller in another process, simulated or real, through DIR/telemetry.csv,
which links to that of its newest run. A run that begins later is followed, too. Nothing that a page does reaches that controller or any bus. With --replay the page plays an output of
godobject-replay or a telemetry.csv, again and again; with CONTROLLER.toml a telemetry shows the arm, too.

Prints a second address, ws://..., for Foxglove and Lichtblick: there choose "Open connection", "Foxglove WebSocket", and
paste the address with its token. In a 3D panel choose the display frame upright, and switch on /bodies and /force_arrow.
These programs only look. Topics: toolchain/mcap/README.md.

The page is served on this machine only, to who has the token in the address. --listen serves it to others: whoever sees
the address then sees the page, and with --hand moves the simulated arm.

Exit codes: 0 ended by a signal, 64 usage, 65 bad mesh, scene image or path, 66 an input is missing or unreadable, 69 the
port cannot be opened or the controller has stopped, 78 bad scene file or configuration.)";

struct Options {
  std::string scene, controller, image, follow, replay, player;
  std::string up = "z";
  std::string listen = "127.0.0.1";
  int port = 8642;
  bool hand = false;
};

/// The controller with the image and the folder of the command line; none if none is named.
std::optional<firmware::ControllerConfig> read_configuration(const Options& options) {
  if (options.controller.empty()) return {};
  firmware::ControllerConfig config = firmware::read_controller_file(options.controller);
  if (!options.image.empty()) config.scene.image = options.image;
  if (!options.follow.empty()) config.telemetry.folder = options.follow;
  if (config.scene.image.empty()) {
    throw Failure(ExitCode::kBadConfig,
                  fmt::format("{}: scene.image is missing; add it or give --image", options.controller));
  }
  return config;
}

/// A controller or a record with the words about it.
struct Shown {
  std::unique_ptr<live::LiveSource> source;
  live::LivePage page;  ///< without the bodies
};

Shown show_controller(const Options& options, const firmware::ControllerConfig& config) {
  Shown shown;
  if (options.follow.empty()) {
    shown.source = std::make_unique<live::SimulatedRun>(config, options.hand);
  } else {
    shown.source = std::make_unique<live::TelemetryFollower>(config);
  }
  shown.page.start = config.workspace.start;
  shown.page.force = config.limits.force;
  shown.page.torque = config.limits.torque;
  shown.page.period = config.device.bus.period;
  shown.page.hand = options.hand;
  shown.page.source = fmt::format("{}, {}", options.follow.empty() ? "simulated arm" : "telemetry of another process",
                                  fs::path(options.controller).filename().string());
  return shown;
}

Shown show_replay(const Options& options, const std::optional<firmware::ControllerConfig>& config) {
  const fs::path image = config ? config->scene.image : fs::path(options.image);
  if (image.empty()) throw Failure(ExitCode::kUsage, "--replay wants --image, or a CONTROLLER.toml with scene.image");
  auto run = std::make_unique<live::RecordedRun>(options.replay, image, config);
  Shown shown;
  shown.page.start = run->start();
  shown.page.force = run->largest_force();
  shown.page.torque = run->largest_torque();
  shown.page.source = fmt::format("replay, {}", fs::path(options.replay).filename().string());
  shown.source = std::move(run);
  return shown;
}

/// Refuses meshes that are not those of the image, as far as sizes tell.
void require_same_scene(const Options& options, const page::PageBodies& bodies, const SceneView& scene) {
  if (live::is_same_scene(bodies.bodies, scene)) return;
  throw Failure(ExitCode::kBadConfig, fmt::format("{}: its bodies have other sizes than those of the scene image; name "
                                                  "the scene file that the image was compiled from",
                                                  options.scene));
}

page::PageBodies read_bodies(const Options& options, const SceneView& scene) {
  page::PageBodies bodies = page::read_page_bodies(options.scene);
  bodies.up_axis = options.up[0] - 'x';
  require_same_scene(options, bodies, scene);
  return bodies;
}

std::string make_page(const Options& options, live::LivePage page, const page::PageBodies& bodies) {
  const std::string script = page::read_player(options.player);
  page.bodies = bodies;
  return live_page(page, fs::path(options.scene).stem().string(), script);
}

/// The connection between source and viewers.
class Desk {
 public:
  Desk(const Options& options, Shown shown)
      : options_(options),
        source_(std::move(shown.source)),
        bodies_(read_bodies(options, source_->scene())),
        pages_(*source_, clock_),
        foxglove_(bodies_.bodies, bodies_.up_axis, shown.page.force, source_->placement()),
        token_(live::make_token()),
        server_({options.listen, options.port, make_page(options, std::move(shown.page), bodies_), token_},
                {pages_, foxglove_}) {}

  /// Host, port and token, behind the scheme of an address.
  std::string address() const {
    const bool everywhere = options_.listen == "0.0.0.0";
    return fmt::format("{}:{}/?token={}", everywhere ? "ADDRESS-OF-THIS-MACHINE" : options_.listen, server_.port(),
                       token_);
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
    for (const live::LiveSample& sample : samples_) pages_.add(sample);
    const bool watched = server_.viewers() > 0;
    if (!watched) pages_.skip();
    // also while no cycles come, so that a page knows that it is connected
    const bool is_due = clock_.now_ns() - published_ns_ >= kRepeat_ns;
    if (is_due || (watched && !samples_.empty())) publish();
    return source_->failure().empty() && !firmware::signal_requests().end;
  }

  void publish() {
    published_ns_ = clock_.now_ns();
    pages_.make_state(server_.viewers());
    if (!samples_.empty()) foxglove_.show(samples_.back());
    server_.publish();
  }

  static constexpr std::int64_t kRepeat_ns = 400'000'000;

  const Options& options_;
  hal::MonotonicClock clock_;
  std::int64_t published_ns_ = 0;
  std::unique_ptr<live::LiveSource> source_;
  const page::PageBodies bodies_;
  live::PageViewers pages_;
  live::FoxgloveViewers foxglove_;
  std::string token_;
  live::LiveServer server_;
  std::vector<live::LiveSample> samples_;
};

/// Refuses options that do not go together.
void check(const Options& options) {
  if (options.hand && !options.follow.empty()) {
    throw Failure(ExitCode::kUsage, "--hand moves a simulated arm of its own; it does not go with --follow");
  }
  if (!options.replay.empty() && (options.hand || !options.follow.empty())) {
    throw Failure(ExitCode::kUsage, "--replay plays a record; it does not go with --hand or --follow");
  }
  if (options.replay.empty() && options.controller.empty()) throw CLI::RequiredError("CONTROLLER.toml or --replay");
}

void serve(const Options& options) {
  check(options);
  const std::optional<firmware::ControllerConfig> config = read_configuration(options);
  Desk desk(options, options.replay.empty() ? show_controller(options, *config) : show_replay(options, config));
  firmware::catch_end_signals();
  firmware::ignore_write_signals();
  fmt::print("open http://{0}\nor, in Foxglove or Lichtblick, ws://{0}\n", desk.address());
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
  app.add_option("CONTROLLER.toml", options.controller, "controller file, as for godobject-controller")->type_name("");
  app.add_option("--image", options.image, "scene image, instead of scene.image")->type_name("X.scene");
  app.add_flag("--hand", options.hand, "the mouse moves the hand of the simulated arm");
  app.add_option("--follow", options.follow, "show the controller that writes its telemetry to this folder")
      ->type_name("DIR");
  app.add_option("--replay", options.replay, "play an output of godobject-replay, or a telemetry.csv")
      ->type_name("REPLAY.csv");
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
