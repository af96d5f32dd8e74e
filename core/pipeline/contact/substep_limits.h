#pragma once

#include "core/pipeline/contact/contact_lengths.h"
#include "core/pipeline/contact/contact_memory.h"
#include "core/pipeline/contact/surroundings.h"
#include "core/pipeline/cycle/state.h"
#include "core/scene/workspace_box.h"
#include "godobject/pose.h"

/// The limits of a sub-step: its search radius and its motion.
namespace godobject::detail {

/// Returns the search radius of a cycle's first sub-step [m], at most `longest` [m]. It assumes that the god object's
/// displacement is that of the last cycle or that of the device since then, whichever is larger, but at most twice that
/// of the last cycle. For a larger motion a second sub-step follows. `H_WD`: the device pose of this cycle.
double first_search_radius(const ContactMemory& memory, const ProxyState& state, const Pose& H_WD,
                           const ContactLengths& lengths, double longest) noexcept;

/// Returns the largest share of the motion that two limits allow, at most 1: points that are not near are proved free
/// only up to Surroundings::free_displacement, and the rows are linear in the rotation (`constrained`: there are rows).
double allowed_share(const Motion& motion, const Surroundings& around, double search_radius,
                     const ContactLengths& lengths, bool constrained) noexcept;

/// Moves the origin of H1 to the nearest point of the workspace and changes the motion from H0 so that it ends there.
/// Then some points may be displaced by more than before, since the body turns about another point. False: it is there.
inline bool cut_off(const WorkspaceBox& box, const Pose& H0, Pose& H1, Motion& motion) noexcept {
  if (!box.limited || box.contains(H1.translation)) return false;
  H1.translation = box.nearest(H1.translation);
  motion.translation = H0.rotation.conjugate()._transformVector(H1.translation - H0.translation);
  return true;
}

}  // namespace godobject::detail
