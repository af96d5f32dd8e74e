#include "toolchain/report/contact_quality/table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>

namespace godobject::report {
namespace {

using format::kSolverCount;
using format::kSolverNames;
using format::Solver;

std::string number(const QuantitySpec& quantity, double value) {
  if (std::isnan(value)) return "failed";
  return fmt::format("{:.{}f}", value, quantity.decimals);
}

/// Returns a number for a file, with nine digits: a hundredth of the last shown digit does not become 0.
std::string file_number(double value) { return std::isnan(value) ? "nan" : fmt::format("{:.9g}", value); }

std::string target_text(const QuantitySpec& quantity) {
  return quantity.target ? fmt::format("{:g}", *quantity.target) : std::string("-");
}

using Row = std::vector<std::string>;

std::string aligned(const std::vector<Row>& rows, std::size_t words_at_the_end) {
  std::vector<std::string> lines(rows.size());
  const std::size_t columns = rows.front().size();
  for (std::size_t c = 0; c < columns; ++c) {
    std::size_t width = 0;
    for (const Row& row : rows) width = std::max(width, row[c].size());
    const bool words = c == 0 || c == 1 || c + words_at_the_end >= columns;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (c > 0) lines[i] += "  ";
      lines[i] += words ? fmt::format("{:<{}}", rows[i][c], width) : fmt::format("{:>{}}", rows[i][c], width);
    }
  }
  std::string text;
  for (std::string& line : lines) {
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::array<std::optional<Verdict>, kSolverCount> judge_all(const std::vector<Measurement>& measurements,
                                                           Quantity quantity) {
  std::array<std::optional<Verdict>, kSolverCount> verdicts;
  for (std::uint32_t s = 0; s < kSolverCount; ++s) verdicts[s] = judge(measurements, quantity, static_cast<Solver>(s));
  return verdicts;
}

/// Returns the explanation of the table: number of scenes, and terms.
std::string legend(const std::vector<Measurement>& measurements) {
  std::set<std::pair<std::string, std::string>> scenes;
  for (const Measurement& m : measurements) scenes.emplace(m.scene, m.world);
  return fmt::format(
      "{} scenes. Each value is that of the solver's worst scene; each time is the median over the scenes (solver:\n"
      "steps #2-#7; whole cycle: #1 too). voxels: voxel edges of the scene; mesh: measured against the exact mesh;\n"
      "field: against the stored distances; optimum: the pose nearest to the device without penetration. The targets\n"
      "are those of contact.\n",
      scenes.size());
}

constexpr auto kContact = static_cast<std::size_t>(Solver::kContact);

/// Returns the known reasons for the missed targets.
std::string reasons(const std::vector<Measurement>& measurements) {
  std::string text;
  for (const QuantitySpec& quantity : quantities()) {
    const auto verdict = judge(measurements, quantity.id, Solver::kContact);
    if (!verdict || verdict->held || quantity.if_missed == nullptr) continue;
    text += fmt::format("{} is missed: {}.\n", quantity.title, quantity.if_missed);
  }
  return text;
}

}  // namespace

std::string verdict_text(const QuantitySpec& quantity, const std::optional<Verdict>& contact) {
  if (!quantity.target) return "-";
  if (!contact) return "not run";
  if (contact->held) return "held";
  if (std::isnan(contact->value)) return "missed: a cycle failed";
  const double excess = contact->value - *quantity.target;
  const bool shown = excess >= 0.5 * std::pow(10.0, -quantity.decimals);
  const std::string by = shown ? number(quantity, excess) : fmt::format("{:.1e}", excess);
  return fmt::format("missed by {}{}{}", by, *quantity.unit != '\0' ? " " : "", quantity.unit);
}

std::string text_table(const std::vector<Measurement>& measurements) {
  std::vector<Row> rows = {{"quantity", "unit", "target"}};
  for (const char* solver : kSolverNames) rows.front().push_back(solver);
  rows.front().insert(rows.front().end(), {"verdict on contact", "worst scene of contact"});
  for (const QuantitySpec& quantity : quantities()) {
    const auto verdicts = judge_all(measurements, quantity.id);
    if (std::none_of(verdicts.begin(), verdicts.end(), [](const auto& v) { return v.has_value(); })) continue;
    Row row = {quantity.title, quantity.unit, target_text(quantity)};
    for (const auto& verdict : verdicts) row.push_back(verdict ? number(quantity, verdict->value) : std::string("-"));
    row.push_back(verdict_text(quantity, verdicts[kContact]));
    row.push_back(verdicts[kContact] && !quantity.median ? verdicts[kContact]->worst_scene : std::string());
    rows.push_back(std::move(row));
  }
  return aligned(rows, 2);
}

std::string notes(const std::vector<Measurement>& measurements) { return reasons(measurements) + legend(measurements); }

std::string summary_csv(const std::vector<Measurement>& measurements) {
  std::string text = "quantity,unit,target";
  for (const char* solver : kSolverNames) text += fmt::format(",{}", solver);
  for (const char* solver : kSolverNames) text += fmt::format(",{}_worst_scene", solver);
  text += ",verdict\n";
  for (const QuantitySpec& quantity : quantities()) {
    const auto verdicts = judge_all(measurements, quantity.id);
    text += fmt::format("{},{},{}", quantity.key, quantity.unit,
                        quantity.target ? fmt::format("{:g}", *quantity.target) : std::string());
    for (const auto& verdict : verdicts)
      text += fmt::format(",{}", verdict ? file_number(verdict->value) : std::string());
    for (const auto& verdict : verdicts) text += fmt::format(",{}", verdict ? verdict->worst_scene : std::string());
    text += fmt::format(",{}\n", verdict_text(quantity, verdicts[kContact]));
  }
  return text;
}

std::string measurements_csv(const std::vector<Measurement>& measurements) {
  std::string text = "scene,world,solver,quantity,unit,value,target,verdict\n";
  for (const Measurement& m : measurements) {
    const QuantitySpec& quantity = spec(m.quantity);
    const char* verdict = !quantity.target ? "-" : m.value <= *quantity.target ? "held" : "missed";
    text += fmt::format("{},{},{},{},{},{},{},{}\n", m.scene, m.world, kSolverNames[static_cast<std::size_t>(m.solver)],
                        quantity.key, quantity.unit, file_number(m.value),
                        quantity.target ? fmt::format("{:g}", *quantity.target) : std::string(), verdict);
  }
  return text;
}

}  // namespace godobject::report
