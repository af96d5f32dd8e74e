#pragma once

#include <string>
#include <utility>

#include "toolchain/report/assembly/carried_part.h"
#include "toolchain/report/study/case.h"

namespace godobject::report {

/// The counts of all runs of a case on a pair: which cycles did not end normally, and how deep the exact meshes
/// overlapped.
class Tally {
 public:
  Tally(std::string name, const Pair& pair) : name_(std::move(name)), accuracy_(pair.accuracy) {}

  void add(const Carried& carried);

  /// Adds the findings of every pair, and a row of the sheet assembly_cycles.
  void conclude(CaseResult& result) const;

 private:
  std::string name_;
  double accuracy_;
  Carried all_;
};

}  // namespace godobject::report
