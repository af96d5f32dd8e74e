#pragma once

#include "core/scene/scene_view.h"
#include "firmware/configuration/controller_file.h"

namespace godobject::firmware {

/// The gain check at a start (firmware/configuration/gain_check.h): prints its warnings and one line with the margin.
/// `device`: with the mesh's frame as its tool frame; `delay`: from a position's sample to the torque [s].
/// Throws command::Failure (kBadConfig) naming key and boundary if a gain is beyond the stability boundary.
void check_gains_at_start(const ControllerConfig& config, const SceneView& scene, const Device& device, double delay);

}  // namespace godobject::firmware
