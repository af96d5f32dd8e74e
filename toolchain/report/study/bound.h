#pragma once

#include <string>
#include <vector>

#include "toolchain/report/study/finding.h"

namespace godobject::report {

/// A judged quantity of a chapter and its upper bound. A planted fault of tests/report misses each of them.
struct Bound {
  std::string row;   ///< name of the requirement: "A4"
  std::string what;  ///< "largest deviation from the exact boundary"
  std::string unit;  ///< empty: a count or a ratio
  double most = 0.0;
  bool timed = false;  ///< measured by the clock
};

/// Returns the finding of a measured value.
Finding judged(const Bound& bound, double value, const std::string& where = "");

/// Returns a sentence for each judged finding without its bound in the list, empty if there is none.
std::string without_bound(const std::vector<Finding>& findings, const std::vector<Bound>& bounds);

}  // namespace godobject::report
