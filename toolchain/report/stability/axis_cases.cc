#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <fmt/format.h>

#include "toolchain/report/stability/axis_loop.h"
#include "toolchain/report/stability/axis_theory.h"
#include "toolchain/report/stability/bounds.h"
#include "toolchain/report/stability/cases.h"

namespace godobject::report {
namespace {

namespace bound = stability_bound;

constexpr double kPi = std::numbers::pi;

double percent_off(double value, double expected) { return kPercent * std::fabs(value / expected - 1.0); }

std::vector<double> cosine(std::size_t samples, std::size_t waves) {
  std::vector<double> script(samples);
  for (std::size_t k = 0; k < samples; ++k) {
    script[k] = std::cos(2.0 * kPi * static_cast<double>(waves * k) / static_cast<double>(samples));
  }
  return script;
}

/// Returns the smallest device damping with which the loop generates no energy at any frequency.
double needed_damping(const Wall& wall, double delay_in_periods, std::size_t samples) {
  double most = 0.0;
  for (std::size_t waves = 1; waves <= samples / 2; ++waves) {
    const ImposedWork work = imposed_work(cosine(samples, waves), wall, delay_in_periods);
    most = std::max(most, work.generated / work.square_motion);
  }
  return most;
}

/// Returns the largest right side of A2 over all frequencies.
double needed_by_formula(const Wall& wall, int d, std::size_t samples) {
  double most = 0.0;
  for (std::size_t waves = 1; waves <= samples / 2; ++waves) {
    const double q = 2.0 * kPi * static_cast<double>(waves) / static_cast<double>(samples);
    most = std::max(most, 0.5 * wall.stiffness * wall.period * std::sin((2 * d + 1) * q / 2.0) / std::sin(q / 2.0) -
                              wall.damping * std::cos((d + 1) * q));
  }
  return most;
}

CaseResult passivity(const StabilityRequest& request) {
  constexpr std::size_t kSamples = 1000;
  CaseResult result;
  Sheet sheet{.name = "stability_passivity",
              .columns = {"K_N_per_m", "B_Ns_per_m", "delay_ms", "b_formula", "b_measured"},
              .rows = {}};
  const auto note = [&](const Bound& bound, const Wall& wall, double delay, double formula) {
    const double measured = needed_damping(planted(wall, request.fault), delay + request.fault.late, kSamples);
    sheet.rows.push_back(
        {cell(wall.stiffness), cell(wall.damping), cell(delay * wall.period * kMilli), cell(formula), cell(measured)});
    result.findings.push_back(
        judged(bound, percent_off(measured, formula),
               fmt::format("K {} B {} t_d {} ms", wall.stiffness, wall.damping, delay * wall.period * kMilli)));
  };
  for (const double stiffness :
       request.quick ? std::vector<double>{500.0} : std::vector<double>{500.0, 2000.0, 10000.0}) {
    for (const double damping : {-5.0, 0.0, 2.0, 50.0}) {
      const Wall wall{.stiffness = stiffness, .damping = damping, .period = kPeriod};
      note(bound::kNeededDamping, wall, 0.0, 0.5 * stiffness * kPeriod + std::fabs(damping));
      for (const int d : {1, 2, 3}) note(bound::kNeededDelayed, wall, d, needed_by_formula(wall, d, kSamples));
    }
    const Wall spring{.stiffness = stiffness, .period = kPeriod};
    for (const double delay : {0.0, 0.3, 1.0, 1.7, 2.5}) {
      // the slowest wave of the samples still has a relative error of (w T)^2 / 6, which is within the bound
      note(bound::kNeededOfSpring, spring, delay, stiffness * kPeriod * (0.5 + delay));
    }
  }
  result.sheets.push_back(sheet);
  return result;
}

/// K_crit [N/m] of an independent computation for m = 1 kg, b = 2 Ns/m, T = 1 ms; 0: unstable.
struct TableRow {
  double delay;
  std::array<double, 10> stiffness;
};
constexpr std::array<double, 10> kTableDamping = {0, 5, 10, 20, 50, 100, 200, 300, 400, 600};
constexpr std::array<TableRow, 3> kTable = {{
    {0.5e-3, {2001, 6968, 11885, 21571, 49440, 91977, 162703, 214874, 249153, 266530}},
    {1e-3, {1334, 4643, 7916, 14349, 32755, 60431, 104359, 132703, 144989, 119132}},
    {2e-3, {801, 2783, 4737, 8560, 19336, 34903, 56312, 63019, 52150, 0}},
}};

/// Returns the distance of true/rule from its stated range (A3) at B T / m.
double outside_of_stated(double virtual_damping, double ratio) {
  struct Stated {
    double damping, low, high;
  };
  for (const Stated& stated : {Stated{10.0, 0.99, 0.99}, {100.0, 0.86, 0.90}, {200.0, 0.70, 0.82}}) {
    if (virtual_damping == stated.damping) return std::max({0.0, stated.low - ratio, ratio - stated.high});
  }
  return std::numeric_limits<double>::quiet_NaN();
}

/// Returns the number of runs at 0.98 and 1.02 of the boundary that end on the wrong side.
int wrong_sides(const AxisSetup& setup, double boundary) {
  return static_cast<int>(!(growth(setup, 0.98 * boundary) < 0.0)) +
         static_cast<int>(!(growth(setup, 1.02 * boundary) > 0.0));
}

/// Tests one row of the table, and the curve between its entries.
CaseResult boundaries(const TableRow& row, const StabilityRequest& request) {
  const LoopFault& fault = request.fault;
  CaseResult result;
  Sheet sheet{.name = "stability_boundary",
              .columns = {"t_d_ms", "B_Ns_per_m", "K_table", "K_exact", "K_simulated", "K_rule"},
              .rows = {}};
  AxisSetup setup{.delay = row.delay, .periods = request.quick ? 20000 : 60000};
  std::vector<std::pair<double, double>> points;  // B, K of the table or NaN
  for (std::size_t i = 0; i < kTableDamping.size(); ++i) points.emplace_back(kTableDamping[i], row.stiffness[i]);
  const double step = request.quick ? 100.0 : 20.0;
  for (double damping = 0.0; damping <= 900.0; damping += step) points.emplace_back(damping, std::nan(""));
  const double rule_time = 0.5 * setup.period + setup.delay;
  for (const auto& [damping, stated] : points) {
    setup.virtual_damping = damping;
    const AxisSetup loop = planted(setup, fault);
    const double exact = stability_boundary(theory_of(setup));
    const double simulated = simulated_boundary(loop) / fault.gain;
    const double rule = (setup.damping + damping) / rule_time;
    sheet.rows.push_back(
        {cell(kMilli * row.delay), cell(damping), cell(stated), cell(exact), cell(simulated), cell(rule)});
    const std::string where = fmt::format("B {} t_d {} ms", damping, kMilli * row.delay);
    if (!std::isnan(stated)) {
      const double computed = stability_boundary(theory_of(loop)) / fault.gain;
      result.findings.push_back(judged(bound::kTable, std::fabs(computed - stated), where));
    }
    if (exact > 0.0) {
      result.findings.push_back(judged(bound::kAxis, percent_off(simulated, exact), where));
      const int wrong = wrong_sides(loop, fault.gain * exact);
      result.findings.push_back(judged(bound::kWrongSide, wrong, wrong > 0 ? where : ""));
    } else {
      result.findings.push_back(judged(bound::kNoneStable, simulated, where));
    }
    const double outside = outside_of_stated(damping, simulated / rule);
    if (std::isnan(stated) || std::isnan(outside)) continue;
    result.findings.push_back(judged(bound::kRule, outside, fmt::format("{}: {:.3f}", where, simulated / rule)));
  }
  result.sheets.push_back(sheet);
  return result;
}

CaseResult damping_limit(const LoopFault& fault) {
  struct Stated {
    double delay, limit;
  };
  CaseResult result;
  Sheet sheet{.name = "stability_damping_limit", .columns = {"t_d_in_T", "stated", "exact", "simulated"}, .rows = {}};
  for (const Stated& stated : {Stated{0.0, 2.00}, {0.5, 1.14}, {1.0, 0.83}, {1.5, 0.65}, {2.0, 0.54}, {3.0, 0.40}}) {
    AxisSetup setup{.damping = 0.0, .delay = stated.delay * kPeriod, .periods = 40000};
    const double softest = 1e-8 * setup.mass / (kPeriod * kPeriod);
    const double simulated = kPeriod / setup.mass * boundary(1.0, [&](double damping) {
                               setup.virtual_damping = damping;
                               return growth(planted(setup, fault), fault.gain * softest) < 0.0;
                             });
    const double exact = kPeriod / setup.mass * damping_boundary(theory_of(setup));
    sheet.rows.push_back({cell(stated.delay), cell(stated.limit), cell(exact), cell(simulated)});
    const std::string where = fmt::format("t_d {} T", stated.delay);
    result.findings.push_back(judged(bound::kDampingStated, percent_off(simulated, stated.limit), where));
    result.findings.push_back(judged(bound::kDampingExact, percent_off(simulated, exact), where));
  }
  result.sheets.push_back(sheet);
  return result;
}

struct DryAxis {
  double damping = 2.0;   ///< b [Ns/m]
  double coulomb = 0.01;  ///< c [N]
  double quantum = 5e-6;  ///< h [m]
  double limit() const { return std::min(2.0 * damping / kPeriod, 2.0 * coulomb / quantum); }
};

/// The worst motion goes back and forth across the place where the reading changes, once a period: by less than a
/// quantum if dry friction is the weak part, by many quanta if damping is.
bool is_passive(const DryAxis& axis, double stiffness) {
  const Wall wall{.stiffness = stiffness, .period = kPeriod, .quantum = axis.quantum};
  for (double exponent = -6.0; exponent <= 6.0; exponent += 0.02) {
    const double swing = std::pow(10.0, exponent) * axis.quantum;
    const double edge = 0.5 * axis.quantum;
    const ImposedWork work = imposed_work({edge - 0.5 * swing, edge + 0.5 * swing}, wall, 0.0);
    if (work.generated > axis.damping * work.square_motion + axis.coulomb * 2.0 * swing) return false;
  }
  return true;
}

/// Tells if a free mass that is released at a random place comes to rest.
bool comes_to_rest(const DryAxis& axis, double stiffness, FreeAxis::State state) {
  constexpr double kMass = 1.0;
  constexpr int kPeriods = 60000;
  Wall wall{.stiffness = stiffness, .period = kPeriod, .quantum = axis.quantum};
  for (int k = 0; k < kPeriods; ++k) {
    const double force = wall.force(state.x);
    if (state.v == 0.0 && std::fabs(force) <= axis.coulomb) return true;
    advance_with_friction(kMass, axis.damping, axis.coulomb, force, kPeriod, state);
  }
  return false;
}

CaseResult quantisation(const StabilityRequest& request) {
  const double gain = request.fault.gain;
  CaseResult result;
  Sheet sheet{.name = "stability_quantisation", .columns = {"b", "c", "h_um", "K_stated", "K_measured"}, .rows = {}};
  std::mt19937 random(6 + request.seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  double restless = 0.0;
  for (const DryAxis& axis : {DryAxis{.coulomb = 0.002},
                              {.coulomb = 0.005},
                              {.coulomb = 0.009},
                              {.coulomb = 0.02},
                              {.coulomb = 1.0},
                              {.damping = 0.5, .coulomb = 0.01},
                              {.damping = 5.0, .quantum = 1e-4}}) {
    const double measured = boundary(1.0, [&](double stiffness) { return is_passive(axis, gain * stiffness); });
    sheet.rows.push_back(
        {cell(axis.damping), cell(axis.coulomb), cell(1e6 * axis.quantum), cell(axis.limit()), cell(measured)});
    result.findings.push_back(judged(bound::kQuantised, percent_off(measured, axis.limit()),
                                     fmt::format("b {} c {} h {} um", axis.damping, axis.coulomb, 1e6 * axis.quantum)));
    for (int i = 0; i < (request.quick ? 5 : 50); ++i) {
      const FreeAxis::State start{40.0 * axis.quantum * unit(random), 40.0 * axis.quantum * unit(random) * 30.0};
      if (!comes_to_rest(axis, gain * 0.99 * axis.limit(), start)) restless += 1.0;
    }
  }
  result.findings.push_back(judged(bound::kRestless, restless));
  result.sheets.push_back(sheet);
  return result;
}

CaseResult energy_identity(const LoopFault& fault) {
  constexpr std::size_t kSamples = 1000;  // a second
  const double w = 2.0 * kPi / (kSamples * kPeriod);
  const std::vector<double> script = cosine(kSamples, 1);  // amplitude of 1 m, because the loop is linear
  CaseResult result;
  Sheet sheet{.name = "stability_energy",
              .columns = {"K", "B", "t_d_ms", "h_of_amplitude", "E_stated_J", "E_measured_J"},
              .rows = {}};
  for (const double delay : {0.0, 0.25, 0.5, 1.0, 1.3, 2.0, 3.0}) {
    for (const double damping : {0.0, 2.0, 10.0}) {
      for (const double quantum : {0.0, 1e-3}) {
        const Wall wall{.stiffness = 1000.0, .damping = damping, .period = kPeriod, .quantum = quantum};
        const double time = kPeriod * (0.5 + delay);
        const double stated = -kPi * w * (wall.stiffness * time - damping);
        const double absorbed = -imposed_work(script, planted(wall, fault), delay + fault.late).generated;
        sheet.rows.push_back({cell(wall.stiffness), cell(damping), cell(delay * kPeriod * kMilli), cell(quantum),
                              cell(stated), cell(absorbed)});
        // relative to the larger of both terms, which cancel if the damper absorbs the energy of the delay
        const double scale = kPi * w * std::max(wall.stiffness * time, damping);
        result.findings.push_back(judged(damping > 0.0 ? bound::kEnergyDamped : bound::kEnergyOfSpring,
                                         kPercent * std::fabs(absorbed - stated) / scale,
                                         fmt::format("B {} t_d {} T h {}", damping, delay, quantum)));
        if (damping > 0.0) continue;
        const double measured = -absorbed / (kPi * w * wall.stiffness) - 0.5 * kPeriod;
        result.findings.push_back(judged(bound::kDelay, kPercent * std::fabs(measured - delay * kPeriod) / time,
                                         fmt::format("t_d {} T h {}", delay, quantum)));
      }
    }
  }
  result.sheets.push_back(sheet);
  return result;
}

/// Returns the logarithm of the mean growth per period, if samples are lost with probability `loss` and the last force
/// is held.
double growth_with_loss(double stiffness, double loss, int periods, unsigned seed) {
  constexpr double kMass = 1.0;
  const FreeAxis axis(kMass, 2.0, kPeriod);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  FreeAxis::State state{.x = 1.0};
  double sent = 0.0;
  double growth = 0.0;
  for (int k = 0; k < periods; ++k) {
    const double acts = sent;  // t_d = T
    if (unit(random) >= loss) sent = -stiffness * state.x;
    axis.advance(acts, state);
    if (k % 64 != 63) continue;
    const double swing = std::sqrt(state.x * state.x + state.v * state.v * kMass / stiffness);
    growth += std::log(swing);
    state.x /= swing;
    state.v /= swing;
    sent /= swing;
  }
  return growth / periods;
}

/// Returns the boundary with lost samples [N/m], a mean over several seeds.
double boundary_with_loss(double loss, double whole, const StabilityRequest& request) {
  const int periods = request.quick ? 300'000 : 1'000'000;
  const int seeds = request.quick ? 2 : 8;
  double sum = 0.0;
  for (int i = 1; i <= seeds; ++i) {
    const auto seed = static_cast<unsigned>(i) + 100 * request.seed;
    double stable = 0.5 * whole;
    double unstable = 1.2 * whole;
    while (unstable - stable > 2e-4 * whole) {
      const double middle = 0.5 * (stable + unstable);
      const bool decays = growth_with_loss(request.fault.gain * middle, loss, periods, seed) < 0.0;
      (decays ? stable : unstable) = middle;
    }
    sum += 0.5 * (stable + unstable);
  }
  return sum / seeds;
}

/// Theory: a sample that is lost leaves the last force. The mean age of the force grows by T p / (1 - p), the mean
/// number of losses in a row, and the boundary is that of this longer delay.
CaseResult frame_loss(const StabilityRequest& request) {
  constexpr double kSmallestEffect = 0.03;  // below it the random walk of a run counts
  struct Stated {
    double loss, falls;
  };
  CaseResult result;
  Sheet sheet{.name = "stability_frame_loss",
              .columns = {"loss", "fall_stated", "fall_measured", "fall_of_mean_delay"},
              .rows = {}};
  const double whole = stability_boundary(theory_of({.delay = kPeriod}));
  for (const Stated& stated :
       {Stated{0.0, 0.0}, {0.01, 0.005}, {0.02, std::nan("")}, {0.05, 0.035}, {0.10, 0.068}, {0.2, std::nan("")}}) {
    const double late = kPeriod * stated.loss / (1.0 - stated.loss);
    const double expected = 1.0 - stability_boundary(theory_of({.delay = kPeriod + late})) / whole;
    const double falls = 1.0 - boundary_with_loss(request.fault.loss_gain * stated.loss, whole, request) / whole;
    sheet.rows.push_back({cell(stated.loss), cell(stated.falls), cell(falls), cell(expected)});
    const std::string where = fmt::format("{:.0f} % lost: falls by {:.2f} %, {:.2f} % of the mean delay",
                                          kPercent * stated.loss, kPercent * falls, kPercent * expected);
    if (!std::isnan(stated.falls)) {
      result.findings.push_back(judged(bound::kLossStated, kPercent * std::fabs(falls - stated.falls), where));
    }
    if (expected > kSmallestEffect) {
      result.findings.push_back(judged(bound::kLossExact, percent_off(falls, expected), where));
    }
    if (stated.loss <= 0.10) result.findings.push_back(judged(bound::kLossStable, kPercent * falls, where));
  }
  result.sheets.push_back(sheet);
  return result;
}

/// A11 for the control law alone, a one-sided wall with an encoder: the hand makes random motions from outside. The
/// energy that it supplies, by its exact positions, must cover that of the exact spring, K x^2 / 2. Theory: the
/// staircase of the encoder stores up to K h^2 / 8 less, a quarter of the bound.
CaseResult observer(const StabilityRequest& request) {
  constexpr double kStiffness = 2000.0;
  constexpr double kQuantum = 5e-6;
  CaseResult result;
  double missing = 0.0;
  double held = 0.0;
  for (unsigned seed = 1; seed <= (request.quick ? 20u : 200u); ++seed) {
    std::mt19937 random(seed + 1000 * request.seed);
    std::normal_distribution<double> step(0.0,
                                          std::pow(10.0, std::uniform_real_distribution<double>(-6.5, -3.0)(random)));
    const Wall wall{.quantum = kQuantum};
    DelayedHold hold(request.fault.late);
    double x = -kQuantum;
    double force = 0.0;
    double supplied = 0.0;
    double held_energy = 0.0;
    for (int k = 0; k < 20000; ++k) {
      const double before = x;
      x = std::clamp(x + step(random), -1e-3, 5e-3);
      held_energy += force * (x - before);
      hold.send(request.fault.gain * kStiffness * std::max(0.0, wall.reading(x)));
      force = hold.after();
      supplied += force * (x - before);
      missing = std::max(missing, 0.5 * kStiffness * std::pow(std::max(0.0, x), 2) - supplied);
      held = std::min(held, held_energy);
    }
  }
  const double allowed = 0.5 * kStiffness * kQuantum * kQuantum;
  result.findings.push_back(judged(bound::kLaw, missing / allowed));
  result.findings.push_back({.row = "A11",
                             .what = "energy generated by the held force, over K h^2 / 2",
                             .unit = "",
                             .value = std::max(0.0, -held) / allowed,
                             .most = {}});
  return result;
}

/// Random loops: K 200 .. 20000 N/m, m 0.1 .. 5 kg, t_d 0 .. 3 T and any damping. Loops within 2 % of the boundary do
/// not count.
CaseResult random_loops(const StabilityRequest& request) {
  CaseResult result;
  std::mt19937 random(4 + request.seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto between = [&](double low, double high) { return low * std::pow(high / low, unit(random)); };
  double grows = 0.0;
  double decays = 0.0;
  std::string worst;
  const int loops = request.quick ? 300 : 3000;
  int judged_loops = 0;
  for (int i = 0; i < loops; ++i) {
    AxisSetup setup{.mass = between(0.1, 5.0), .damping = between(0.05, 20.0), .delay = 3.0 * kPeriod * unit(random)};
    setup.virtual_damping = unit(random) < 0.3 ? 0.0 : unit(random) * setup.mass / kPeriod;
    const double stiffness = between(200.0, 20000.0);
    const double exact = stability_boundary(theory_of(setup));
    if (std::fabs(stiffness / exact - 1.0) < 0.02) continue;
    ++judged_loops;
    const bool stable = growth(planted(setup, request.fault), request.fault.gain * stiffness) < 0.0;
    if (stable == (stiffness < exact)) continue;
    (stable ? decays : grows) += 1.0;
    worst = fmt::format("m {:.3g} b {:.3g} B {:.3g} t_d {:.3g} ms K {:.4g} of {:.4g}", setup.mass, setup.damping,
                        setup.virtual_damping, kMilli * setup.delay, stiffness, exact);
  }
  const std::string all = fmt::format("{} loops", judged_loops);
  result.findings.push_back(judged(bound::kRandomGrow, grows, grows > 0.0 ? worst : all));
  result.findings.push_back(judged(bound::kRandomDecay, decays, decays > 0.0 ? worst : all));
  return result;
}

}  // namespace

std::vector<StudyCase> axis_cases(const StabilityRequest& request) {
  const std::string inputs = inputs_of(request);
  std::vector<StudyCase> cases;
  const auto add = [&](const std::string& name, std::function<CaseResult()> run) {
    cases.push_back(
        {.name = "stability." + name, .inputs = inputs, .run = [run = std::move(run)](const auto&) { return run(); }});
  };
  add("passivity", [request] { return passivity(request); });
  for (const TableRow& row : kTable) {
    add(fmt::format("boundary-{}ms", kMilli * row.delay), [&row, request] { return boundaries(row, request); });
  }
  add("random-loops", [request] { return random_loops(request); });
  add("damping-limit", [request] { return damping_limit(request.fault); });
  add("quantisation", [request] { return quantisation(request); });
  add("energy", [request] { return energy_identity(request.fault); });
  add("frame-loss", [request] { return frame_loss(request); });
  add("observer", [request] { return observer(request); });
  return cases;
}

}  // namespace godobject::report
