#include "toolchain/report/stability/chapter.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "core/device/stability.h"
#include "toolchain/report/stability/axis_theory.h"
#include "toolchain/report/stability/bounds.h"
#include "toolchain/report/study/plot.h"

namespace godobject::report {
namespace {

const char* const kIntroduction =
    "<p>The sampled, delayed loop in lock-step virtual time. T: period; t<sub>d</sub>: delay without the hold's half "
    "period; K: stiffness; B: virtual damping; b: device damping; m: mass; c: Coulomb friction; h: encoder quantum. "
    "These rules judge the rows; &quot;stated&quot; values are those in the rules.</p>\n"
    "<div class=\"wide\"><table><tr><th>row</th><th>rule</th></tr>\n"
    "<tr><td>A1</td><td>passive without delay: b &gt; K T/2 + |B| (Colgate and Schenkel 1994)</td></tr>\n"
    "<tr><td>A2</td><td>passive with a delay of d samples: b &gt; (K T/2) sin((2d+1)q/2) / sin(q/2) - B cos((d+1)q) "
    "for all q; for B = 0: b &gt; K (T/2 + t<sub>d</sub>)</td></tr>\n"
    "<tr><td>A3</td><td>linear rule: K &lt; (b + B) / (T/2 + t<sub>d</sub>), optimistic for B &gt; 0: true over rule "
    "0.99 at B T/m = 0.01, 0.86 to 0.90 at 0.1, 0.70 to 0.82 at 0.2</td></tr>\n"
    "<tr><td>A4</td><td>stable: the spectral radius of the discretised plant with its delay is below 1 (K_crit: it is "
    "1); 0.98 K_crit decays, 1.02 K_crit grows</td></tr>\n"
    "<tr><td>A5</td><td>K &rarr; 0: B T/m &lt; 2.00, 1.14, 0.83, 0.65, 0.54, 0.40 at t<sub>d</sub> = 0, 0.5, 1, 1.5, "
    "2, 3 T</td></tr>\n"
    "<tr><td>A6</td><td>passive in spite of quantisation: K &le; min(2 b/T, 2 c/h) (Abbott and Okamura "
    "2005)</td></tr>\n"
    "<tr><td>A9</td><td>energy that a wall absorbs from a slow sine of amplitude A and rate w, per cycle: "
    "-&pi; w A<sup>2</sup> (K (T/2 + t<sub>d</sub>) - B)</td></tr>\n"
    "<tr><td>A10</td><td>samples lost, the last force held: K_crit falls by 0.5 % at 1 % loss, 3.5 % at 5 %, 6.8 % at "
    "10 %; 0.85 K_crit is stable. With a share p of losses the mean age of the force grows by T p / (1 - p), and the "
    "boundary is that of this longer delay</td></tr>\n"
    "<tr><td>A11</td><td>the control law generates no energy: the hand has supplied the energy of the exact spring, "
    "-&Sigma; f<sub>k</sub> (x<sub>k</sub> - x<sub>k-1</sub>) &ge; K x<sup>2</sup>/2 - K h<sup>2</sup>/2 per axis, "
    "with "
    "exact positions x</td></tr>\n"
    "<tr><td>A13</td><td>an arm is passive if its joint damping minus (T/2 + t<sub>d</sub>) J<sup>T</sup> K J is "
    "positive definite, and stable by A4 on the whole matrix</td></tr></table></div>";

std::size_t column(const Sheet& sheet, const std::string& name) {
  return static_cast<std::size_t>(std::find(sheet.columns.begin(), sheet.columns.end(), name) - sheet.columns.begin());
}

/// Returns the points of two columns for each text of a third column, ascending in x.
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

constexpr int kCurvePoints = 91;  ///< points of a theoretical curve

/// Returns the exact boundary of 1 kg, 2 Ns/m and T = 1 ms over B from 0 to `most` [Ns/m].
std::vector<std::pair<double, double>> exact_boundary(double delay_ms, double most) {
  std::vector<std::pair<double, double>> curve;
  for (int i = 0; i < kCurvePoints; ++i) {
    const double damping = most * i / (kCurvePoints - 1);
    curve.emplace_back(
        damping,
        stability_boundary(theory_of(
            {.mass = 1.0, .damping = 2.0, .virtual_damping = damping, .period = 1e-3, .delay = 1e-3 * delay_ms})));
  }
  return curve;
}

Picture boundary_picture(const Sheet& sheet) {
  Plot plot{.title = "K_crit over the virtual damping: 1 kg, 2 Ns/m, T = 1 ms",
            .x = "B [Ns/m]",
            .y = "K_crit [N/m]",
            .settings = "set yrange [0:300000]\nset xrange [0:900]\n",
            .curves = {}};
  const auto rule = by(sheet, "t_d_ms", "B_Ns_per_m", "K_rule");
  std::size_t i = 0;
  for (const auto& [delay, points] : by(sheet, "t_d_ms", "B_Ns_per_m", "K_simulated")) {
    plot.curves.push_back(
        {"exact, t_d " + delay + " ms", "lines lw 2 " + color(i), exact_boundary(number(delay), 900.0)});
    plot.curves.push_back({i == 0 ? "simulated" : "", "points pt 6 ps 1.2 " + color(i), points});
    plot.curves.push_back({i == 0 ? "linear rule (A3)" : "", "lines dt 2 lw 1 " + color(i), rule.at(delay)});
    ++i;
  }
  return {"stability_boundary",
          "The boundary K(B, t_d), one colour for each delay. Lines: spectral radius of the discretised loop (A4). "
          "Circles: bisection in simulation. Dashed: the linear rule A3, which is optimistic for B > 0.",
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
  std::vector<std::pair<double, double>> exact;
  for (int i = 0; i < kCurvePoints; ++i) {
    const double delay = 3e-3 * i / (kCurvePoints - 1);
    exact.emplace_back(1e3 * delay, 1e-3 * damping_boundary(theory_of({.mass = 1.0, .period = 1e-3, .delay = delay})));
  }
  plot.curves = {{"exact", "lines lw 2 " + color(0), exact},
                 {"simulated", "points pt 6 ps 1.5 " + color(1), points("simulated")},
                 {"stated", "points pt 2 ps 1.2 " + color(6), points("stated")}};
  return {"stability_damping_limit",
          "The largest stable damping without a spring falls with the delay. Crosses: values of A5.", drawn(plot)};
}

Picture z_width_picture(const Sheet& sheet) {
  Plot plot{.title = "Z-width: stiffest stable plate, t_d = 1 ms",
            .x = "b_D [Ns/m]",
            .y = "k_D [N/m]",
            .log_y = true,
            .curves = {}};
  Sheet at_1ms = sheet;
  std::erase_if(at_1ms.rows, [&](const auto& row) { return row[column(sheet, "t_d_ms")] != "1"; });
  plot.curves.push_back({"exact (A4)", "lines lw 2 " + color(6), exact_boundary(1.0, 400.0)});
  std::size_t i = 0;
  for (const auto& [solver, points] : by(at_1ms, "solver", "B_Ns_per_m", "K_measured")) {
    plot.curves.push_back({solver, fmt::format("points pt {} ps 1.4 {}", 4 + 2 * i, color(i)), points});
    ++i;
  }
  return {"stability_z_width",
          "A slab of 1 kg is pressed 2 mm into a compiled plate through the whole pipeline. Stiffnesses below a "
          "solver's mark are stable.",
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
    plot.curves.push_back({i == 0 ? "measured" : "", "points pt 6 ps 1.5 " + color(i), measured.at(damping)});
    ++i;
  }
  return {
      "stability_gyration",
      "The largest stable k_VC,r for a device with radius of gyration g is g<sup>2</sup> times the remaining factor "
      "of k_D; measured by the tilt of a body on three feet on a compiled plate, solver contact.",
      drawn(plot)};
}

Picture loss_picture(const Sheet& sheet) {
  Plot plot{
      .title = "Lost frames, the last force is held (A10)", .x = "lost [%]", .y = "fall of K_crit [%]", .curves = {}};
  std::vector<std::pair<double, double>> measured;
  std::vector<std::pair<double, double>> stated;
  for (const auto& row : sheet.rows) {
    measured.emplace_back(100.0 * number(row[0]), 100.0 * number(row[2]));
    stated.emplace_back(100.0 * number(row[0]), 100.0 * number(row[1]));
  }
  plot.curves = {{"measured", "linespoints lw 2 pt 6 ps 1.4 " + color(0), measured},
                 {"stated", "points pt 2 ps 1.4 " + color(1), stated},
                 {"0.85 K_crit", "lines dt 2 " + color(6), {{0.0, 15.0}, {20.0, 15.0}}}};
  return {"stability_frame_loss",
          "Samples lost at random, 1 kg, 2 Ns/m, t_d = 1 ms; mean of several seeds. Crosses: values of A10.",
          drawn(plot)};
}

Picture rate_picture(const Sheet& sheet) {
  Plot plot{.title = "Stiffest stable wall at the hand and the rate of the loop",
            .x = "1/T [kHz]",
            .y = "K at the hand [N/m]",
            .log_x = true,
            .log_y = true,
            .curves = {}};
  const auto by_rate = [](std::vector<std::pair<double, double>> points) {
    for (auto& [x, y] : points) x = 1.0 / x;
    return points;
  };
  std::size_t i = 0;
  const auto simulated = by(sheet, "device", "T_ms", "wall_N_per_m");
  for (const auto& [device, points] : by(sheet, "device", "T_ms", "wall_exact_N_per_m")) {
    plot.curves.push_back({device + ", exact", "lines lw 2 " + color(i), by_rate(points)});
    plot.curves.push_back({device + ", simulated", "points pt 6 ps 1.5 " + color(i), by_rate(simulated.at(device))});
    ++i;
  }
  return {"stability_rate",
          "The stiffest wall that each arm renders stably at 250 Hz to 4 kHz, with the delay of the bus plan of each "
          "period. Below 1 ms each joint has a bus of its own with CAN FD.",
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
    plot.curves.push_back({i == 0 ? "without" : "", "lines dt 2 lw 1 " + color(i), without.at(delay)});
    ++i;
  }
  return {"stability_passivity_controller",
          "The simulated boundary with and without the time-domain passivity controller, which may inject a quarter of "
          "the largest stable damping in addition to B.",
          drawn(plot)};
}

/// Durations of the longer cases [s], by the beginning of their names.
double seconds(const std::string& name, bool quick) {
  struct Taken {
    const char* begins;
    double quick, whole;
  };
  constexpr Taken kTaken[] = {
      {"stability.z-width", 12.0, 60.0},   {"stability.gyration", 10.0, 80.0}, {"stability.pipeline-observer", 3, 20},
      {"stability.frame-loss", 3.0, 60.0}, {"stability.passivity", 1.0, 10.0}, {"stability.random-loops", 1.0, 10.0},
      {"stability.boundary", 1.0, 8.0},    {"stability.arm", 2.0, 6.0},        {"stability.rate", 5.0, 5.0}};
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
  draw("stability_rate", rate_picture);
  draw("stability_passivity_controller", passivity_picture);
  return section;
}

}  // namespace

std::string inputs_of(const StabilityRequest& request) {
  return fmt::format("quick {} seed {}", request.quick, request.seed);
}

Chapter stability_chapter(const StabilityRequest& request) {
  Chapter chapter{.name = "stability",
                  .title = "Stability",
                  .introduction = kIntroduction,
                  .bounds = stability_bound::all(),
                  .cases = {},
                  .conclude = conclude};
  for (auto&& cases : {axis_cases(request), passivity_cases(request), pipeline_cases(request), arm_cases(request)}) {
    chapter.cases.insert(chapter.cases.end(), cases.begin(), cases.end());
  }
  for (StudyCase& study_case : chapter.cases) study_case.seconds = seconds(study_case.name, request.quick);
  return chapter;
}

}  // namespace godobject::report
