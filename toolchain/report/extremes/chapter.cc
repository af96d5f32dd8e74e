#include "toolchain/report/extremes/chapter.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <memory>
#include <random>
#include <utility>

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/files/input_file.h"
#include "toolchain/files/output_target.h"
#include "toolchain/files/work_folder.h"
#include "toolchain/report/extremes/bad_input.h"
#include "toolchain/report/extremes/bounds.h"
#include "toolchain/report/extremes/compiled_world.h"
#include "toolchain/report/extremes/rig.h"
#include "toolchain/report/extremes/rows.h"
#include "toolchain/report/extremes/run.h"
#include "toolchain/report/extremes/setup.h"
#include "toolchain/report/extremes/torque_places.h"
#include "toolchain/report/study/result_file.h"

namespace godobject::report {
namespace {

const char* const kViolations = "extremes_violations";
const char* const kCycles = "extremes_cycles";
const char* const kProperties = "extremes_properties";
constexpr std::size_t kSlenderRow = 1;         ///< of kRows; it runs a million cycles
constexpr std::size_t kBadInputRow = 3;        ///< only compiled worlds refuse invalid input
constexpr std::uint32_t kMostStretches = 200;  ///< largest number of stretches of the fuzzer, each with a seed

/// Results of a stretch of runs: the findings of its row, and a case file for each run with a violation.
class Tally {
 public:
  explicit Tally(std::string row) : row_(std::move(row)) {
    sheet_ = {.name = kViolations, .columns = {"row", "found", "case_file"}, .rows = {}};
  }

  void add(const Setup& setup, const watch::Findings& found) {
    if (setup.solver == format::Solver::kContact) contact_.add(found);
    all_.add(found);
    if (found.violations() > 0) sheet_.rows.push_back({row_, found.first(), case_file(setup, found.first())});
  }

  std::int64_t cycles() const { return all_.cycles; }

  CaseResult result() const {
    CaseResult result;
    Sheet properties{
        .name = kProperties, .columns = {"row", "property", "judged", "violated", "worst_of_bound"}, .rows = {}};
    for (std::size_t i = 0; i < watch::kPropertyCount; ++i) {
      const auto property = static_cast<watch::Property>(i);
      const watch::Tally& tally = all_[property];
      result.findings.push_back(
          judged(extremes_bound::of_property(row_, property), static_cast<double>(tally.violated), tally.first));
      properties.rows.push_back({row_, watch::describe(property), std::to_string(tally.judged),
                                 std::to_string(tally.violated), cell(tally.worst)});
    }
    Sheet cycles{
        .name = kCycles, .columns = {"row", "cycles", "cycles_of_contact", "touching", "not_converged"}, .rows = {}};
    cycles.rows.push_back({row_, std::to_string(all_.cycles), std::to_string(contact_.cycles),
                           std::to_string(contact_.touching), std::to_string(all_.not_converged)});
    result.sheets = {sheet_, cycles, properties};
    return result;
  }

 private:
  std::string row_;
  watch::Findings contact_;  ///< of the solver `contact`
  watch::Findings all_;
  Sheet sheet_;
};

/// Draws the sessions of a stretch: half of the cycles in compiled worlds, if there are any. Compiling takes as long as
/// ten thousand cycles, so a world holds many sessions.
class Sessions {
 public:
  Sessions(std::string row, bool meshes, std::uint32_t seed, std::filesystem::path work)
      : row_(std::move(row)), meshes_(meshes), random_(seed), work_(std::move(work)) {}

  /// Returns the next session; `cycles` of the stretch are left. Its world stays until the next call.
  Setup next(std::int64_t cycles) {
    Setup setup;
    if (meshes_ && compiled_ <= analytic_) {
      setup = next_compiled();
      setup.cycles = static_cast<int>(std::clamp<std::int64_t>(cycles / 2, 500, kCompiledSession));
      compiled_ += setup.cycles;
    } else {
      setup = any();
      if (setup.world == "compiled") setup.world = "heap";
      world_is_next_ = false;
      setup.cycles = static_cast<int>(std::min<std::int64_t>(setup.cycles, cycles));
      analytic_ += setup.cycles;
    }
    return setup;
  }

  std::unique_ptr<Rig> rig(const Setup& setup) const {
    return world_is_next_ ? make_rig_in(world_, setup) : make_rig(setup, work_);
  }

 private:
  static constexpr int kCompiledSession = 2'500;  // cycles
  static constexpr std::int64_t kCyclesOfAWorld = 100'000;

  Setup any() { return row_ == "fuzzer" ? any_setup(random_) : setup_of(row_, random_); }

