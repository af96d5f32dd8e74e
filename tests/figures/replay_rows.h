#pragma once

#include "toolchain/figures/replay_log.h"

namespace godobject::figures {

/// Returns a cycle with the values that the figures use; depth in metres, times in nanoseconds.
inline ReplayRow replay_row(double t, double force, double depth, double contacts, double step1_ns, double solve_ns) {
  ReplayRow row;
  row.t = t;
  row.wrench.force = Vector3(0.0, force, 0.0);
  row.depth = depth;
  row.contacts = contacts;
  row.step1_ns = step1_ns;
  row.solve_ns = solve_ns;
  row.status = contacts > 0.0 ? "contact" : "free";
  return row;
}

}  // namespace godobject::figures
