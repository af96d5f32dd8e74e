#pragma once

#include "godobject/pose.h"

namespace godobject::watch {

/// A distance and its gradient at one place.
struct Slope {
  double distance = 0.0;               ///< [m]
  Vector3 gradient = Vector3::Zero();  ///< need not be of unit length; zero where it is not known
};

/// A signed distance that the watch trusts: positive outside [m]. It shares no code with the solver's look-ups.
class Oracle {
 public:
  virtual ~Oracle() = default;

  virtual double distance(const Vector3& p) const = 0;
  /// Returns the same, faster where a class can: the distance is known to be at most `most` from zero [m].
  virtual double distance_within(const Vector3& p, double most) const {
    static_cast<void>(most);
    return distance(p);
  }
  /// Returns the gradient of the distance. It need not be of unit length; it is zero where it is not known.
  virtual Vector3 gradient(const Vector3& p) const = 0;
  /// Returns both: one look-up where a class has it.
  virtual Slope slope(const Vector3& p) const { return {distance(p), gradient(p)}; }
  /// Returns a bound of |distance(p) - distance(q)| / |p - q|.
  virtual double lipschitz() const = 0;
};

/// A chord, and the distances at its ends.
struct Chord {
  Vector3 begin;          ///< [m]
  Vector3 end;            ///< [m]
  double at_begin = 0.0;  ///< [m]
  double at_end = 0.0;    ///< [m]
};

/// Tells whether the distance falls below `least` [m] along the chord. Halves the chord until the Lipschitz constant
/// decides, or pieces are shorter than `resolution` [m]: a dip that is shorter is not seen.
bool falls_below(const Oracle& oracle, const Chord& chord, double least, double resolution);

}  // namespace godobject::watch
