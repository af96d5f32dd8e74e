#include <string>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "firmware/command/run.h"
#include "toolchain/command/progress.h"
#include "toolchain/report/contact_quality/chapter.h"
#include "toolchain/report/contact_quality/table.h"
#include "toolchain/report/fault_table/chapter.h"

namespace {

const char* const kFooter = R"(Example:
  godobject-report --only contact --quick -o report
  godobject-report --only faults --tests build/release/tests -o report

Chapter `contact`: the solvers paper, corrected and contact in the same scenes along the same device paths. Writes
DIR/contact_quality.csv (a row for each scene, world, solver and quantity) and DIR/contact_summary.csv (a row for each
quantity), and prints the latter as a table. Worlds: `analytic` (exact distance), `moved` (the same, turned and shifted
by 10 m), `compiled` (through the scene compiler; lengths in s are voxel edges). A solver's figure is its worst scene;
times are medians over the scenes of each scene's median and 99th percentile, over cycles in contact, of steps #2-#7
alone unless it says whole cycle. Targets are those of `contact`; a missed one does not change the exit code.

The optimum is the pose S with all sample points at phi >= 0 that minimises |x|^2 + rho^2 |r|^2, (x, r) = log(S^-1 D),
rho^2 = k_VC,r / k_VC,x. It may be a local one: a slow, independent method is started from around the god object, from
half way to the device and from the device lifted out. `optimum_distance` is the metric distance from the god object to the
nearest optimum found; `optimum_excess` is how much further from the device it is than the best one.

Chapter `faults`: runs the test programs of --tests that inject faults into the controller, gathers what they have measured, and
writes DIR/faults.csv and DIR/faults.html: a row for each fault of the table and each test that injects it, with the reaction
that was seen, the cycles it took and those allowed: held, missed, not run or not covered. What `ctest -L hil` has left in the same
build is read, not run. Half a minute.

Exit codes: 0 done (whatever is missed), 64 usage, 65 bad mesh, 66 the bunny's mesh or a test program is missing or may not be read,
74 cannot write, 77 no right to write.)";

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Measures, and writes tables: the quality of the solvers, what the controller makes of faults.",
               "godobject-report");
  app.footer(kFooter);
  std::string chapter = "contact";
  godobject::report::ContactQualityRequest request;
  request.meshes = "toolchain/scenes/meshes";
  godobject::report::FaultTableRequest faults;
  faults.tests = "build/release/tests";
  app.add_option("--only", chapter, "chapter to make; default: contact")
      ->check(CLI::IsMember({"contact", "faults"}))
      ->option_text("CHAPTER");
  app.add_flag("--quick", request.quick, "a few scenes, short: below a minute");
  app.add_option("--scene", request.scene, "only scenes whose name holds this; default: all")->type_name("PART");
  app.add_option("--meshes", request.meshes, "folder of bunny_npm.ply, the moving body of some scenes")
      ->type_name("FOLDER")
      ->capture_default_str();
  app.add_option("--tests", faults.tests, "folder of the test programs that inject faults")
      ->type_name("FOLDER")
      ->capture_default_str();
  app.add_option("-o,--output", request.output, "folder of what is written; made where it is not there")
      ->required()
      ->type_name("DIR");
  return godobject::command::run(app, argc, argv, [&] {
    if (chapter == "faults") {
      std::vector<godobject::report::FaultRow> rows;
      {
        godobject::command::Progress progress;
        faults.output = request.output;
        faults.progress = [&](std::string_view phase, double done) { progress.show(phase, done); };
        rows = godobject::report::fault_table(faults);
      }
      fmt::print("{}\n", godobject::report::fault_summary(rows));
      return;
    }
    std::vector<godobject::report::Measurement> measurements;
    {
      godobject::command::Progress progress;
      request.progress = [&](std::string_view phase, double done) { progress.show(phase, done); };
      measurements = godobject::report::contact_quality(request);
    }
    fmt::print("{}", godobject::report::text_table(measurements));
  });
}
