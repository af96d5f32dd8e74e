#pragma once

#include "core/pipeline/cycle/state.h"
#include "godobject/report.h"
#include "godobject/status.h"

namespace godobject {

/// Ends a cycle of any solver: adds the push of the workspace's faces to `force`, checks that all numbers are finite,
/// and writes `state` and the report's pose and force. `inside`: the god object still penetrates after a start inside.
/// kNotFinite: the pose or the force is NaN or Inf; `state` and `report` are unchanged. Real-time safe.
inline Status commit(const CycleInput& input, const Pose& H_WS, DeviceForce force, bool inside, ProxyState& state,
                     CycleReport& report) noexcept {
  if (input.outside) {
    force.spring_W.force += input.push.spring_W.force;
    force.total_W.force += input.push.total_W.force;
  }
  const bool finite = H_WS.is_finite() && force.total_W.force.allFinite() && force.total_W.torque.allFinite() &&
                      force.spring_W.force.allFinite() && force.spring_W.torque.allFinite();
  if (!finite) return Status::kNotFinite;
  state.H_WS = H_WS;
  state.inside = inside;
  state.started = true;
  report.H_WS = H_WS;
  report.force = force;
  report.outside = input.outside;
  return Status::kOk;
}

}  // namespace godobject
