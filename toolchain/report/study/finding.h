#pragma once

#include <optional>
#include <string>
#include <vector>

namespace godobject::report {

/// A measured number and its upper bound.
struct Finding {
  std::string row;                  ///< name of the requirement: "A4"
  std::string what;                 ///< "largest deviation from the exact boundary"
  std::string unit;                 ///< empty: a count or a ratio
  double value = 0.0;               ///< NaN: the measurement failed
  std::optional<double> most = {};  ///< held up to this value; nullopt: for information
  std::string where = {};           ///< where it was measured, if it is the worst of several
  std::string not_judged = {};      ///< "not run"; empty: it was measured
  bool timed = false;               ///< measured by the clock; differs from run to run
};

/// Tells if the finding is within its bound; true without a bound.
bool is_held(const Finding& finding);

/// Returns "held", "missed by 1.3 %", "-" without a bound, or the reason for no verdict.
std::string verdict_text(const Finding& finding);

/// Returns the worst finding of each row and quantity, in the order of their first occurrence.
std::vector<Finding> worst_of(const std::vector<Finding>& findings);

/// Returns a summary such as "31 rows: 29 held, 1 missed (A5 ...), 1 not run (...)"; findings without a bound do not
/// count.
std::string summary(const std::vector<Finding>& findings);

}  // namespace godobject::report
