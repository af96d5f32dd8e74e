#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "toolchain/report/contact_quality/quantities.h"
#include "toolchain/report/contact_quality/scenes.h"
#include "toolchain/report/contact_quality/world.h"

namespace godobject::report {

/// How long a study takes.
struct Effort {
  int dashes = 100;
  double tremor_s = 10.0;
};

/// One solver in one scene: all motions, all quantities that the scene has. `still_world` is the unmoved world of a
/// moved one, null otherwise. Empty where the solver cannot run there.
std::vector<Measurement> measure(const SceneSpec& scene, const World& world, const World* still_world, Solver solver,
                                 const Effort& effort);

}  // namespace godobject::report
