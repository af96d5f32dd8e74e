#include <cstdio>
#include <exception>
#include <string>

#include "tests/recorded/recorded_motion.h"

/// Prints what the sessions do now: the new recorded_motions.csv. Leaves out the sessions that a disturbance of the
/// device changes, because another compiler's rounding would change them, too. Where only the work changes, the rest of
/// the line stays.
/// Usage: write_recorded_motions WORK
int main(int argc, char** argv) try {
  if (argc != 2) {
    std::fputs(
        "usage: write_recorded_motions WORK > tests/recorded/recorded_motions.csv\nWORK: folder for scene images\n",
        stderr);
    return 64;
  }
  using namespace godobject::test;
  RecordedWorlds worlds(argv[1]);
  std::puts(record_header().c_str());
  for (const RecordedSession& session : recorded_sessions()) {
    std::string line = record_line(session.name, worlds.run(session.setup));
    std::string changed;
    for (const double disturbance : {1e-12, 1e-11, 1e-10, 1e-9}) {
      const std::string disturbed = record_line(session.name, worlds.run(session.setup, disturbance));
      if (!difference(line, disturbed).empty()) line = without_work(line);
      if (changed.empty()) changed = difference(line, disturbed);
    }
    if (changed.empty()) {
      std::puts(line.c_str());
    } else {
      std::fprintf(stderr, "%s: left out; with a disturbance %s\n", session.name.c_str(), changed.c_str());
    }
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "write_recorded_motions: %s\n", error.what());
  return 70;
}
