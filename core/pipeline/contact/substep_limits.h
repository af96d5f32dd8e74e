#pragma once

#include "core/pipeline/contact/contact_lengths.h"
#include "core/pipeline/contact/contact_memory.h"
#include "core/pipeline/contact/surroundings.h"
#include "core/pipeline/cycle/state.h"
#include "core/scene/workspace_box.h"
#include "godobject/pose.h"

/// How far a sub-step looks, and how far it may go.
namespace godobject::detail {

/// Search radius of a cycle's first sub-step: the god object goes on as in the last cycle, or as the device did since then
/// where that is farther, but no more than twice as far as in the last cycle. If it wants to go farther, a second sub-step
/// follows.
double first_search_radius(const ContactMemory& memory, const ProxyState& state, const Pose& H_WD,
                           const ContactLengths& lengths, double longest) noexcept;

/// Largest share of the motion that two limits allow: points that are not near are free for so far only, and the rows are
/// linear in the rotation (`constrained`: there are rows).
double allowed_share(const Motion& motion, const Surroundings& around, double search_radius,
                     const ContactLengths& lengths, bool constrained) noexcept;

/// Moves the origin of H1 to the nearest point of the workspace, and makes the motion from H0 end there. Returns whether it
/// had to: then other points may move farther than before, since the body turns about another point.
inline bool cut_off(const WorkspaceBox& box, const Pose& H0, Pose& H1, Motion& motion) noexcept {
  if (!box.limited || box.contains(H1.translation)) return false;
  H1.translation = box.nearest(H1.translation);
  motion.translation = H0.rotation.conjugate()._transformVector(H1.translation - H0.translation);
  return true;
}

}  // namespace godobject::detail
