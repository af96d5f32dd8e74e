#pragma once

#include <vector>

#include "toolchain/report/assembly/section.h"

namespace godobject::report {

/// The angles by which a section can turn about the origin, in either direction, until it meets another one [rad].
struct Backlash {
  double forward = 0.0;   ///< from x to y; at most half a turn
  double backward = 0.0;  ///< the other way, positive
};

/// Returns the exact angles for two plane sections that do not touch. The first contact is that of a corner of one with
/// a side of the other, so the corners' circles are cut with the sides.
Backlash exact_backlash(const std::vector<Segment>& turning, const std::vector<Segment>& still);

}  // namespace godobject::report
