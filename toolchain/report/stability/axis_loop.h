#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

/// One degree of freedom in lock-step virtual time, without any integration error: between two changes of the force the
/// motion is the closed form. It shares nothing with core/device/stability.h, which it is to be compared with.
namespace godobject::report {

/// m vd + b v = force, over one duration.
class FreeAxis {
 public:
  struct State {
    double x = 0.0;  ///< [m]
    double v = 0.0;  ///< [m/s]
  };

  /// `mass` [kg] > 0, `damping` [Ns/m] >= 0, `duration` [s] >= 0.
  FreeAxis(double mass, double damping, double duration);

  /// Under a constant force [N].
  void advance(double force, State& state) const {
    state.x += coast_ * state.v + push_ * force;
    state.v = decay_ * state.v + kick_ * force;
  }

 private:
  double decay_, coast_, kick_, push_;
};

/// The same with Coulomb friction c [N], from event to event.
void advance_with_friction(double mass, double damping, double coulomb, double force, double duration,
                           FreeAxis::State& state);

/// What is sent at a multiple of T acts t_d later and is held until the next one does.
class DelayedHold {
 public:
  /// `delay` in periods, >= 0.
  explicit DelayedHold(double delay_in_periods);

  /// Once a period, with what its sample gives.
  void send(double force);

  double share_before() const { return fraction_; }  ///< of the period, until the force changes
  double before() const { return sent_[oldest_]; }
  double after() const { return sent_[(oldest_ + 1) % sent_.size()]; }

 private:
  double fraction_;
  std::vector<double> sent_;  ///< D + 2, a ring
  std::size_t oldest_ = 0;
};

/// The virtual wall, on both sides: f = -K q - B (q - q_before) / T, q the position as the encoder shows it.
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

/// Mass, wall, hold and delay; the state of the whole loop.
struct AxisSetup {
  double mass = 1.0;             ///< m [kg]
  double damping = 2.0;          ///< b [Ns/m]
  double virtual_damping = 0.0;  ///< B [Ns/m]
  double period = 1e-3;          ///< T [s]
  double delay = 1e-3;           ///< t_d [s]
  int periods = 40000;           ///< that a run takes at most
};

/// Of a run under `law`, the force that a sampled position [m] gives, once a period [N]: the logarithm of what becomes
/// of the swing from its second quarter to its last. Plus or minus infinity where it has left for good or died out.
double growth(const AxisSetup& setup, FreeAxis::State start, const std::function<double(double)>& law);

/// The same on the wall, from x = 1.
double growth(const AxisSetup& setup, double stiffness);

/// Largest value with `stable(value)` by bisection to `resolution` of it, found from `start` upwards by doubling; 0 if
/// `start` is not stable, infinity if 1e9 times `start` is.
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

/// K at which the simulated loop neither grows nor decays [N/m].
double simulated_boundary(const AxisSetup& setup);

/// A motion that is imposed on the wall: work per period of time of the force that is held, where the hand moves along
/// straight lines from sample to sample [J]. The hand gets it; it is what the loop generates.
struct ImposedWork {
  double generated = 0.0;      ///< by the force of the wall
  double square_motion = 0.0;  ///< sum of (x_k+1 - x_k)^2 / T: what a damper of 1 Ns/m takes
};

/// Over the last `periods` of a script that is repeated from the beginning until the hold is in its steady state.
ImposedWork imposed_work(const std::vector<double>& script, Wall wall, double delay_in_periods);

}  // namespace godobject::report
