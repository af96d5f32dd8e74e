#include "toolchain/report/extremes/bounds.h"

#include "toolchain/report/extremes/setup.h"
#include "toolchain/report/extremes/torque_places.h"

namespace godobject::report::extremes_bound {

Bound of_property(const std::string& row, watch::Property property) {
  return {row, watch::describe(property), "", 0.0};
}

Bound sent_torque(const std::string& place) {
  constexpr double kRounding = 1e-9;
  return {"torque rate, " + place, "change of a joint torque in a cycle, as sent, over the 5 % of its limit", "",
          1.0 + kRounding};
}

Bound idle_runs(const std::string& place) {
  return {"torque rate, " + place, "runs that stopped, or did not reach the place", "", 0.0};
}

Bound computed_torque(const std::string& place) {
  return {"torque rate, " + place, "contact: the same as computed, before the torque limiter", "", 0.5};
}

std::vector<Bound> all() {
  std::vector<Bound> bounds{kNotFinite, kWrongSign, kNotReported, kRefused,  kGap,   kScale,  kOffUnit,
                            kDrift,     kNetWork,   kReplay,      kAccepted, kForce, kChanged};
  std::vector<std::string> rows(kRows, kRows + kRowCount);
  rows.emplace_back("fuzzer");
  for (const std::string& row : rows) {
    for (std::size_t i = 0; i < watch::kPropertyCount; ++i) {
      bounds.push_back(of_property(row, static_cast<watch::Property>(i)));
    }
  }
  for (std::size_t i = 0; i < kPlaceCount; ++i) {
    bounds.push_back(sent_torque(kPlaceNames[i]));
    bounds.push_back(idle_runs(kPlaceNames[i]));
    bounds.push_back(computed_torque(kPlaceNames[i]));
  }
  return bounds;
}

}  // namespace godobject::report::extremes_bound
