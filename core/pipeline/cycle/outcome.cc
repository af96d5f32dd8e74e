#include "godobject/report.h"

namespace godobject {

const char* name(Outcome outcome) noexcept {
  switch (outcome) {
    case Outcome::kFree: return "free";
    case Outcome::kContact: return "contact";
    case Outcome::kStartInside: return "start_inside";
    case Outcome::kCut: return "cut";
    case Outcome::kOverflow: return "overflow";
    case Outcome::kBadInput: return "bad_input";
    case Outcome::kInfeasible: return "infeasible";
  }
  return "unknown";
}

}  // namespace godobject
