#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

/// One degree of freedom in lock-step virtual time without integration error: between two changes of the force the
/// motion is a closed form. It shares no code with core/device/stability.h, the theory that it is compared with.
namespace godobject::report {

/// Solution of m vd + b v = force over a fixed duration.
class FreeAxis {
 public:
  struct State {
    double x = 0.0;  ///< [m]
    double v = 0.0;  ///< [m/s]
  };

  /// `mass` [kg] > 0, `damping` [Ns/m] >= 0, `duration` [s] >= 0.
  FreeAxis(double mass, double damping, double duration);

  /// Advances the state under a constant force [N].
  void advance(double force, State& state) const {
    state.x += coast_ * state.v + push_ * force;
    state.v = decay_ * state.v + kick_ * force;
  }

 private:
  double decay_, coast_, kick_, push_;
};

/// Advances the state with Coulomb friction c [N] too, from event to event.
void advance_with_friction(double mass, double damping, double coulomb, double force, double duration,
                           FreeAxis::State& state);

/// A delay with a hold: a force that is sent at a multiple of T acts from t_d later until the next one acts.
class DelayedHold {
 public:
  /// `delay` in periods, >= 0.
  explicit DelayedHold(double delay_in_periods);

  /// Sends the force of a sample, once a period.
  void send(double force);

  double share_before() const { return fraction_; }  ///< share of the period before the force changes
  double before() const { return sent_[oldest_]; }
  double after() const { return sent_[(oldest_ + 1) % sent_.size()]; }

 private:
  double fraction_;
  std::vector<double> sent_;  ///< ring of D + 2 forces
  std::size_t oldest_ = 0;
};

/// The two-sided virtual wall: f = -K q - B (q - q_before) / T, with q the position by the encoder.
struct Wall {
  double stiffness = 0.0;  ///< K [N/m]
  double damping = 0.0;    ///< B [Ns/m]
  double period = 1e-3;    ///< T [s]
  double quantum = 0.0;    ///< h [m], rounded to nearest; 0: exact
  double before = 0.0;     ///< last reading [m]

  double reading(double x) const { return quantum > 0.0 ? quantum * std::floor(x / quantum + 0.5) : x; }
  double force(double x) {
    const double q = reading(x);
    const double f = -stiffness * q - damping * (q - before) / period;
    before = q;
    return f;
  }
};

/// Parameters of the loop: mass, wall, hold and delay.
struct AxisSetup {
  double mass = 1.0;             ///< m [kg]
  double damping = 2.0;          ///< b [Ns/m]
  double virtual_damping = 0.0;  ///< B [Ns/m]
  double period = 1e-3;          ///< T [s]
  double delay = 1e-3;           ///< t_d [s]
  int periods = 40000;           ///< largest number of periods of a run
};

/// Returns the growth of a run: the logarithm of the change of the swing from the second quarter of the run to the
/// last. Plus or minus infinity if the swing diverges or dies out. `law` gives the force [N] for a sampled position
/// [m], once a period.
double growth(const AxisSetup& setup, FreeAxis::State start, const std::function<double(double)>& law);

/// Returns the growth on the wall, from x = 1.
double growth(const AxisSetup& setup, double stiffness);

/// Returns the largest value with `stable(value)`, by doubling from `start` and bisection to the relative `resolution`;
/// 0 if `start` is not stable, infinity if 1e9 times `start` is.
template <class Stable>
double boundary(double start, Stable stable, double resolution = 1e-4) {
  constexpr double kFarthest = 1e9;
  if (!stable(start)) return 0.0;
  double low = start;
  double high = 2.0 * start;
  while (stable(high)) {
    if (high > kFarthest * start) return HUGE_VAL;
    low = high;
    high *= 2.0;
  }
  while (high - low > resolution * high) {
    const double middle = 0.5 * (low + high);
    (stable(middle) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Returns the K at which the simulated loop neither grows nor decays [N/m].
double simulated_boundary(const AxisSetup& setup);

/// Work on a hand with an imposed motion, which moves along straight lines from sample to sample. The loop generates
/// this energy, and the hand receives it.
struct ImposedWork {
  double generated = 0.0;      ///< work of the wall's held force [J]
  double square_motion = 0.0;  ///< sum of (x_k+1 - x_k)^2 / T, the energy that a damper of 1 Ns/m absorbs [J]
};

/// Returns the work over one script of positions, which is repeated until the hold is in its steady state.
ImposedWork imposed_work(const std::vector<double>& script, Wall wall, double delay_in_periods);

}  // namespace godobject::report
