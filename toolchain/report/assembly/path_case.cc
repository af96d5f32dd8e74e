#include "toolchain/path/keyframes.h"
#include "toolchain/path/trajectory.h"
#include "toolchain/report/assembly/carried_part.h"
#include "toolchain/report/assembly/cases.h"
#include "toolchain/report/assembly/tally.h"

namespace godobject::report {

CaseResult path_case(const std::string& name, const Pair& pair, const std::filesystem::path& key_frames,
                     int overlap_every, const AssemblyEffort& effort) {
  CarriedPart part(pair, pair.image.scene.settings.friction_kinetic, effort.fault);
  part.watch_overlap(overlap_every);
  bool started = false;
  for (const path::Sample& sample : path::sample(path::read_keyframes(key_frames))) {
    started ? part.follow(sample.pose) : part.start(sample.pose);
    started = true;
  }
  Tally tally(name, pair);
  tally.add(part.carried());
  CaseResult result;
  tally.conclude(result);
  return result;
}

}  // namespace godobject::report
