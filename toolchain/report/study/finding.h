#pragma once

#include <optional>
#include <string>
#include <vector>

namespace godobject::report {

/// A number that was measured, and the most that it may be.
struct Finding {
  std::string row;                  ///< of what is required: "A4"
  std::string what;                 ///< "largest deviation from the exact boundary"
  std::string unit;                 ///< empty: a count or a ratio
  double value = 0.0;               ///< no number: what should have given it failed
  std::optional<double> most = {};  ///< held up to here; nothing: for information
  std::string where = {};           ///< what it was measured on, where it is the worst of several
  std::string not_judged = {};      ///< "not run"; empty: it was measured
  bool timed = false;               ///< by the clock: it differs from run to run
};

/// True where there is nothing to miss.
bool is_held(const Finding& finding);

/// "held", "missed by 1.3 %", "-" without a bound, or why it is not judged.
std::string verdict_text(const Finding& finding);

/// One for each row and quantity, in the order in which they come first: the worst of them.
std::vector<Finding> worst_of(const std::vector<Finding>& findings);

/// "31 rows: 29 held, 1 missed (A5 ...), 1 not run (...)"; findings without a bound do not count.
std::string summary(const std::vector<Finding>& findings);

}  // namespace godobject::report
