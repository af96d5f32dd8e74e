#pragma once

#include <string>
#include <vector>

namespace godobject::report {

/// The required reaction to a fault.
enum class Reaction {
  kGoesOn,  ///< full rendering continues; the fault is counted
  kStop,  ///< rendering ends, by fading within the allowed cycles or at once; then quick stop of the drives, and brakes
  kDrive,   ///< the drives stop by themselves
  kRefuse,  ///< no start: exit 65, 69, 77 or 78, no torque sent
  kEnd,     ///< ramp, quick stop, exit 0
};

/// A test that injects the fault: GoogleTest's name in a test program, or a case of the virtual machine ("hil").
struct Injection {
  std::string program;
  std::string test;
};

/// A row of the table of faults.
struct Requirement {
  std::string fault;
  std::string reaction;  ///< description of the reaction
  Reaction kind;
  int most;  ///< cycles; -1: not counted in cycles
  std::vector<Injection> injections;
};

/// Returns the whole table in its order; a row without injections is not covered.
const std::vector<Requirement>& requirements();

/// Tells if the reaction that a test has recorded is of this kind: "FADE, STOP" is a stop, and so on.
bool is(Reaction kind, const std::string& seen);

}  // namespace godobject::report
