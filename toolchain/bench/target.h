#pragma once

#include <string>
#include <vector>

#include "toolchain/bench/table.h"

namespace godobject::bench {

/// A quantity with its wanted and its measured value.
struct Target {
  std::string quantity;
  std::string unit;
  double wanted = 0.0;
  double measured = 0.0;
  bool at_least = false;  ///< otherwise at most

  bool held() const { return at_least ? measured >= wanted : measured <= wanted; }
};

/// Returns a table of the targets with a verdict on each.
Table table_of(const std::vector<Target>& targets);

}  // namespace godobject::bench
