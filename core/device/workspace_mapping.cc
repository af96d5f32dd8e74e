#include "core/device/workspace_mapping.h"

#include <algorithm>

namespace godobject {

WorkspaceMapping::WorkspaceMapping(const WorkspaceMappingParameters& parameters, const Pose& H_RG) noexcept
    : parameters_(parameters) {
  H_WG_.translation =
      parameters.H_WR.translation + parameters.scale * parameters.H_WR.rotation._transformVector(H_RG.translation);
  H_WG_.rotation = (parameters.H_WR.rotation * H_RG.rotation).normalized();
  index(H_RG);
}

void WorkspaceMapping::index(const Pose& H_RG) noexcept {
  p_RG0_ = H_RG.translation;
  p_WG0_ = H_WG_.translation;
  turn_ = ((parameters_.H_WR.rotation * H_RG.rotation).conjugate() * H_WG_.rotation).normalized();
}

Status WorkspaceMapping::update(const Pose& H_RG, bool closed, double period) noexcept {
  if (!H_RG.is_finite()) return Status::kNotFinite;
  if (closed && !closed_) index(H_RG);
  closed_ = closed;
  const double step = parameters_.fade_time > 0.0 ? period / parameters_.fade_time : 1.0;
  engagement_ = std::clamp(engagement_ + (closed ? step : -step), 0.0, 1.0);
  if (!closed) return Status::kOk;
  const Quaternion& R_WR = parameters_.H_WR.rotation;
  H_WG_.translation = p_WG0_ + parameters_.scale * R_WR._transformVector(H_RG.translation - p_RG0_);
  H_WG_.rotation = (R_WR * H_RG.rotation * turn_).normalized();
  return Status::kOk;
}

Motion WorkspaceMapping::velocity_in_scene(const Motion& velocity_R) const noexcept {
  if (!closed_ && engagement_ == 0.0) return {};
  const Quaternion& R_WR = parameters_.H_WR.rotation;
  return {parameters_.scale * R_WR._transformVector(velocity_R.translation),
          R_WR._transformVector(velocity_R.rotation)};
}

Wrench WorkspaceMapping::wrench_at_hand(const Wrench& F_G_W) const noexcept {
  const Quaternion R_RW = parameters_.H_WR.rotation.conjugate();
  return {engagement_ * parameters_.scale * R_RW._transformVector(F_G_W.force),
          engagement_ * R_RW._transformVector(F_G_W.torque)};
}

}  // namespace godobject
