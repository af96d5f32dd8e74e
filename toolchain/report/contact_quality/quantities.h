#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/scene/format.h"
#include "godobject/scene.h"
#include "toolchain/report/study/bound.h"

namespace godobject::report {

/// The measured quantities, in the order of the table.
enum class Quantity {
  kPenetration,
  kTruePenetrationSmooth,
  kTruePenetrationSharp,
  kCrossings,
  kOptimum,
  kOptimumTight,
  kExcess,
  kSlipTime,
  kDrag,
  kPull,
  kRatio,
  kRatioGroove,
  kDirection,
  kDrift,
  kChatterPlain,
  kChatterElsewhere,
  kChatterOptimum,
  kMovedPose,
  kMovedForce,
  kSolveMedian,
  kSolveP99,
  kFrictionMedian,
  kFrictionP99,
  kCycleMedian,
  kCycleP99,
  kSubstepsMean,
  kSubstepsMax,
};

/// Name, unit and target of a quantity.
struct QuantitySpec {
  Quantity id;
  const char* key;    ///< name in files
  const char* title;  ///< name in the table
  const char* unit;
  std::optional<double> target;  ///< `contact` holds it if the value is not above it; nullopt: for information
  int decimals;
  bool median;                      ///< the value of a solver is the median over the scenes, not the worst
  const char* if_missed = nullptr;  ///< the known reason if `contact` misses the target
};

const std::vector<QuantitySpec>& quantities();
const QuantitySpec& spec(Quantity id);

/// Returns the bound of a quantity with a target: that of `contact`.
Bound bound_of(const QuantitySpec& quantity);

/// The worst value of a quantity within a scene.
struct Measurement {
  std::string scene;
  std::string world;
  format::Solver solver = format::Solver::kPaper;
  Quantity quantity = Quantity::kPenetration;
  double value = 0.0;
};

/// A quantity of one solver over all scenes.
struct Verdict {
  double value = 0.0;
  std::string worst_scene;  ///< scene with the worst value; empty for 0
  bool held = true;         ///< true without a target
};

/// Returns the verdict on a quantity of a solver; nullopt if no scene measured it. NaN is the worst value.
std::optional<Verdict> judge(const std::vector<Measurement>& measurements, Quantity quantity, format::Solver solver);

}  // namespace godobject::report
