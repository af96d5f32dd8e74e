#pragma once

#include "toolchain/report/assembly/pair.h"

namespace godobject::report {

/// A peg along z and a hole about z, with the peg's tip below: measured from their meshes. [m]
struct PegFit {
  double peg_radius = 0.0;   ///< along x
  double edge_z = 0.0;       ///< in M, lowest place with that radius: above a chamfer
  double hole_radius = 0.0;  ///< along x
  double rim_z = 0.0;        ///< in W, highest place of the hole with that radius
};

/// Measures the fit in the plane y = 0 of both meshes. Throws Failure (kBadData) if the still mesh has no hole there.
PegFit measure_peg_fit(const Pair& pair);

}  // namespace godobject::report
