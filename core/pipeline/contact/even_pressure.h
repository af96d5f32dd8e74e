#pragma once

#include "core/pipeline/contact/contact_lengths.h"
#include "core/pipeline/contact/qp/contact_patches.h"
#include "core/pipeline/contact/qp/least_constraint.h"
#include "core/pipeline/contact/search/near_points.h"
#include "core/scene/pointshell.h"

namespace godobject::detail {

/// Returns the faces on which the forces of the last cycle rest.
///
/// Forces with one normal and in one plane are those of one face. Its share is the mean distance from the load's centre
/// under a pressure p that is linear over the face and has that centre, over the mean distance of the forces:
///     share = (integral of p |q - c| / integral of p) / (sum of N_i |P_i - c| / sum of N_i),   at most 1.
/// The integrals are sums over the sample points that touch the face; points of edges, whose normals differ from the
/// face's, are left out, because edges have more points than faces. Friction of the forces N_i at c + share (P_i - c)
/// equals friction of the same loads in points between the P_i: the wrench is one that the points could have.
///
/// `samples`: near points of the moving body, at the start of the motion. Cost: twice some 5 ns for each of them and
/// each face; nothing without a second force on a face. Real-time safe.
ContactPatches patches_of(const ConstrainedStep& last, const NearPoints& samples, const Pointshell& shell,
                          const ContactLengths& lengths) noexcept;

}  // namespace godobject::detail
