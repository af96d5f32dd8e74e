#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "toolchain/report/contact_quality/quantities.h"
#include "toolchain/report/contact_quality/scenes.h"
#include "toolchain/report/contact_quality/world.h"

namespace godobject::report {

/// Extent of a study.
struct Effort {
  int dashes = 100;
  double tremor_s = 10.0;
};

/// Returns all quantities of one solver in all motions of one scene. `still_world` is the unmoved world of a moved one,
/// null otherwise. The result is empty if the solver cannot run in the scene.
std::vector<Measurement> measure(const SceneSpec& scene, const World& world, const World* still_world, Solver solver,
                                 const Effort& effort);

}  // namespace godobject::report
