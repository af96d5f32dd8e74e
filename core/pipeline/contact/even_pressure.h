#pragma once

#include "core/pipeline/contact/contact_lengths.h"
#include "core/pipeline/contact/qp/contact_patches.h"
#include "core/pipeline/contact/qp/least_constraint.h"
#include "core/pipeline/contact/search/near_points.h"

namespace godobject::detail {

/// Returns the faces on which the forces of the last cycle rest.
///
/// Forces with one normal and in one plane are those of one face. A face that turns under a load without a drag turns
/// about the place x where the mean distance of its load is least; mu N times that distance is the torque. The share is
/// that mean distance under a pressure p that is linear over the face and has the load's centre, over that of the
/// forces:
///     share = (least integral of p |q - x| / integral of p) / (least sum of N_i |P_i - x| / sum of N_i),   at most 1.
/// The integrals go over the part of the plane that touching sample points cover: the octagon around them, less empty
/// cells of a grid. Its error is 0.2 % for a rectangle, 2 % for a disc and 7 % for a ring, if some hundred points
/// touch. Friction of the forces N_i at c + share (P_i - c) equals friction of the same loads in points between the
/// P_i: the wrench is one that the points could have.
///
/// `samples`: near points of the moving body, at the start of the motion. Cost: twice some 5 ns for each of them, and 2
/// us, for each face; nothing without a second force on a face, or for which the budget of `work` has no room.
/// Real-time safe.
ContactPatches patches_of(const ConstrainedStep& last, const NearPoints& samples, const ContactLengths& lengths,
                          WorkMeter& work) noexcept;

}  // namespace godobject::detail
