#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "godobject/pose.h"

/// Figures of signals sampled once a millisecond.
namespace godobject::report {

/// Root mean square of what is faster than 100 Hz (Butterworth of fourth order; the first 50 ms let it settle and do
/// not count). 0 for signals that are shorter.
double chatter(std::span<const Vector3> signal);

/// Value of nearest rank; q in 0 .. 1. NaN for nothing.
double percentile(std::vector<double> values, double q);

/// Distance between the means of the first and the last `window` positions [m].
double drift(std::span<const Vector3> positions, std::size_t window);

/// Longest run of values above `limit`, in samples.
std::size_t longest_above(std::span<const double> values, double limit);

/// The part of a vector that is perpendicular to a unit vector.
Vector3 across(const Vector3& v, const Vector3& unit);

/// [rad]; exact for small angles too.
double angle_between(const Vector3& a, const Vector3& b);

/// A rectangle in the plane z = 0 about the origin.
struct Rectangle {
  double half_x = 0.0;
  double half_y = 0.0;

  /// The straight way from a to b goes from one side to the other through it.
  bool is_pierced(const Vector3& a, const Vector3& b) const;
};

}  // namespace godobject::report
