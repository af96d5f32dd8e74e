#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

#include "tests/recorded/recorded_motion.h"

/// Prints what the recorded sessions do now: the new recorded_motions.csv. WORK is a folder for scene images.
/// Usage: write_recorded_motions WORK
int main(int argc, char** argv) try {
  if (argc != 2) {
    std::fputs("usage: write_recorded_motions WORK > tests/recorded/recorded_motions.csv\n", stderr);
    return 64;
  }
  using namespace godobject::test;
  std::puts(record_header().c_str());
  for (const RecordedSession& session : recorded_sessions()) {
    std::puts(record_line(session.name, run_recorded(session.setup, argv[1])).c_str());
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "write_recorded_motions: %s\n", error.what());
  return 70;
}
