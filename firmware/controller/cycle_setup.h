#pragma once

#include <cstdint>
#include <span>

#include "core/scene/scene.h"
#include "firmware/configuration/controller_file.h"
#include "firmware/cycle/control_cycle.h"

namespace godobject::firmware {

/// The cycle's constants by the controller file. `scene`, `placement` and the memory `search` of the near search
/// outlive the cycle.
CycleSetup cycle_setup(const ControllerConfig& config, const Scene& scene, const Placement& placement,
                       std::span<std::uint32_t> search);

}  // namespace godobject::firmware
