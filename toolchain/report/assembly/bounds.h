#pragma once

#include <string>
#include <vector>

#include "toolchain/report/study/bound.h"

/// The judged quantities of the chapter on assemblies, for each pair of parts by its name.
namespace godobject::report::assembly_bound {

inline constexpr const char* kCavity = "cavity";
inline constexpr const char* kRoundPeg = "round peg";
inline constexpr const char* kRectangularPeg = "rectangular peg";
inline constexpr const char* kNut = "nut";
inline constexpr const char* kGear = "gear";

/// Of every pair.
Bound overlap(const std::string& pair);
Bound overflow(const std::string& pair);
Bound started_inside(const std::string& pair);

inline const Bound kPress{kCavity, "force off stiffness x (press - clearance), on faces, edges and corners", "%", 0.5};
inline const Bound kTwist{kCavity, "torque off turning stiffness x (turn - play)", "%", 1.0};

/// Of a peg.
Bound wedging(const std::string& pair);
Bound jamming(const std::string& pair);
Bound wrong_side(const std::string& pair);

/// Of a nut.
Bound climb(const std::string& pair);
Bound torque(const std::string& pair);
Bound self_locking(const std::string& pair);
Bound comes_free(const std::string& pair);

/// Of a gear.
Bound backlash(const std::string& pair);

/// Returns all of them.
std::vector<Bound> all();

}  // namespace godobject::report::assembly_bound
