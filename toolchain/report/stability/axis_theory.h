#pragma once

#include "core/device/stability.h"
#include "toolchain/report/stability/axis_loop.h"

namespace godobject::report {

/// Returns the loop of a setup for the theory.
inline AxisLoop theory_of(const AxisSetup& setup) {
  AxisLoop loop;
  loop.mass = setup.mass;
  loop.damping = setup.damping;
  loop.virtual_damping = setup.virtual_damping;
  loop.timing = {setup.period, setup.delay, 2};
  return loop;
}

}  // namespace godobject::report
