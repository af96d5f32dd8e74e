#include "toolchain/report/contact_quality/quantities.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "toolchain/report/contact_quality/signals.h"
#include "toolchain/statistics/samples.h"

namespace godobject::report {
namespace {

constexpr std::nullopt_t kNone = std::nullopt;
constexpr const char* kBusy = "times grow on a busy machine; repeat on an idle one";

}  // namespace

const std::vector<QuantitySpec>& quantities() {
  using enum Quantity;
  static const std::vector<QuantitySpec> kQuantities = {
      {kPenetration, "penetration", "penetration (field)", "mm", 0.0, 4, false},
      {kTruePenetrationSmooth, "true_penetration_smooth", "penetration (mesh), smooth", "voxels", 0.001, 3, false},
      {kTruePenetrationSharp, "true_penetration_sharp", "penetration (mesh), sharp", "voxels", 0.001, 3, false},
      {kCrossings, "crossings", "crossings of plate and sheet", "points", 0.0, 0, false},
      {kOptimum, "optimum_distance", "distance to the optimum", "mm", 0.04, 4, false,
       "a body in a groove keeps the margin m from both walls: a distance of m / sin(half the angle), 0.04 mm at 60 "
       "degrees"},
      {kOptimumTight, "optimum_distance_tight", "optimum, slot, peg and L", "mm", 0.25, 4, false},
      {kExcess, "optimum_excess", "longer than the best optimum", "mm", kNone, 4, false},
      {kSlipTime, "slip_time", "delay after an edge at 1 m/s", "ms", 1.0, 0, false},
      {kDrag, "drag", "drag, frictionless", "N", 0.02, 4, false},
      {kPull, "pull", "pull on retreat", "N", 0.0, 4, false},
      {kRatio, "friction_ratio_error", "friction ratio, plane", "%", 0.5, 3, false},
      {kRatioGroove, "friction_ratio_error_groove", "friction ratio, V-groove", "%", 1.0, 3, false},
      {kDirection, "friction_direction_error", "friction direction", "deg", 0.5, 3, false},
      {kDrift, "stick_drift", "stick drift, 8-12 Hz tremor", "um", 1.0, 3, false},
      {kChatterPlain, "chatter_plain", "chatter, convex and flat", "N", 0.01, 4, false,
       "the sample points form a polyhedron, which snaps from facet to facet; compare the chatter of the optimum "
       "itself"},
      {kChatterElsewhere, "chatter_elsewhere", "chatter, elsewhere", "N", 0.1, 4, false},
      {kChatterOptimum, "chatter_optimum", "chatter of the optimum itself", "N", kNone, 4, false},
      {kMovedPose, "moved_pose", "turned, shifted 10 m: pose", "um", 1.7e-6, 4, false},
      {kMovedForce, "moved_force", "turned, shifted 10 m: force", "mN", 6.5e-7, 4, false},
      {kSolveMedian, "solve_median", "solver, median", "us", 0.5, 2, true, kBusy},
      {kSolveP99, "solve_p99", "solver, p99", "us", 3.0, 2, true, kBusy},
      {kFrictionMedian, "solve_friction_median", "with friction, median", "us", 3.0, 2, true, kBusy},
      {kFrictionP99, "solve_friction_p99", "with friction, p99", "us", 8.0, 2, true, kBusy},
      {kCycleMedian, "cycle_median", "whole cycle, median", "us", kNone, 2, true},
      {kCycleP99, "cycle_p99", "whole cycle, p99", "us", kNone, 2, true},
      {kSubstepsMean, "substeps_mean", "sub-steps, mean", "", kNone, 2, true},
      {kSubstepsMax, "substeps_max", "sub-steps, most", "", kNone, 0, false},
  };
  return kQuantities;
}

const QuantitySpec& spec(Quantity id) {
  const auto& all = quantities();
  return *std::find_if(all.begin(), all.end(), [id](const QuantitySpec& q) { return q.id == id; });
}

Bound bound_of(const QuantitySpec& quantity) {
  return {quantity.title, "contact", quantity.unit, *quantity.target, std::string_view(quantity.unit) == "us"};
}

std::optional<Verdict> judge(const std::vector<Measurement>& measurements, Quantity quantity, format::Solver solver) {
  const QuantitySpec& wanted = spec(quantity);
  Verdict verdict;
  std::vector<double> values;
  for (const Measurement& m : measurements) {
    if (m.quantity != quantity || m.solver != solver) continue;
    const bool worse = values.empty() || std::isnan(m.value) || m.value > verdict.value;
    values.push_back(m.value);
    if (wanted.median || !worse || std::isnan(verdict.value)) continue;
    verdict.value = m.value;
    if (m.value != 0.0) verdict.worst_scene = m.scene + " (" + m.world + ")";
  }
  if (values.empty()) return std::nullopt;
  if (wanted.median) verdict.value = percentile(values, 0.5);
  verdict.held = !wanted.target || verdict.value <= *wanted.target;
  return verdict;
}

}  // namespace godobject::report
