#include "toolchain/figures/arm_run.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/figures/table.h"
#include "toolchain/files/toml_file.h"
#include "toolchain/files/toml_table.h"

namespace godobject::figures {
namespace {

using command::ExitCode;
using command::Failure;
using files::TomlTable;

/// Error of the integration of the arm's motion; a push of the hand does a hundred times as much work.
constexpr double kNoWork = 1e-3;  // [J]

struct ArmClaim {
  std::string (*missed)(const ArmRun& run);  ///< the violation in words; empty: the claim holds
  std::string (*holds)(const std::vector<ArmRun>& runs);
};

double largest(const std::vector<ArmRun>& runs, double (*value)(const ArmRun&)) {
  double result = value(runs.front());
  for (const ArmRun& run : runs) result = std::max(result, value(run));
  return result;
}

std::string stopped(const ArmRun& run) {
  if (run.fault != 0) return fmt::format("fault {} ended the run", run.fault);
  if (run.last_mode != "ended") return fmt::format("the last cycle is in mode {}, not in mode ended", run.last_mode);
  return run.interrupted ? "rendering was interrupted or did not start" : "";
}

std::string penetration(const ArmRun& run) {
  const Statistics& s = run.statistics;
  if (s.contact_cycles == 0) return "there was no contact";
  if (s.penetration_max <= 0.0) return "";
  return fmt::format("a sample point of the god object is {} {:.3f} mm, {:.2f} voxels, inside, at {:.3f} s",
                     s.depth_is_bound ? "at least" : "up to", 1e3 * s.penetration_max,
                     s.penetration_max / run.voxel_size, s.penetration_at);
}

std::string pop_through(const ArmRun& run) {
  if (!run.crossing || run.crossing->distance < run.voxel_size) return "";
  return fmt::format("the god object goes {:.1f} mm behind the surface, at {:.3f} s", 1e3 * run.crossing->distance,
                     run.crossing->t);
}

std::string torque(const ArmRun& run) {
  if (run.torque <= 1.0) return "";
  return fmt::format("the torque of joint {} is {:.0f} % of its limit", run.torque_joint, 1e2 * run.torque);
}

std::string work(const ArmRun& run) {
  if (run.least_work >= -kNoWork) return "";
  return fmt::format("the hand received {:.4f} J more work than it did", -run.least_work);
}

constexpr ArmClaim kArmClaims[] = {
    {stopped,
     [](const std::vector<ArmRun>&) { return std::string("rendering without interruption, end without a fault"); }},
    {penetration,
     [](const std::vector<ArmRun>& runs) {
       return fmt::format("no sample point inside, the nearest is {:.4f} mm from the surface",
                          -1e3 * largest(runs, [](const ArmRun& r) { return r.statistics.penetration_max; }));
     }},
    {pop_through,
     [](const std::vector<ArmRun>& runs) {
       const bool shown = std::any_of(runs.begin(), runs.end(), [](const ArmRun& r) { return r.crossing.has_value(); });
       return std::string(shown ? "no pop-through" : "");
     }},
    {torque,
     [](const std::vector<ArmRun>& runs) {
       return fmt::format("joint torques of at most {:.0f} % of their limits",
                          1e2 * largest(runs, [](const ArmRun& r) { return r.torque; }));
     }},
    {work, [](const std::vector<ArmRun>&) { return std::string("the hand never receives more work than it did"); }},
};

std::vector<double> torque_limits(const std::filesystem::path& device) {
  constexpr TomlTable::Range kPositive{1e-6, 1e6};
  std::vector<double> limits;
  const toml::table root = files::parse_toml_file(device);
  for (const TomlTable& joint : TomlTable::each(root, "joint", device))
    limits.push_back(joint.number("torque", kPositive));
  return limits;
}

void add_work(const std::vector<HandWork>& hand, double begin, double end, ArmRun& run) {
  const auto first = std::find_if(hand.begin(), hand.end(), [&](const HandWork& row) { return row.t >= begin; });
  if (first == hand.end()) return;
  for (auto row = first; row != hand.end() && row->t <= end; ++row) {
    run.work = row->work - first->work;
    run.least_work = std::min(run.least_work, run.work);
  }
}

}  // namespace

ArmLog read_arm_log(const std::filesystem::path& folder, const std::filesystem::path& device) {
  ArmLog log{read_telemetry_log(folder / "telemetry.csv"), read_hand_log(folder / "hand.csv"), torque_limits(device)};
  const std::size_t joints = log.cycles.front().torque.size();
  if (joints != log.torque_limits.size()) {
    throw Failure(ExitCode::kBadData, fmt::format("{}: has {} joints, {} has {}; name the device file of this arm",
                                                  device.string(), log.torque_limits.size(), folder.string(), joints));
  }
  return log;
}

ArmRun arm_run(const ArmLog& log, double band) {
  ArmRun run;
  const ReplayLog cycles = rendered(log.cycles);
  run.statistics = statistics(cycles, band);
  run.seconds = log.cycles.back().cycle.t - log.cycles.front().cycle.t;
  run.last_mode = log.cycles.back().mode;
  int begun = 0;
  bool rendering = false;
  for (const TelemetryRow& row : log.cycles) {
    if (run.fault == 0) run.fault = row.fault;
    if (row.share > 0.0 && !rendering) ++begun;
    rendering = row.share > 0.0;
    for (std::size_t i = 0; i < row.torque.size(); ++i) {
      const double share = std::abs(row.torque[i]) / log.torque_limits[i];
      if (share <= run.torque) continue;
      run.torque = share;
      run.torque_joint = static_cast<int>(i) + 1;
    }
  }
  run.interrupted = begun != 1;
  for (const ReplayRow& row : cycles)
    run.distance = std::max(run.distance, (row.H_WS.translation - row.H_WD.translation).norm());
  if (!cycles.empty()) add_work(log.hand, cycles.front().t, cycles.back().t, run);
  return run;
}

std::vector<std::string> judge_arm_runs(const std::vector<ArmRun>& runs) {
  std::vector<std::string> sentences;
  if (runs.empty()) return sentences;
  std::vector<std::string> holds;
  for (const ArmClaim& claim : kArmClaims) {
    const std::size_t before = sentences.size();
    for (const ArmRun& run : runs) {
      const std::string what = claim.missed(run);
      if (!what.empty()) sentences.push_back(fmt::format("MISSED {}, closed loop: {}", run.name, what));
    }
    std::string word = sentences.size() == before ? claim.holds(runs) : "";
    if (!word.empty()) holds.push_back(std::move(word));
  }
  sentences.push_back(fmt::format("HOLDS in every scene, closed loop: {}",
                                  holds.empty() ? "none of the claims" : fmt::format("{}", fmt::join(holds, "; "))));
  return sentences;
}

const std::vector<ArmColumn>& arm_columns() {
  static const std::vector<ArmColumn> kColumns = {
      {"closed loop", [](const ArmRun& r) { return r.name; }, true},
      {"ended", [](const ArmRun& r) { return r.fault == 0 ? r.last_mode : fmt::format("fault {}", r.fault); }, true},
      {"s", [](const ArmRun& r) { return fmt::format("{:.1f}", r.seconds); }},
      {"in contact", [](const ArmRun& r) { return fmt::format("{}", r.statistics.contact_cycles); }},
      {"depth mm", [](const ArmRun& r) { return fmt::format("{:.3f}", 1e3 * r.statistics.penetration_max); }, true},
      {"behind mm",
       [](const ArmRun& r) {
         return r.crossing ? fmt::format("{:.3f}", 1e3 * r.crossing->distance) : std::string("-");
       }},
      {"device mm", [](const ArmRun& r) { return fmt::format("{:.1f}", 1e3 * r.distance); }},
      {"force N", [](const ArmRun& r) { return fmt::format("{:.1f}", r.statistics.peak_force); }, true},
      {"step N", [](const ArmRun& r) { return fmt::format("{:.1f}", r.statistics.force_step); }},
      {"cut", [](const ArmRun& r) { return fmt::format("{}", r.statistics.cut); }},
      {"ovf", [](const ArmRun& r) { return fmt::format("{}", r.statistics.overflow); }},
      {"torque %", [](const ArmRun& r) { return fmt::format("{:.0f}", 1e2 * r.torque); }},
      {"work J", [](const ArmRun& r) { return fmt::format("{:.3f}", r.work); }},
  };
  return kColumns;
}

std::string arm_table(const std::vector<ArmRun>& runs) {
  std::vector<std::vector<std::string>> columns;
  for (const ArmColumn& column : arm_columns()) {
    columns.push_back({column.heading});
    for (const ArmRun& run : runs) columns.back().push_back(column.value(run));
  }
  return laid_out(columns) +
         "closed loop: controller on a simulated arm, a hand follows the path, solver contact; device: largest\n"
         "distance of the god object from the device; torque: largest share of a joint's limit; work: done by the "
         "hand\n";
}

}  // namespace godobject::figures
