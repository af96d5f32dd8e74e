#pragma once

#include "toolchain/report/stability/axis_loop.h"

namespace godobject::report {

/// A fault that a test plants in the simulated loop, but not in the theory that judges it. The default changes nothing.
struct LoopFault {
  double gain = 1.0;          ///< of every force of the controller
  double damping_gain = 1.0;  ///< of the virtual damping, in addition; -1: reversed sign
  double late = 0.0;          ///< additional delay [periods]
  double loss_gain = 1.0;     ///< of the share of lost samples
};

inline Wall planted(Wall wall, const LoopFault& fault) {
  wall.stiffness *= fault.gain;
  wall.damping *= fault.gain * fault.damping_gain;
  return wall;
}

/// The caller multiplies the stiffness, which is not part of the setup.
inline AxisSetup planted(AxisSetup setup, const LoopFault& fault) {
  setup.virtual_damping *= fault.gain * fault.damping_gain;
  setup.delay += fault.late * setup.period;
  return setup;
}

}  // namespace godobject::report
