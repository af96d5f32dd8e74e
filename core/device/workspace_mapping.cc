#include "core/device/workspace_mapping.h"

#include <algorithm>

namespace godobject {

WorkspaceMapping::WorkspaceMapping(const WorkspaceMappingParameters& parameters, const Pose& H_RM) noexcept
    : parameters_(parameters) {
  H_WM_.translation =
      parameters.H_WR.translation + parameters.scale * parameters.H_WR.rotation._transformVector(H_RM.translation);
  H_WM_.rotation = (parameters.H_WR.rotation * H_RM.rotation).normalized();
  index(H_RM);
}

void WorkspaceMapping::index(const Pose& H_RM) noexcept {
  tool_R_ = H_RM.translation;
  scene_W_ = H_WM_.translation;
  turn_ = ((parameters_.H_WR.rotation * H_RM.rotation).conjugate() * H_WM_.rotation).normalized();
}

Status WorkspaceMapping::update(const Pose& H_RM, bool closed, double period) noexcept {
  if (!H_RM.is_finite()) return Status::kNotFinite;
  if (closed && !closed_) index(H_RM);
  closed_ = closed;
  const double step = parameters_.fade_time > 0.0 ? period / parameters_.fade_time : 1.0;
  engagement_ = std::clamp(engagement_ + (closed ? step : -step), 0.0, 1.0);
  if (!closed) return Status::kOk;
  const Quaternion& R_WR = parameters_.H_WR.rotation;
  H_WM_.translation = scene_W_ + parameters_.scale * R_WR._transformVector(H_RM.translation - tool_R_);
  H_WM_.rotation = (R_WR * H_RM.rotation * turn_).normalized();
  return Status::kOk;
}

Motion WorkspaceMapping::velocity_in_scene(const Motion& velocity_R) const noexcept {
  if (!closed_ && engagement_ == 0.0) return {};
  const Quaternion& R_WR = parameters_.H_WR.rotation;
  return {parameters_.scale * R_WR._transformVector(velocity_R.translation),
          R_WR._transformVector(velocity_R.rotation)};
}

Wrench WorkspaceMapping::wrench_at_hand(const Wrench& F_W) const noexcept {
  const Quaternion R_RW = parameters_.H_WR.rotation.conjugate();
  return {engagement_ * parameters_.scale * R_RW._transformVector(F_W.force),
          engagement_ * R_RW._transformVector(F_W.torque)};
}

}  // namespace godobject
