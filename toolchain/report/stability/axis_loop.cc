#include "toolchain/report/stability/axis_loop.h"

#include <algorithm>

namespace godobject::report {

FreeAxis::FreeAxis(double mass, double damping, double duration) {
  const double rate = damping / mass;
  const double a = rate * duration;
  decay_ = std::exp(-a);
  if (a < 1e-3) {  // series, because the closed forms lose digits
    coast_ = duration * (1.0 - a / 2.0 * (1.0 - a / 3.0 * (1.0 - a / 4.0 * (1.0 - a / 5.0))));
    push_ = duration * duration / mass * (0.5 - a / 6.0 * (1.0 - a / 4.0 * (1.0 - a / 5.0 * (1.0 - a / 6.0))));
  } else {
    coast_ = -std::expm1(-a) / rate;
    push_ = (duration - coast_) / damping;
  }
  kick_ = coast_ / mass;
}

void advance_with_friction(double mass, double damping, double coulomb, double force, double duration,
                           FreeAxis::State& state) {
  constexpr int kMostEvents = 4;  // end of a slip, stick or a slip in the other direction, and rounding
  for (int event = 0; event < kMostEvents && duration > 0.0; ++event) {
    if (state.v == 0.0 && std::fabs(force) <= coulomb) return;
    const double way = state.v != 0.0 ? std::copysign(1.0, state.v) : std::copysign(1.0, force);
    const double net = force - way * coulomb;
    double until_rest = HUGE_VAL;
    if (state.v != 0.0 && way * net < 0.0) {
      until_rest = damping > 0.0 ? mass / damping * std::log1p(-damping * state.v / net) : -mass * state.v / net;
    }
    const double slip = std::min(duration, until_rest);
    FreeAxis(mass, damping, slip).advance(net, state);
    if (until_rest <= duration) state.v = 0.0;
    duration -= slip;
  }
}

DelayedHold::DelayedHold(double delay_in_periods)
    : fraction_(delay_in_periods - std::floor(delay_in_periods)),
      sent_(static_cast<std::size_t>(std::floor(delay_in_periods)) + 2, 0.0) {}

void DelayedHold::send(double force) {
  oldest_ = (oldest_ + 1) % sent_.size();
  sent_[(oldest_ + sent_.size() - 1) % sent_.size()] = force;
}

double growth(const AxisSetup& setup, FreeAxis::State state, const std::function<double(double)>& law) {
  constexpr double kGone = 1e-12;
  constexpr double kBeyond = 1e12;
  DelayedHold hold(setup.delay / setup.period);
  const double split = hold.share_before() * setup.period;
  const FreeAxis first(setup.mass, setup.damping, split);
  const FreeAxis second(setup.mass, setup.damping, setup.period - split);
  const int quarter = setup.periods / 4;
  double early = 0.0;
  double late = 0.0;
  double lately = 0.0;  // largest swing of the present stretch, to end early
  for (int k = 0; k < setup.periods; ++k) {
    const double swing = std::fabs(state.x);
    lately = std::max(lately, swing);
    if (k >= quarter && k < 2 * quarter) early = std::max(early, swing);
    if (k >= setup.periods - quarter) late = std::max(late, swing);
    if (swing > kBeyond) return HUGE_VAL;
    if (k % 1000 == 999) {
      if (lately < kGone) return -HUGE_VAL;
      lately = 0.0;
    }
    hold.send(law(state.x));
    first.advance(hold.before(), state);
    second.advance(hold.after(), state);
  }
  return std::log(late / early);
}

double growth(const AxisSetup& setup, double stiffness) {
  Wall wall{.stiffness = stiffness, .damping = setup.virtual_damping, .period = setup.period, .before = 1.0};
  return growth(setup, {.x = 1.0}, [&wall](double x) { return wall.force(x); });
}

double simulated_boundary(const AxisSetup& setup) {
  return boundary(1.0, [&](double stiffness) { return growth(setup, stiffness) < 0.0; });
}

ImposedWork imposed_work(const std::vector<double>& script, Wall wall, double delay_in_periods) {
  DelayedHold hold(delay_in_periods);
  ImposedWork work;
  wall.before = wall.reading(script.back());
  const std::size_t size = script.size();
  const auto settle = static_cast<std::size_t>(std::ceil(delay_in_periods)) + 2;
  const std::size_t begin = (settle + size - 1) / size * size;
  for (std::size_t k = 0; k < begin + size; ++k) {
    const double x = script[k % size];
    const double way = script[(k + 1) % size] - x;
    hold.send(wall.force(x));
    if (k < begin) continue;
    const double share = hold.share_before();
    work.generated += (share * hold.before() + (1.0 - share) * hold.after()) * way;
    work.square_motion += way * way / wall.period;
  }
  return work;
}

}  // namespace godobject::report
