#include "toolchain/report/work_precision/chapter.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "toolchain/figures/gnuplot.h"
#include "toolchain/files/html_text.h"
#include "toolchain/files/input_file.h"
#include "toolchain/precision/pareto.h"
#include "toolchain/report/study/plot.h"
#include "toolchain/report/study/result_file.h"
#include "toolchain/report/work_precision/bounds.h"
#include "toolchain/report/work_precision/settings_tried.h"

namespace godobject::report {
namespace {

constexpr double kChosenBelow_us = 0.9 * kBudget_us;  ///< a second measurement may differ
constexpr std::size_t kKeyColumns = 9;

/// A setting of a scene with all measured values, by the names of the columns.
using Measured = std::map<std::string, std::string>;

double value(const Measured& row, const std::string& column) { return number(row.at(column)); }

/// Returns the rows of both sheets, joined by their setting.
std::vector<Measured> joined(const Sheet& errors, const Sheet& costs) {
  const auto key = [](const std::vector<std::string>& row) {
    return std::vector<std::string>(row.begin(), row.begin() + kKeyColumns);
  };
  std::map<std::vector<std::string>, const std::vector<std::string>*> cost_of;
  for (const auto& row : costs.rows) cost_of[key(row)] = &row;
  std::vector<Measured> all;
  for (const auto& row : errors.rows) {
    const auto cost = cost_of.find(key(row));
    if (cost == cost_of.end()) continue;
    Measured measured;
    for (std::size_t i = 0; i < row.size(); ++i) measured[errors.columns[i]] = row[i];
    for (std::size_t i = kKeyColumns; i < cost->second->size(); ++i) measured[costs.columns[i]] = (*cost->second)[i];
    all.push_back(std::move(measured));
  }
  return all;
}

std::string words(const Measured& row) {
  return fmt::format("{}, friction {}, voxel {} mm, {}, {}, {} points, {} levels, margin {} um", row.at("solver"),
                     row.at("friction"), row.at("voxel_mm"), row.at("refined") == "yes" ? "refined" : "not refined",
                     row.at("both_directions") == "yes" ? "both directions" : "one direction", row.at("points"),
                     row.at("levels"), row.at("margin_um"));
}

/// The settings of one scene with friction, and their Pareto front.
struct Field {
  std::string scene;
  std::vector<Measured> rows;
  std::vector<precision::Trade> trades;  ///< p99 [us] against relative error of the wrench
  std::vector<std::size_t> front;

  Field(std::string name, const std::vector<Measured>& all) : scene(std::move(name)) {
    for (const Measured& row : all) {
      if (row.at("scene") != scene || row.at("friction") != "on") continue;
      rows.push_back(row);
      trades.push_back({value(row, "p99_us"), value(row, "wrench_error")});
    }
    front = precision::pareto_front(trades);
  }

