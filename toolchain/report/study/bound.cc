#include "toolchain/report/study/bound.h"

#include <algorithm>

#include <fmt/format.h>

namespace godobject::report {

Finding judged(const Bound& bound, double value, const std::string& where) {
  return {.row = bound.row,
          .what = bound.what,
          .unit = bound.unit,
          .value = value,
          .most = bound.most,
          .where = where,
          .not_judged = {},
          .timed = bound.timed};
}

std::string without_bound(const std::vector<Finding>& findings, const std::vector<Bound>& bounds) {
  std::string text;
  for (const Finding& finding : findings) {
    if (!finding.most) continue;
    const bool listed = std::any_of(bounds.begin(), bounds.end(), [&](const Bound& bound) {
      return bound.row == finding.row && bound.what == finding.what && bound.most == *finding.most;
    });
    if (!listed) text += fmt::format("{}: {} is not in the list of bounds. ", finding.row, finding.what);
  }
  return text;
}

}  // namespace godobject::report
