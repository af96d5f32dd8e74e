#pragma once

#include <gtest/gtest.h>

#include <string>

namespace godobject::test {

/// The measured reaction of the controller to a fault that a test injected.
struct SeenFault {
  std::string reaction;  ///< "goes on", "STOP", "FADE, STOP", "DRIVE", "REFUSE", "ends"
  std::string found;     ///< the controller's message about the fault, or its counters
  std::string after;     ///< the modes that followed; torques and brakes at the end
  int cycles = -1;       ///< number of cycles from the cause to the reaction, both included; -1: not counted
};

/// Writes `seen` into the result of the running test, for the table of faults of godobject-report. Call it once a test.
inline void record(const SeenFault& seen) {
  testing::Test::RecordProperty("fault_reaction", seen.reaction);
  testing::Test::RecordProperty("fault_found", seen.found);
  testing::Test::RecordProperty("fault_after", seen.after);
  testing::Test::RecordProperty("fault_cycles", seen.cycles);
}

/// Records a start of the controller that ended with `exit_code` and the message `words`.
inline void record_start(int exit_code, const std::string& words) {
  const bool refused = exit_code == 65 || exit_code == 69 || exit_code == 77 || exit_code == 78;
  record({.reaction = refused ? "REFUSE" : "starts",
          .found = words,
          .after = "exit " + std::to_string(exit_code),
          .cycles = -1});
}

}  // namespace godobject::test
