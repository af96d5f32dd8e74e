#include "firmware/controller/explain_command.h"

#include <filesystem>

#include <fmt/format.h>

#include "firmware/incidents/explanation.h"
#include "firmware/incidents/incident_plot.h"
#include "firmware/incidents/incident_reader.h"
#include "toolchain/files/atomic_file.h"

namespace godobject::firmware {
namespace {

const char* const kExplainFooter = R"(Examples:
  godobject-controller explain logs
  godobject-controller explain logs/20261130T143055Z/incident -o stop.svg

FOLDER is the record of a run or of an incident. Of a run with incidents the last one is explained, of a folder of runs the newest
run. Says when the arm stopped, the fault and its joint, the modes before, the largest values of the last 100 ms beside their
bounds, and what to look at. Draws the last 2 s before the stop and half a second after it as FOLDER/incident.svg: force at the
hand, torques of the joints, speed of the hand, lateness of waking. A run without a fault is not drawn.

Exit codes: 0 done, 64 usage, 65 telemetry.csv is no telemetry or has no row, 66 the folder or its telemetry.csv is missing or
cannot be read, 74 cannot write the plot.)";

}  // namespace

ExplainCommand::ExplainCommand(CLI::App& app)
    : command_(app.add_subcommand("explain", "says why the arm stopped in a run, and draws it")) {
  command_->footer(kExplainFooter);
  command_->add_option("FOLDER", folder_, "folder of a run or of an incident")->required()->type_name("");
  command_->add_option("-o,--output", output_, "file for the plot; default: FOLDER/incident.svg")->type_name("SVG");
}

void ExplainCommand::run() const {
  const Incident incident = read_incident(folder_);
  fmt::print("{}", explain(incident));
  if (!incident.stop) return;
  const std::filesystem::path output =
      output_.empty() ? incident.folder / "incident.svg" : std::filesystem::path(output_);
  if (output_.empty() && std::filesystem::is_symlink(output)) {  // whoever records may not choose what this overwrites
    throw command::Failure(command::ExitCode::kIo,
                           output.string() + " is a link, which is not followed; remove it, or name a file with -o");
  }
  files::AtomicFile file(output);
  file.write(draw(incident));
  file.commit();
  fmt::print("plot: {}\n", output.string());
}

}  // namespace godobject::firmware
