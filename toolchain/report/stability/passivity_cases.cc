#include <algorithm>
#include <cmath>
#include <random>

#include <fmt/format.h>

#include "core/device/passivity.h"
#include "toolchain/report/stability/axis_loop.h"
#include "toolchain/report/stability/axis_theory.h"
#include "toolchain/report/stability/bounds.h"
#include "toolchain/report/stability/cases.h"

namespace godobject::report {
namespace {

/// Passivity observer and controller of one axis, as in the control cycle.
class Account {
 public:
  Account(double period, double delay_in_periods, double most_damping)
      : period_(period),
        observer_(delay_in_periods),
        controller_({.most_damping = most_damping, .period = period, .rotation_length = 1.0}, delay_in_periods) {}

  /// Returns the force for the hand's position [m], in place of `law(x, before)` [N]. Call it once a period.
  template <class Law>
  double force(double x, Law law) {
    JointVector q = JointVector::Zero();
    q[0] = x;
    observer_.observe(q);
    Wrench wrench;
    wrench.force.x() = law(x, before_);
    Motion velocity;
    velocity.translation.x() = (x - before_) / period_;
    before_ = x;
    JointVector sent = JointVector::Zero();
    sent[0] = controller_.apply(observer_.absorbed(), wrench, velocity).force.x();
    observer_.send(sent);
    changed_ = std::fabs(sent[0] - wrench.force.x());
    return sent[0];
  }

  double changed() const { return changed_; }  ///< last change of the force [N]
  double absorbed() const { return observer_.absorbed(); }

 private:
  double period_;
  PassivityObserver observer_;
  PassivityController controller_;
  double before_ = 0.0;
  double changed_ = 0.0;
};

/// Returns the growth on the wall, from x = 0, where the spring is relaxed.
double watched_growth(const AxisSetup& setup, double stiffness, double most_damping) {
  Account account(setup.period, setup.delay / setup.period, most_damping);
  return growth(setup, {.x = 0.0, .v = 1.0}, [&](double position) {
    return account.force(position, [&](double x, double before) {
      return -stiffness * x - setup.virtual_damping * (x - before) / setup.period;
    });
  });
}

CaseResult boundary_with_controller(const StabilityRequest& request) {
  CaseResult result;
  Sheet sheet{.name = "stability_passivity_controller",
              .columns = {"t_d_ms", "B_Ns_per_m", "b_max_Ns_per_m", "K_without", "K_with", "K_with_B_plus_b_max"},
              .rows = {}};
  const std::vector<double> dampings =
      request.quick ? std::vector<double>{0, 20, 200, 400} : std::vector<double>{0, 5, 10, 20, 50, 100, 200, 300, 400};
  for (const double delay : {0.5e-3, 1e-3, 2e-3}) {
    for (const double damping : dampings) {
      AxisSetup setup{.virtual_damping = damping, .delay = delay, .periods = request.quick ? 10000 : 40000};
      const double most = 0.25 * (damping_boundary(theory_of(setup)) - damping);
      if (!(most > 0.0)) continue;
      const double without = simulated_boundary(setup);
      const double with = boundary(0.25 * without, [&](double stiffness) {
        return watched_growth(planted(setup, request.fault), request.fault.gain * stiffness, most) < 0.0;
      });
      AxisSetup damped = setup;
      damped.virtual_damping += most;
      const double of_damped = stability_boundary(theory_of(damped));
      sheet.rows.push_back(
          {cell(kMilli * delay), cell(damping), cell(most), cell(without), cell(with), cell(of_damped)});
      const std::string where = fmt::format("t_d {} ms B {} b_max {:.0f}: {:.4g} to {:.4g} N/m", kMilli * delay,
                                            damping, most, without, with);
      result.findings.push_back(judged(stability_bound::kControlled,
                                       kPercent * std::max(0.0, 1.0 - with / std::min(without, of_damped)), where));
      // more damping than that of the highest boundary lowers the boundary, from any source
      result.findings.push_back({.row = "passivity controller",
                                 .what = "boundary with controller below that without it",
                                 .unit = "%",
                                 .value = kPercent * std::max(0.0, 1.0 - with / without),
                                 .most = {},
                                 .where = where});
      result.findings.push_back({.row = "passivity controller",
                                 .what = "boundary with controller over that without it",
                                 .unit = "",
                                 .value = with / without,
                                 .most = {},
                                 .where = where});
    }
  }
  result.sheets.push_back(sheet);
  return result;
}

/// The controller's change of the force, for a hand that moves randomly into the wall and out again.
CaseResult force_with_controller(const StabilityRequest& request) {
  constexpr double kStiffness = 2000.0;
  CaseResult result;
  for (const double stated : {20.0, 0.0}) {
    const double damping = stated * request.fault.damping_gain;
    double change = 0.0;
    double largest = 0.0;
    double lowest = 0.0;
    for (unsigned seed = 1; seed <= (request.quick ? 5u : 50u); ++seed) {
      std::mt19937 random(seed + 100 * request.seed);
      std::uniform_real_distribution<double> unit(0.0, 1.0);
      const double slow = 1.0 + 3.0 * unit(random);
      const double quick_wave = 5.0 + 45.0 * unit(random);
      const double share = 0.3 * unit(random);
      // one-sided: the spring pushes, and damping does not turn a push into a pull
      const auto wall = [damping](double x, double before) {
        if (x <= 0.0) return 0.0;
        return std::min(0.0, -kStiffness * x - damping * (x - before) / kPeriod);
      };
      Account account(kPeriod, 1.0, 100.0);
      for (int k = 0; k < 10000; ++k) {
        const double t = kPeriod * k;
        const double force = account.force(5e-3 * (std::sin(slow * t) + share * std::sin(quick_wave * t)), wall);
        change = std::max(change, account.changed());
        largest = std::max(largest, std::fabs(force));
        lowest = std::min(lowest, account.absorbed());
      }
    }
    const double share = kPercent * change / largest;
    const std::string where =
        fmt::format("{} N/m, {} Ns/m, t_d 1 ms, b_max 100 Ns/m: {:.3g} of {:.3g} N, energy down to {:.2g} J",
                    kStiffness, damping, change, largest, lowest);
    if (stated > 0.0) {
      result.findings.push_back(judged(stability_bound::kControlledForce, share, where));
      continue;
    }
    result.findings.push_back(
        {.row = "passivity controller",
         .what = "change of the force of a spring, made active by the delay, over the largest force",
         .unit = "%",
         .value = share,
         .most = {},
         .where = where});
  }
  return result;
}

}  // namespace

std::vector<StudyCase> passivity_cases(const StabilityRequest& request) {
  const std::string inputs = inputs_of(request);
  return {{.name = "stability.passivity-controller",
           .inputs = inputs,
           .run = [request](const auto&) { return boundary_with_controller(request); }},
          {.name = "stability.passivity-force", .inputs = inputs, .run = [request](const auto&) {
             return force_with_controller(request);
           }}};
}

}  // namespace godobject::report
