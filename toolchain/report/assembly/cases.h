#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "toolchain/report/assembly/assembly_fault.h"
#include "toolchain/report/assembly/pair.h"
#include "toolchain/report/study/case.h"

namespace godobject::report {

/// The effort of a case on a pair.
struct AssemblyEffort {
  bool quick = false;
  std::uint32_t seed = 0;  ///< of random loads
  AssemblyFault fault = {};
};

/// Carries the part along the key frames of a file, with the friction of the scene. The overlap of the exact meshes is
/// measured in every n-th cycle in which it may have grown.
CaseResult path_case(const std::string& name, const Pair& pair, const std::filesystem::path& key_frames,
                     int overlap_every, const AssemblyEffort& effort);

/// A cube about the origin in a cubic cavity about the origin.
struct CubeInCavity {
  double half_edge = 0.01;  ///< of the cube [m]
  double clearance = 5e-5;  ///< on each side [m]
};

/// Presses the cube against all faces, edges and corners, and turns it.
CaseResult cavity_case(const std::string& name, const Pair& pair, const CubeInCavity& cube,
                       const AssemblyEffort& effort);

/// Loads on a peg other than a push along its side.
enum class OtherLoads {
  kJudged,
  kShown,  ///< on the facets of a round peg they move it sideways, where the plane theory does not hold
};

/// Finds the coefficients of friction at which a peg in its hole begins to move, and compares them with the theory of
/// jamming.
CaseResult jamming_case(const std::string& name, const Pair& pair, OtherLoads others, const AssemblyEffort& effort);

/// A nut on a bolt along z.
struct NutPlace {
  double start_z = 0.0;  ///< height of the nut's mesh in the middle of its play [m]
  double low = 0.0;      ///< heights of the bolt between which its thread is measured [m]
  double high = 0.0;
  double turns = 1.0;  ///< measured, up and down again
  int cycles_of_turn = 2000;
  int overlap_every = 1;  ///< cycles whose overlap is measured
};

/// Turns the nut up and back down, and finds the coefficient of friction from which on it locks itself.
CaseResult nut_case(const std::string& name, const Pair& pair, const NutPlace& place, const AssemblyEffort& effort);

/// A gear that turns about z, the origin of both meshes, between the teeth of others.
struct GearPlace {
  double start_z = 0.0;    ///< height of the gear's mesh [m]
  double section_z = 0.0;  ///< height of the section that has the first contact [m]
  double radius = 0.0;     ///< of the pitch circle [m]
  double friction = 0.2;
};

/// Turns the gear from stop to stop, and compares the angles with those of the exact sections.
CaseResult gear_case(const std::string& name, const Pair& pair, const GearPlace& place, const AssemblyEffort& effort);

}  // namespace godobject::report
