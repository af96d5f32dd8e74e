#include "toolchain/figures/table.h"

#include <algorithm>

#include <fmt/format.h>

namespace godobject::figures {
namespace {

constexpr const char* kColumnsExplained =
    "depth: deepest sample point in contact (below 0: none inside); behind: distance behind the plate; step: largest\n"
    "change of the force in a cycle; points: colliding points (paper, corrected) or rows with a force (contact);\n"
    "cycles that were cut, had an overflow (ovf), were infeasible (inf) or took over 1 ms; times of #1 and #2-#7 in us";

std::string us(double time) { return fmt::format("{:.2f}", time); }

/// Returns the largest depth of a sample point [mm]; negative: none was inside.
std::string depth(const Entry& e) { return fmt::format("{:.3f}", 1e3 * e.statistics.penetration_max); }

/// Returns the largest distance behind the scene's barrier [mm], or "-".
std::string behind(const Entry& e) {
  return e.crossing ? fmt::format("{:.3f}", 1e3 * e.crossing->distance) : std::string("-");
}

}  // namespace

const std::vector<Column>& columns() {
  static const std::vector<Column> kColumns = {
      {"scene", "scene", [](const Entry& e) { return e.scene; }, "scene", true},
      {"solver", "solver", [](const Entry& e) { return e.solver; }, "solver", true},
      {"depth [mm]", "penetration_max_mm", depth, "depth mm", true},
      {"mean depth [mm]", "penetration_mean_mm",
       [](const Entry& e) { return fmt::format("{:.3f}", 1e3 * e.statistics.penetration_mean); }},
      {"depth [voxels]", "penetration_max_voxels",
       [](const Entry& e) { return fmt::format("{:.2f}", e.statistics.penetration_max / e.voxel_size); }},
      {"mean depth [voxels]", "penetration_mean_voxels",
       [](const Entry& e) { return fmt::format("{:.2f}", e.statistics.penetration_mean / e.voxel_size); }},
      {"deeper than stored", "penetration_at_band",
       [](const Entry& e) { return std::string(e.statistics.depth_is_bound ? "yes" : "no"); }},
      {"behind [mm]", "furthest_behind_barrier_mm", behind, "behind mm"},
      {"force [N]", "peak_force_n", [](const Entry& e) { return fmt::format("{:.1f}", e.statistics.peak_force); },
       "force N", true},
      {"force step [N]", "largest_force_step_n",
       [](const Entry& e) { return fmt::format("{:.1f}", e.statistics.force_step); }, "step N"},
      {"points", "peak_contacts", [](const Entry& e) { return fmt::format("{:.0f}", e.statistics.peak_contacts); },
       "points"},
      {"cut", "cycles_cut", [](const Entry& e) { return fmt::format("{}", e.statistics.cut); }, "cut"},
      {"overflow", "cycles_overflow", [](const Entry& e) { return fmt::format("{}", e.statistics.overflow); }, "ovf"},
      {"infeasible", "cycles_infeasible", [](const Entry& e) { return fmt::format("{}", e.statistics.infeasible); },
       "inf"},
      {"#1 p50 [us]", "step1_p50_us", [](const Entry& e) { return us(e.statistics.step1.p50); }, "#1 p50"},
      {"#1 p99 [us]", "step1_p99_us", [](const Entry& e) { return us(e.statistics.step1.p99); }},
      {"#1 max [us]", "step1_max_us", [](const Entry& e) { return us(e.statistics.step1.max); }},
      {"#2-#7 p50 [us]", "solve_p50_us", [](const Entry& e) { return us(e.statistics.solve.p50); }, "#2-#7 p50"},
      {"#2-#7 p99 [us]", "solve_p99_us", [](const Entry& e) { return us(e.statistics.solve.p99); }, "p99"},
      {"#2-#7 max [us]", "solve_max_us", [](const Entry& e) { return us(e.statistics.solve.max); }},
      {"cycles over 1 ms", "cycles_over_1ms", [](const Entry& e) { return fmt::format("{}", e.statistics.over_1ms); },
       ">1ms"},
  };
  return kColumns;
}

std::string laid_out(const std::vector<std::vector<std::string>>& columns) {
  std::vector<std::string> lines(columns.front().size());
  for (std::size_t column = 0; column < columns.size(); ++column) {
    std::size_t width = 0;
    for (const std::string& cell : columns[column]) width = std::max(width, cell.size());
    const bool words = column < 2;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const std::string& cell = columns[column][i];
      if (column > 0) lines[i] += "  ";
      lines[i] += words ? fmt::format("{:<{}}", cell, width) : fmt::format("{:>{}}", cell, width);
    }
  }
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

std::string text_table(const std::vector<Entry>& entries) {
  std::vector<std::vector<std::string>> narrow;
  for (const Column& column : columns()) {
    if (column.narrow == nullptr) continue;
    narrow.push_back({column.narrow});
    for (const Entry& entry : entries) narrow.back().push_back(column.value(entry));
  }
  return laid_out(narrow) + kColumnsExplained + "\n";
}

std::string csv_table(const std::vector<Entry>& entries) {
  std::string text;
  for (const Column& column : columns()) text += fmt::format("{}{}", text.empty() ? "" : ",", column.name);
  text += "\n";
  for (const Entry& entry : entries) {
    for (const Column& column : columns())
      text += fmt::format("{}{}", &column == &columns().front() ? "" : ",", column.value(entry));
    text += "\n";
  }
  return text;
}

}  // namespace godobject::figures
