#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/scene/format.h"
#include "godobject/scene.h"

namespace godobject::report {

/// What is measured; the order is that of the table.
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

/// How one quantity is read.
struct QuantitySpec {
  Quantity id;
  const char* key;    ///< in files
  const char* title;  ///< in the table
  const char* unit;
  std::optional<double> target;  ///< held by `contact` if the value is not above it; nothing: for information
  int decimals;
  bool median;                      ///< the solver's figure is the median over the scenes, not the worst
  const char* if_missed = nullptr;  ///< why `contact` may miss the target, as far as that is known
};

const std::vector<QuantitySpec>& quantities();
const QuantitySpec& spec(Quantity id);

/// One measured value: the worst within a scene.
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
  std::string worst_scene;  ///< where the value is the worst one; empty for 0
  bool held = true;         ///< true where there is no target
};

/// Nothing where no scene measured it. A value that is no number is the worst there is.
std::optional<Verdict> judge(const std::vector<Measurement>& measurements, Quantity quantity, format::Solver solver);

}  // namespace godobject::report