  Setup next_compiled() {
    world_is_next_ = true;
    if (world_ != nullptr && compiled_ < world_until_) return any_session_in(of_world_, random_);
    of_world_ = any();
    choose_mesh(of_world_);
    world_ = std::make_shared<const CompiledWorld>(of_world_, work_);
    world_until_ = compiled_ + kCyclesOfAWorld;
    return of_world_;
  }

  std::string row_;
  bool meshes_;
  std::mt19937 random_;
  std::filesystem::path work_;
  Setup of_world_;
  std::shared_ptr<const CompiledWorld> world_;
  bool world_is_next_ = false;
  std::int64_t world_until_ = 0;  // cycles in compiled worlds
  std::int64_t compiled_ = 0;     // cycles drawn so far
  std::int64_t analytic_ = 0;
};

CaseResult run_row(const std::string& row, std::int64_t cycles, std::uint32_t seed, bool meshes,
                   const ExtremesFault& fault, const std::filesystem::path& work) {
  Sessions sessions(row, meshes, seed, work);
  Tally tally(row);
  while (tally.cycles() < cycles) {
    const Setup setup = sessions.next(cycles - tally.cycles());
    const auto rig = sessions.rig(setup);
    watch::Findings found = run_setup(setup, *rig);
    if (fault.violated) {
      ++found[*fault.violated].violated;
      found[*fault.violated].first = "planted";
    }
    tally.add(setup, found);
  }
  return tally.result();
}

/// Returns a sentence on the number of cycles of the rows.
std::string cycles_html(const Sheet& cycles) {
  std::int64_t all = 0;
  std::int64_t of_contact = 0;
  std::int64_t touching = 0;
  std::int64_t not_converged = 0;
  for (const auto& row : cycles.rows) {
    all += std::stoll(row[1]);
    of_contact += std::stoll(row[2]);
    touching += std::stoll(row[3]);
    not_converged += std::stoll(row[4]);
  }
  return fmt::format(
      "<p>Generated rows and fuzzer: {} cycles, {} of them of the solver <code>contact</code>, {} of these in contact. "
      "The watch's own reference did not converge {} times. The value of a row is that of its worst stretch. <a "
      "href=\"{}.csv\">All stretches</a>; <a href=\"{}.csv\">how often each property was judged</a>.</p>\n",
      all, of_contact, touching, not_converged, kCycles, kProperties);
}

Section conclude(const std::vector<CaseOutcome>& outcomes, const std::filesystem::path& folder) {
  Section section = gather(outcomes, folder);
  section.html = cycles_html(gathered(outcomes, kCycles));
  const Sheet violations = gathered(outcomes, kViolations);
  if (violations.rows.empty()) return section;
  files::make_output_folder(folder / "violations");
  section.html += "<p>Violations (<code>godobject-report --replay FILE</code> runs one again):</p>\n<ul>\n";
  for (std::size_t i = 0; i < violations.rows.size(); ++i) {
    const std::string name = fmt::format("violations/{:04}.json", i);
    write_file(folder / name, violations.rows[i][2]);
    section.html +=
        fmt::format("<li><a href=\"{0}\">{0}</a>: {1}, {2}</li>\n", name, violations.rows[i][0], violations.rows[i][1]);
  }
  section.html += "</ul>\n";
  return section;
}

/// Tells whether a stretch compiles a world, which takes seconds. The quick page, without --cycles, has few: those that
/// are `needed`.
bool compiles_a_world(const ExtremesRequest& request, bool needed) {
  return !request.one_place && (!request.quick || request.cycles > 0 || needed);
}

}  // namespace

Chapter extremes_chapter(const ExtremesRequest& request) {
  const std::int64_t cycles = request.cycles > 0  ? request.cycles
                              : request.one_place ? 300
                              : request.quick     ? 20'000
                                                  : 100'000;
  const std::int64_t row_cycles = request.one_place ? 200 : request.quick ? 2'000 : 100'000;
  const std::int64_t place_cycles = std::max<std::int64_t>(row_cycles, 1'000);
  const std::int64_t stretches = std::clamp<std::int64_t>(cycles / 5'000, 1, kMostStretches);
  const bool quick = request.quick;
  const std::int64_t long_cycles = request.one_place ? 10'000
                                   : quick           ? 100'000
                                                     : std::max<std::int64_t>(10'000'000, cycles);
  Chapter chapter{
      .name = "extremes",
      .title = "Numerical extremes",
      .introduction =
          "<p>Generated cases at numerical extremes, then random ones with fixed seeds: worlds, bodies, scales, "
          "motions, parameters. Torque rate: the whole control cycle runs on an arm that is led through places where "
          "the field jumps, with and without its supervisor; for comparison, the torques that the solvers alone would "
          "command there. For stiffness, mass and delay on the stable side of A4 see the random loops of the chapter "
          "on stability.</p>",
      .bounds = extremes_bound::all(),
      .cases = {},
      .conclude = conclude};
  const RowRequest row{quick, request.seed, request.fault, request.one_place};
  const auto add = [&](const std::string& name, const std::string& inputs,
                       std::function<CaseResult(const std::filesystem::path&)> run, double seconds) {
    chapter.cases.push_back({.name = "extremes." + name, .inputs = inputs, .run = std::move(run), .seconds = seconds});
  };
  const std::string inputs = fmt::format("quick {} seed {}", quick, request.seed);
  add(
      "bad-meshes", inputs, [row](const auto& work) { return bad_meshes(row, work); }, quick ? 10.0 : 30.0);
  add(
      "gap", inputs, [row](const auto& work) { return gap_near_the_voxel(row, work); }, quick ? 10.0 : 20.0);
  add(
      "scale", inputs, [row](const auto&) { return same_at_every_scale(row); }, quick ? 2.0 : 15.0);
  add(
      "long-run", fmt::format("{} cycles {}", inputs, long_cycles),
      [row, long_cycles](const auto&) { return long_run(long_cycles, row); }, 1e-5 * static_cast<double>(long_cycles));
  add(
      "closed-path", inputs, [row](const auto&) { return closed_path(row); }, quick ? 1.0 : 5.0);
  const std::int64_t bad_inputs = request.one_place ? 1'000 : quick ? 20'000 : 100'000;
  add(
      "bad-input", inputs, [row, bad_inputs](const auto& work) { return bad_input(bad_inputs, row.fault, work); },
      quick ? 3.0 : 10.0);
  for (std::size_t i = 0; i < kRowCount; ++i) {
    const bool meshes = compiles_a_world(request, i == kBadInputRow);
    add(
        fmt::format("row-{}", i + 1), fmt::format("{} compiled {}", inputs, meshes),
        [i, row, meshes, of_row = !quick && i == kSlenderRow ? 10 * row_cycles : row_cycles](const auto& work) {
          return run_row(kRows[i], of_row, 1000 * (row.seed + 1) + static_cast<std::uint32_t>(i), meshes, row.fault,
                         work);
        },
        quick              ? 1.0
        : i == kSlenderRow ? 100.0
                           : 15.0);
  }
  const std::filesystem::path device = request.devices / "lwr.toml";
  files::require_regular_input(device, "name the folder of the device files with --devices");
  for (std::size_t i = 0; i < kPlaceCount; ++i) {
    add(
        fmt::format("torque-{}", i + 1), fmt::format("{} device {}", inputs, file_digest(device)),
        [i, device, row, place_cycles](const auto& work) {
          return torque_rate(static_cast<Place>(i), device, place_cycles, row, work);
        },
        quick ? 3.0 : 15.0);
  }
  for (std::int64_t i = 0; i < stretches; ++i) {
    const auto seed = request.seed * kMostStretches + static_cast<std::uint32_t>(i);
    const bool meshes = compiles_a_world(request, i == 0);
    add(
        fmt::format("fuzzer-{:03}", i), fmt::format("quick {} cycles {} seed {}", quick, cycles / stretches, seed),
        [seed, row, each = cycles / stretches, meshes](const auto& work) {
          return run_row("fuzzer", each, seed, meshes, row.fault, work);
        },
        1e-4 * static_cast<double>(cycles / stretches));
  }
  return chapter;
}

bool replay(const std::filesystem::path& file) {
  files::require_regular_input(file, "name a case file of the fuzzer");
  std::ifstream stream(file);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  Setup setup;
  try {
    setup = read_case(text);
  } catch (const std::exception& error) {
    throw command::Failure(
        command::ExitCode::kBadData,
        fmt::format("{}: not a case file ({}); name one that the fuzzer wrote", file.string(), error.what()));
  }
  const files::WorkFolder work(std::filesystem::temp_directory_path() / "case");
  const auto rig = make_rig(setup, work.path());
  const watch::Findings found = run_setup(setup, *rig);
  fmt::print("{}: {} cycles, {} in contact\n", file.string(), found.cycles, found.touching);
  for (std::size_t i = 0; i < watch::kPropertyCount; ++i) {
    const auto property = static_cast<watch::Property>(i);
    const watch::Tally& tally = found[property];
    if (tally.judged == 0) continue;
    fmt::print("  {:<72} {:>9} judged, {:>6} violated, worst {:.3g} of the bound{}\n", watch::describe(property),
               tally.judged, tally.violated, tally.worst,
               tally.violated > 0 ? "; first in " + tally.first : std::string());
  }
  return found.violations() > 0;
}

}  // namespace godobject::report
