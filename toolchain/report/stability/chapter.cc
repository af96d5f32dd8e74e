#include "toolchain/report/stability/chapter.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "toolchain/report/study/plot.h"

namespace godobject::report {
namespace {

std::size_t column(const Sheet& sheet, const std::string& name) {
  return static_cast<std::size_t>(std::find(sheet.columns.begin(), sheet.columns.end(), name) - sheet.columns.begin());
}

/// Points of two columns for each text of a third, ascending in x.
std::map<std::string, std::vector<std::pair<double, double>>> by(const Sheet& sheet, const std::string& key,
                                                                 const std::string& x, const std::string& y) {
  std::map<std::string, std::vector<std::pair<double, double>>> all;
  for (const auto& row : sheet.rows) {
    all[row[column(sheet, key)]].emplace_back(number(row[column(sheet, x)]), number(row[column(sheet, y)]));
  }
  for (auto& [name, points] : all) std::sort(points.begin(), points.end());
  return all;
}

std::function<std::string(const std::filesystem::path&)> drawn(const Plot& plot) {
  return [plot](const std::filesystem::path& png) { return gnuplot_text(plot, png); };
}

Picture boundary_picture(const Sheet& sheet) {
  Plot plot{.title = "K_crit over the virtual damping: 1 kg, 2 Ns/m, T = 1 ms",
            .x = "B [Ns/m]",
            .y = "K_crit [N/m]",
            .settings = "set yrange [0:300000]\nset xrange [0:900]\n",
            .curves = {}};
  const auto exact = by(sheet, "t_d_ms", "B_Ns_per_m", "K_exact");
  const auto simulated = by(sheet, "t_d_ms", "B_Ns_per_m", "K_simulated");
  const auto rule = by(sheet, "t_d_ms", "B_Ns_per_m", "K_rule");
  std::size_t i = 0;
  for (const auto& [delay, points] : exact) {
    plot.curves.push_back({"exact, t_d " + delay + " ms", "lines lw 2 " + color(i), points});
    plot.curves.push_back({"simulated", "points pt 6 ps 1.2 " + color(i), simulated.at(delay)});
    plot.curves.push_back({"linear rule", "lines dt 2 lw 1 " + color(i), rule.at(delay)});
    ++i;
  }
  return {"stability_boundary",
          "The boundary K(B, t_d): lines from the spectral radius of the discretised loop (A4), circles found by "
          "bisection in "
          "simulation, dashed the linear rule A3, which is optimistic for B > 0.",
          drawn(plot)};
}

Picture damping_picture(const Sheet& sheet) {
  Plot plot{.title = "Largest virtual damping, K -> 0 (A5)",
            .x = "t_d / T",
            .y = "B T / m",
            .settings = "set yrange [0:2.2]\n",
            .curves = {}};
  const auto points = [&](const std::string& y) {
    std::vector<std::pair<double, double>> all;
    for (const auto& row : sheet.rows) all.emplace_back(number(row[0]), number(row[column(sheet, y)]));
    return all;
  };
  plot.curves = {{"exact", "lines lw 2 " + color(0), points("exact")},
                 {"simulated", "points pt 6 ps 1.5 " + color(1), points("simulated")},
                 {"as stated", "points pt 2 ps 1.2 " + color(6), points("stated")}};
  return {"stability_damping_limit", "The damping that the loop stands without a spring falls with the delay.",
          drawn(plot)};
}

Picture z_width_picture(const Sheet& sheet) {
  Plot plot{.title = "Z-width: stiffest stable plate, t_d = 1 ms",
            .x = "b_D [Ns/m]",
            .y = "k_D [N/m]",
            .log_y = true,
            .curves = {}};
  Sheet at_1ms = sheet;
  std::erase_if(at_1ms.rows, [&](const auto& row) { return row[column(sheet, "t_d_ms")] != "1"; });
  const auto exact = by(at_1ms, "solver", "B_Ns_per_m", "K_exact");
  if (!exact.empty()) plot.curves.push_back({"exact (A4)", "lines lw 2 " + color(6), exact.begin()->second});
  std::size_t i = 0;
  for (const auto& [solver, points] : by(at_1ms, "solver", "B_Ns_per_m", "K_measured")) {
    plot.curves.push_back({solver, fmt::format("linespoints dt 3 pt {} ps 1.4 {}", 4 + 2 * i, color(i)), points});
    ++i;
  }
  return {"stability_z_width",
          "A slab of 1 kg pressed 2 mm into a compiled plate through the whole pipeline; what lies below a solver's "
          "line is stable.",
          drawn(plot)};
}

Picture gyration_picture(const Sheet& sheet) {
  Plot plot{.title = "k_VC,r and the radius of gyration, k_D at half of its boundary",
            .x = "radius of gyration [mm]",
            .y = "largest stable k_VC,r [m^2]",
            .log_x = true,
            .log_y = true,
            .curves = {}};
  std::size_t i = 0;
  const auto measured = by(sheet, "B_Ns_per_m", "gyration_mm", "k_VC_r_measured");
  for (const auto& [damping, points] : by(sheet, "B_Ns_per_m", "gyration_mm", "k_VC_r_exact")) {
    plot.curves.push_back({"exact, b_D " + damping + " Ns/m", "lines lw 2 " + color(i), points});
    plot.curves.push_back({"measured", "points pt 6 ps 1.5 " + color(i), measured.at(damping)});
    ++i;
  }
  return {"stability_gyration",
          "A device with radius of gyration g stands k_VC,r up to g<sup>2</sup> times the factor that is left of k_D; "
          "measured by "
          "the tilt of a body on three feet on a compiled plate, solver contact.",
          drawn(plot)};
}

Picture loss_picture(const Sheet& sheet) {
  Plot plot{
      .title = "Lost frames, the last force held on (A10)", .x = "lost [%]", .y = "fall of K_crit [%]", .curves = {}};
  std::vector<std::pair<double, double>> measured;
  std::vector<std::pair<double, double>> stated;
  for (const auto& row : sheet.rows) {
    measured.emplace_back(100.0 * number(row[0]), 100.0 * number(row[2]));
    stated.emplace_back(100.0 * number(row[0]), 100.0 * number(row[1]));
  }
  plot.curves = {{"measured", "linespoints lw 2 pt 6 ps 1.4 " + color(0), measured},
                 {"as stated", "points pt 2 ps 1.4 " + color(1), stated},
                 {"0.85 K_crit", "lines dt 2 " + color(6), {{0.0, 15.0}, {20.0, 15.0}}}};
  return {"stability_frame_loss", "Samples lost at random, 1 kg, 2 Ns/m, t_d = 1 ms; mean of several seeds.",
          drawn(plot)};
}

Picture passivity_picture(const Sheet& sheet) {
  Plot plot{.title = "K_crit with and without the passivity controller: 1 kg, 2 Ns/m, T = 1 ms",
            .x = "B [Ns/m]",
            .y = "K_crit [N/m]",
            .curves = {}};
  const auto without = by(sheet, "t_d_ms", "B_Ns_per_m", "K_without");
  std::size_t i = 0;
  for (const auto& [delay, points] : by(sheet, "t_d_ms", "B_Ns_per_m", "K_with")) {
    plot.curves.push_back({"with, t_d " + delay + " ms", "linespoints lw 2 pt 6 " + color(i), points});
    plot.curves.push_back({"without", "lines dt 2 lw 1 " + color(i), without.at(delay)});
    ++i;
  }
  return {"stability_passivity_controller",
          "The boundary found by simulation with the time-domain passivity controller, which may inject a quarter of "
          "the damping that the loop would stand beside B, and without it.",
          drawn(plot)};
}

/// What the longer cases take [s], by the beginning of their names.
double seconds(const std::string& name, bool quick) {
  struct Taken {
    const char* begins;
    double quick, whole;
  };
  constexpr Taken kTaken[] = {{"stability.z-width", 12.0, 60.0},      {"stability.gyration", 10.0, 80.0},
                              {"stability.pipeline-observer", 3, 20}, {"stability.frame-loss", 3.0, 60.0},
                              {"stability.passivity", 1.0, 10.0},     {"stability.random-loops", 1.0, 10.0},
                              {"stability.boundary", 1.0, 8.0},       {"stability.arm", 2.0, 6.0}};
  for (const Taken& taken : kTaken) {
    if (name.starts_with(taken.begins)) return quick ? taken.quick : taken.whole;
  }
  return 1.0;
}

Section conclude(const std::vector<CaseOutcome>& outcomes, const std::filesystem::path& folder) {
  Section section = gather(outcomes, folder);
  const auto draw = [&](const char* name, Picture (*picture)(const Sheet&)) {
    const Sheet sheet = gathered(outcomes, name);
    if (!sheet.rows.empty()) section.pictures.push_back(picture(sheet));
  };
  draw("stability_boundary", boundary_picture);
  draw("stability_damping_limit", damping_picture);
  draw("stability_z_width", z_width_picture);
  draw("stability_gyration", gyration_picture);
  draw("stability_frame_loss", loss_picture);
  draw("stability_passivity_controller", passivity_picture);
  return section;
}

}  // namespace

Chapter stability_chapter(const StabilityRequest& request) {
  Chapter chapter{.name = "stability",
                  .title = "Stability",
                  .introduction =
                      "<p>The sampled, delayed loop in lock-step virtual time. T period, t<sub>d</sub> delay without "
                      "the hold's half "
                      "period, K stiffness, B virtual damping, b device damping, m mass, c Coulomb friction, h encoder "
                      "quantum.</p>",
                  .cases = {},
                  .conclude = conclude};
  for (auto&& cases :
       {axis_cases(request.quick), passivity_cases(request.quick), pipeline_cases(request.quick), arm_cases(request)}) {
    chapter.cases.insert(chapter.cases.end(), cases.begin(), cases.end());
  }
  for (StudyCase& study_case : chapter.cases) study_case.seconds = seconds(study_case.name, request.quick);
  return chapter;
}

}  // namespace godobject::report
