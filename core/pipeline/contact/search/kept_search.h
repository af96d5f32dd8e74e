#pragma once

#include <cstdint>
#include <limits>

#include "godobject/pose.h"

namespace godobject {
namespace detail {

/// The surface around the start of one sub-step.
struct Surroundings {
  double free_displacement;  ///< up to this displacement all points outside of the lists of near points are free [m]
  double smallest = std::numeric_limits<double>::infinity();  ///< smallest stored distance of the near points [m]
  bool swallowed = false;                                     ///< a point lies inside, where the field has no gradient
  bool lacks_rows = false;                                    ///< a listed near point, or an edge pair, found no row
  std::uint32_t unlisted = 0;                                 ///< near points that found no place in the lists
  std::uint32_t unseen = 0;                                   ///< points that the point budget left without a look-up
};

}  // namespace detail

/// The last search of a cycle. If the budget of work ended it, or the motion after it, and the god object has not
/// moved, the next cycle goes on with the lists of near points of the workspace.
struct KeptSearch {
  bool goes_on = false;      ///< the next cycle may go on with it
  bool has_samples = false;  ///< all near sample points are listed
  bool has_all = false;      ///< all near points of both directions are listed
  Pose H_WS;                 ///< the god object's pose
  double radius{};           ///< search radius [m]
  detail::Surroundings around{};
};

}  // namespace godobject
