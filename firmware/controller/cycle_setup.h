#pragma once

#include <cstddef>
#include <span>

#include "core/scene/scene_view.h"
#include "firmware/configuration/controller_file.h"
#include "firmware/cycle/control_cycle.h"

namespace godobject::firmware {

/// The cycle's constants by the controller file. `scene`, `placement` and the god object's `memory` outlive the
/// cycle.
CycleSetup cycle_setup(const ControllerConfig& config, const SceneView& scene, const Placement& placement,
                       std::span<std::byte> memory);

}  // namespace godobject::firmware
