#include "toolchain/report/assembly/bounds.h"

namespace godobject::report::assembly_bound {

Bound overlap(const std::string& pair) {
  return {pair, "largest overlap of the exact meshes over the accuracy", "", 1.0};
}
Bound overflow(const std::string& pair) { return {pair, "cycles with more near points than rows", "", 0.0}; }
Bound started_inside(const std::string& pair) { return {pair, "cycles that began inside", "", 0.0}; }

Bound wedging(const std::string& pair) {
  return {pair, "wedging: coefficient that holds a push along the side, off the cones of friction", "%", 3.0};
}
Bound jamming(const std::string& pair) {
  return {pair, "jamming: coefficient that holds other loads, off the cones of friction", "%", 3.0};
}
Bound wrong_side(const std::string& pair) {
  return {pair, "random loads held or moved wrongly, a tenth from the boundary", "", 0.0};
}

Bound climb(const std::string& pair) { return {pair, "climb over a turn and back, off pitch x turn", "%", 1.0}; }
Bound torque(const std::string& pair) { return {pair, "mean torque while it climbs, off the power screw", "%", 3.0}; }
Bound self_locking(const std::string& pair) {
  return {pair, "coefficient at which the mean torque on the way down vanishes, off self-locking", "%", 3.0};
}
Bound comes_free(const std::string& pair) { return {pair, "cycles until it is free, begun 0.03 mm inside", "", 20.0}; }

Bound backlash(const std::string& pair) {
  return {pair, "turn between the stops, off the exact sections, at the pitch circle over the accuracy", "", 0.75};
}

std::vector<Bound> all() {
  std::vector<Bound> bounds{kPress, kTwist};
  for (const char* const pair : {kCavity, kRoundPeg, kRectangularPeg, kNut, kGear}) {
    bounds.insert(bounds.end(), {overlap(pair), overflow(pair), started_inside(pair)});
  }
  for (const char* const peg : {kRoundPeg, kRectangularPeg}) {
    bounds.push_back(wedging(peg));
  }
  bounds.insert(bounds.end(), {jamming(kRectangularPeg), wrong_side(kRectangularPeg)});
  bounds.insert(bounds.end(), {climb(kNut), torque(kNut), self_locking(kNut), comes_free(kNut), backlash(kGear)});
  return bounds;
}

}  // namespace godobject::report::assembly_bound
