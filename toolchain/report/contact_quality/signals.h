#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "godobject/pose.h"

/// Quantities of signals with one sample per millisecond.
namespace godobject::report {

/// Returns the root mean square above 100 Hz (Butterworth filter of fourth order; the first 50 ms, in which the filter
/// settles, do not count). 0 for shorter signals.
double chatter(std::span<const Vector3> signal);

/// Returns the distance between the means of the first and the last `window` positions [m].
double drift(std::span<const Vector3> positions, std::size_t window);

/// Returns the part of a vector that is perpendicular to a unit vector.
Vector3 across(const Vector3& v, const Vector3& unit);

/// Returns the angle between two vectors [rad], exact for small angles too.
double angle_between(const Vector3& a, const Vector3& b);

/// A rectangle in the plane z = 0 about the origin.
struct Rectangle {
  double half_x = 0.0;
  double half_y = 0.0;

  /// Tells if the line from a to b passes from one side to the other through the rectangle.
  bool is_pierced(const Vector3& a, const Vector3& b) const;
};

}  // namespace godobject::report