  std::optional<std::size_t> best(const std::string& solver, double budget_us) const {
    std::vector<precision::Trade> chosen = trades;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (!solver.empty() && rows[i].at("solver") != solver) chosen[i] = {HUGE_VAL, HUGE_VAL};
    }
    return precision::best_within(chosen, budget_us);
  }
};

char letter(std::size_t i) { return static_cast<char>('A' + i % 26); }

/// Tells if letters at two points of a picture of `all` with logarithmic axes would overlap.
bool are_near(const precision::Trade& one, const precision::Trade& other, const std::vector<precision::Trade>& all) {
  constexpr double kShare = 0.05;  // of an axis
  const auto share = [&](double precision::Trade::*axis) {
    const auto [least, most] =
        std::minmax_element(all.begin(), all.end(), [&](const auto& a, const auto& b) { return a.*axis < b.*axis; });
    return std::abs(std::log(one.*axis / other.*axis)) / std::log((*most).*axis / (*least).*axis);
  };
  return !(share(&precision::Trade::cost) > kShare) && !(share(&precision::Trade::error) > kShare);
}

/// Returns a picture of `quantity` against p99 with its own front; the letters are those of the wrench's front.
Picture picture(const Field& field, const std::string& quantity, double scale, const std::string& y,
                const std::string& caption) {
  constexpr double kLeast = 1e-4;  // a 0 is drawn here, at the bottom of the logarithmic axis
  Plot plot{.title = field.scene + ", with friction",
            .x = "p99 of a cycle [us]",
            .y = y,
            .log_x = true,
            .log_y = true,
            .curves = {}};
  std::vector<precision::Trade> trades;
  for (std::size_t i = 0; i < field.rows.size(); ++i) {
    trades.push_back({field.trades[i].cost, std::max(kLeast, scale * value(field.rows[i], quantity))});
  }
  for (std::size_t s = 0; s < format::kSolverCount; ++s) {
    Curve curve{format::kSolverNames[s], fmt::format("points pt {} ps 1.4 {}", 5 + 2 * s, color(s)), {}};
    for (std::size_t i = 0; i < trades.size(); ++i) {
      if (field.rows[i].at("solver") == curve.title) curve.points.emplace_back(trades[i].cost, trades[i].error);
    }
    plot.curves.push_back(std::move(curve));
  }
  Curve front{"Pareto front", "lines lw 2 dt 2 " + color(6), {}};
  for (const std::size_t i : precision::pareto_front(trades))
    front.points.emplace_back(trades[i].cost, trades[i].error);
  plot.curves.push_back(std::move(front));
  for (std::size_t k = 0; k < field.front.size();) {
    const precision::Trade& at = trades[field.front[k]];
    std::string letters(1, letter(k));
    while (++k < field.front.size() && are_near(at, trades[field.front[k]], trades)) letters += letter(k);
    plot.settings += fmt::format("set label {} at {:.9g},{:.9g} offset 0.6,0.6 noenhanced\n", figures::quoted(letters),
                                 at.cost, at.error);
  }
  plot.settings += fmt::format("set arrow from {0},graph 0 to {0},graph 1 nohead dt 3 {1}\n", kBudget_us, color(6));
  return {"work_precision_" + field.scene + "_" + quantity, caption,
          [plot](const std::filesystem::path& png) { return gnuplot_text(plot, png); }};
}

std::string front_table(const Field& field) {
  std::string html = "<div class=\"wide\"><table><tr><th></th><th>setting</th>";
  for (const char* const head : {"p50 [us]", "p99 [us]", "max [us]", "instructions", "wrench error [%]",
                                 "wrench error [N]", "force direction [deg]", "deepest penetration [mm]",
                                 "penetration, rms [mm]", "friction ratio", "chatter [N]", "image [MB]"}) {
    html += fmt::format("<th class=\"number\">{}</th>", head);
  }
  html += "</tr>\n";
  for (std::size_t k = 0; k < field.front.size(); ++k) {
    const Measured& row = field.rows[field.front[k]];
    const auto number_of = [&](const char* column, double scale) {
      const double measured = scale * value(row, column);
      return std::isnan(measured) ? std::string("-") : fmt::format("{:.3g}", measured);
    };
    html += fmt::format("<tr><td>{}</td><td>{}</td>", letter(k), files::html_text(words(row)));
    for (const auto& [column, scale] :
         std::initializer_list<std::pair<const char*, double>>{{"p50_us", 1.0},
                                                               {"p99_us", 1.0},
                                                               {"max_us", 1.0},
                                                               {"instructions_a_cycle", 1.0},
                                                               {"wrench_error", 100.0},
                                                               {"wrench_error_N", 1.0},
                                                               {"force_direction_rad", 180.0 / M_PI},
                                                               {"penetration_deepest_mm", 1.0},
                                                               {"penetration_rms_mm", 1.0},
                                                               {"friction_ratio", 1.0},
                                                               {"chatter_N", 1.0},
                                                               {"image_bytes", 1e-6}}) {
      html += fmt::format("<td class=\"number\">{}</td>", number_of(column, scale));
    }
    html += "</tr>\n";
  }
  return html + "</table></div>\n";
}

/// Judges the recommended setting: its cost in a second measurement, and its errors.
void judge_chosen(const Field& field, const std::optional<std::size_t>& chosen, Section& section) {
  const auto measured = [&](const char* column) { return chosen ? value(field.rows[*chosen], column) : std::nan(""); };
  const std::string where = chosen ? words(field.rows[*chosen]) : "all settings cost more";
  const ErrorBounds bounds = error_bounds(field.scene, kRecommended, true);
  section.findings.push_back(judged(cost_bound(field.scene), measured("p99_again_us"), where));
  section.findings.push_back(judged(bounds.force, 100.0 * measured("force_error"), where));
  section.findings.push_back(judged(bounds.torque, 100.0 * measured("torque_error"), where));
  section.findings.push_back(judged(bounds.penetration, measured("penetration_deepest_mm"), where));
}

/// Compares the best setting of `contact` under the budget with the best one of `paper` at no more than its cost; if
/// all of `paper` cost more, with the best of them.
void compare_with_paper(const Field& field, Section& section) {
  const auto contact = field.best("contact", kChosenBelow_us);
  if (!contact) return;
  auto paper = field.best("paper", field.trades[*contact].cost);
  if (!paper) paper = field.best("paper", HUGE_VAL);
  if (!paper) return;
  section.findings.push_back(judged(paper_bound(field.scene), field.trades[*contact].error / field.trades[*paper].error,
                                    words(field.rows[*paper])));
}

/// Returns the section on the setting under the budget, compared with those of `paper`.
void recommend(const Field& field, Section& section) {
  const auto chosen = field.best("", kChosenBelow_us);
  judge_chosen(field, chosen, section);
  compare_with_paper(field, section);
  if (!chosen) {
    section.html += fmt::format(
        "<p><b>{}: no setting stays under a budget of {:g} us a cycle</b>; run times are those of this machine and "
        "of what runs beside.</p>\n",
        files::html_text(field.scene), kBudget_us);
    return;
  }
  const double error = field.trades[*chosen].error;
  std::string html = fmt::format(
      "<p><b>{}: under a budget of {:g} us a cycle, use {}</b>: p99 {:.3g} us, wrench error {:.3g} % of the reference, "
      "deepest penetration {:.3g} mm.",
      files::html_text(field.scene), kBudget_us, files::html_text(words(field.rows[*chosen])),
      field.trades[*chosen].cost, 100.0 * error, value(field.rows[*chosen], "penetration_deepest_mm"));
  if (const auto paper = field.best("paper", field.trades[*chosen].cost)) {
    const double of_paper = field.trades[*paper].error;
    html += fmt::format(" The paper's solver at no more than the same cost has {:.3g} %, {:.3g} times as much ({}).",
                        100.0 * of_paper, of_paper / error, files::html_text(words(field.rows[*paper])));
  } else if (const auto cheapest = field.best("paper", HUGE_VAL)) {
    html += fmt::format(" The paper's solver costs more in every setting; its best has {:.3g} % at {:.3g} us.",
                        100.0 * field.trades[*cheapest].error, field.trades[*cheapest].cost);
  }
  section.html += html + "</p>\n";
}

/// Returns the approximate time to compile and judge an image [s].
double seconds(const ImageTrial& trial) {
  const precision::ImageSetting& image = trial.image.setting;
  const double judged = trial.quick ? 5.0 : 15.0;
  return judged + (image.refined ? 20.0 : 5.0) + (image.both_directions ? 40.0 : 0.0);
}

Section conclude(const std::vector<CaseOutcome>& outcomes, const std::filesystem::path& folder) {
  Section section = gather(outcomes, folder);
  const std::vector<Measured> all = joined(gathered(outcomes, kErrors), gathered(outcomes, kCosts));
  for (const PrecisionScene& scene : precision_scenes()) {
    const Field field(scene.name, all);
    if (field.rows.empty()) continue;
    section.pictures.push_back(picture(field, "wrench_error", 100.0, "wrench error [% of the reference]",
                                       field.scene +
                                           ": error of the wrench relative to the solver contact on the exact meshes. "
                                           "Letters: rows of the table below. Dotted: 20 us."));
    section.pictures.push_back(picture(field, "penetration_deepest_mm", 1.0, "deepest penetration [mm]",
                                       field.scene +
                                           ": deepest point of either body in the other's exact mesh; at the bottom: "
                                           "0.1 um or less. Letters: those of the picture above."));
    recommend(field, section);
    section.html += front_table(field);
  }
  for (const Measured& row : all) {
    if (value(row, "load") <= 1.5) continue;
    section.html += "<p>Other programs ran on the machine, so the times are indicative only.</p>\n";
    break;
  }
  section.html +=
      "<p>All settings: <a href=\"work_precision_errors.csv\">errors</a>, <a "
      "href=\"work_precision_costs.csv\">costs</a>.</p>\n";
  return section;
}

}  // namespace

