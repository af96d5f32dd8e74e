#pragma once

#include <string>
#include <vector>

#include "toolchain/report/study/bound.h"
#include "toolchain/watch/findings.h"

/// The judged quantities of the chapter on extremes. Most are counts of violations, which must be zero. Other bounds
/// are three to five times the largest value of the whole run over several seeds.
namespace godobject::report::extremes_bound {

inline const Bound kNotFinite{"bad meshes", "look-ups that are not finite", "", 0.0};
inline const Bound kWrongSign{"bad meshes", "look-ups with the wrong sign beyond a voxel", "", 0.0};
inline const Bound kNotReported{"bad meshes", "bad triangles not reported", "", 0.0};
inline const Bound kRefused{"bad meshes", "repairable meshes refused", "", 0.0};
inline const Bound kGap{"gap near the voxel", "gaps below two voxels neither refused nor flagged, wider ones refused",
                        "", 0.0};
inline const Bound kScale{"scale and place", "god object's deviation from that at 1 m", "voxels", 0.0};
inline const Bound kOffUnit{"long run", "rotations off unit length", "", 1e-15};
inline const Bound kDrift{"long run", "drift of a periodic motion in 10^7 cycles", "voxels", 6e-9};
inline const Bound kNetWork{"closed path", "net work on the hand over the peak stored energy", "", 1e-3};
inline const Bound kReplay{"closed path", "cycles that differ in a replay", "", 0.0};
inline const Bound kAccepted{"bad input", "invalid inputs accepted, or valid ones refused", "", 0.0};
inline const Bound kForce{"bad input", "invalid inputs with a force", "", 0.0};
inline const Bound kChanged{"bad input", "cycles that an invalid input before them has changed", "", 0.0};

/// Returns the bound of a property in a generated row, or of the fuzzer: no violation.
Bound of_property(const std::string& row, watch::Property property);

/// Return the bounds at a place of the torque rate: the sent torque, runs that did not reach the place, and the torque
/// that `contact` requests before the limiter.
Bound sent_torque(const std::string& place);
Bound idle_runs(const std::string& place);
Bound computed_torque(const std::string& place);

/// Returns all of them.
std::vector<Bound> all();

}  // namespace godobject::report::extremes_bound
