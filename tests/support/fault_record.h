#pragma once

#include <gtest/gtest.h>

#include <string>

namespace godobject::test {

/// What a test has seen of the reaction to a fault that it injected: measured, not expected.
struct SeenFault {
  std::string reaction;  ///< "goes on", "STOP", "FADE, STOP", "DRIVE", "REFUSE", "ends"
  std::string found;     ///< the fault in the words of the controller, or what it has counted
  std::string after;     ///< modes that followed, torques and brakes at the end
  int cycles = -1;       ///< from the cause to the reaction, the cause's own being the first; -1: none to count
};

/// Into the result of the running test, where the table of faults (godobject-report) finds it. Once a test.
inline void record(const SeenFault& seen) {
  testing::Test::RecordProperty("fault_reaction", seen.reaction);
  testing::Test::RecordProperty("fault_found", seen.found);
  testing::Test::RecordProperty("fault_after", seen.after);
  testing::Test::RecordProperty("fault_cycles", seen.cycles);
}

/// A start that ended with an exit code.
inline void record_start(int exit_code, const std::string& words) {
  const bool refused = exit_code == 65 || exit_code == 69 || exit_code == 77 || exit_code == 78;
  record({.reaction = refused ? "REFUSE" : "starts",
          .found = words,
          .after = "exit " + std::to_string(exit_code),
          .cycles = -1});
}

}  // namespace godobject::test