Chapter work_precision_chapter(const WorkPrecisionRequest& request) {
  Chapter chapter{
      .name = "precision",
      .title = "Error against run time",
      .introduction =
          "<p>Settings that a user may choose, along the scenes' motions. The reference is the solver "
          "<code>contact</code> on the exact distances to both meshes, without voxels. The wrench error is the rms of "
          "the difference over the rms of the reference, with torques in the coupling's metric. The time of a cycle is "
          "the median of interleaved passes.</p>",
      .bounds = precision_bounds(),
      .cases = {},
      .conclude = conclude};
  for (const PrecisionScene& scene : precision_scenes()) {
    if (request.quick && scene.name != "bunny-teapot") continue;
    const std::filesystem::path file = request.scenes / (scene.name + ".toml");
    const std::filesystem::path motion = request.scenes / "paths" / scene.path;
    for (const auto& input : {file, motion}) {
      files::require_regular_input(input,
                                   "name the folder of the scenes with --scenes; the sources have toolchain/scenes");
    }
    const scene_compiler::SceneConfig config = scene_compiler::read_scene_config(file);
    const std::string inputs =
        fmt::format("scene {} meshes {} {} motion {}", file_digest(file), file_digest(config.still.file),
                    file_digest(config.moving.file), file_digest(motion));
    for (const TriedImage& image :
         tried_images(precision::image_setting(config), request.quick, scene.finest_refined)) {
      const ImageTrial trial{scene, image, request.scenes, request.kept, inputs, request.quick, request.fault};
      const std::string name = fmt::format("precision.{}-{}", scene.name, image.name);
      const std::string of_case = fmt::format("quick {} {}", request.quick, inputs);
      chapter.cases.push_back({.name = name,
                               .inputs = of_case,
                               .run = [trial](const auto&) { return image_errors(trial); },
                               .seconds = seconds(trial)});
      chapter.cases.push_back({.name = name + "-times",
                               .inputs = of_case,
                               .run = [trial](const auto&) { return image_costs(trial); },
                               .seconds = 3.0,
                               .takes_times = true});
    }
  }
  return chapter;
}

}  // namespace godobject::report
