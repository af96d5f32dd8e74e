#pragma once

#include <string>
#include <vector>

namespace godobject::report {

/// What must happen.
enum class Reaction {
  kGoesOn,  ///< without any less rendered; what was wrong is counted
  kStop,   ///< nothing rendered, by fading within the cycles allowed or at once; then the drives' quick stop and brakes
  kDrive,  ///< the drives stop by themselves
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
  std::string reaction;  ///< in words
  Reaction kind;
  int most;  ///< cycles; -1: not counted in cycles
  std::vector<Injection> injections;
};

/// The whole table, in its order; a row without injections is not covered.
const std::vector<Requirement>& requirements();

/// "FADE, STOP" is a stop, and so on.
bool is(Reaction kind, const std::string& seen);

}  // namespace godobject::report
