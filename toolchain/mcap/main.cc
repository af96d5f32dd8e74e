#include <string>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "toolchain/command_line/run.h"
#include "toolchain/files/atomic_file.h"
#include "toolchain/files/output_target.h"
#include "toolchain/mcap/mcap_writer.h"
#include "toolchain/mcap/record.h"
#include "toolchain/viewer/scene_bodies.h"

namespace {

const char* const kFooter = R"(Examples:
  godobject-mcap bunny-teapot.toml contact.csv -o contact.mcap --up y
  godobject-mcap bunny-teapot.toml logs/telemetry.csv -o arm.mcap --up y

The record is for Foxglove, PlotJuggler, Rerun and the tools of ROS 2. Of a telemetry.csv it has all cycles, also those that
rendered nothing. Topics, and the display frame upright for a 3D view: toolchain/mcap/README.md.

Exit codes: 0 done, 64 usage, 65 bad mesh or replay, 66 an input is missing or unreadable, 74 cannot write, 77 no permission
to write, 78 bad scene file.)";

struct Options {
  std::string scene, replay, output;
  std::string up = "z";
};

void write_record(const Options& options) {
  godobject::files::output_target(options.output);  // refused before the work
  godobject::mcap::Recording recording;
  godobject::mcap::read_cycles(options.replay, recording);
  recording.bodies = godobject::viewer::read_scene_bodies(options.scene);
  recording.up_axis = options.up[0] - 'x';
  godobject::files::AtomicFile out(options.output);
  godobject::mcap::McapWriter writer(out);
  godobject::mcap::write_record(recording, writer);
  out.commit();
  fmt::print("{}: {} cycles, {} messages, {:.2f} MB\n", options.output, recording.cycles.size(), writer.messages(),
             1e-6 * static_cast<double>(writer.size()));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Writes a replay of a scene as a record for viewers and plotters of robot data: one MCAP file.",
               "godobject-mcap");
  app.footer(kFooter);
  Options options;
  app.add_option("SCENE.toml", options.scene, "scene file with the meshes")->required()->type_name("");
  app.add_option("REPLAY.csv", options.replay, "output of godobject-replay, or a telemetry.csv of godobject-controller")
      ->required()
      ->type_name("");
  app.add_option("-o,--output", options.output, "record to write")->required()->type_name("RECORD.mcap");
  app.add_option("--up", options.up, "axis of W that points up: x, y or z; default: z")
      ->check(CLI::IsMember({"x", "y", "z"}))
      ->option_text("x|y|z");
  return godobject::command::run(app, argc, argv, [&] { write_record(options); });
}
