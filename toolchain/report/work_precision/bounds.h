#pragma once

#include <string>
#include <vector>

#include "toolchain/report/study/bound.h"

/// The judged quantities of the chapter on precision. The bounds of the errors are three to five times the measured
/// ones.
namespace godobject::report {

inline constexpr double kBudget_us = 20.0;
inline constexpr const char* kRecommended = "recommended";

/// Errors of the solver `contact` with a setting against the reference.
struct ErrorBounds {
  Bound force;        ///< [% of the reference]
  Bound torque;       ///< [% of the reference]
  Bound penetration;  ///< [mm]
};

/// `setting`: "as written", "plain" (not refined, one direction), or kRecommended, which has friction.
ErrorBounds error_bounds(const std::string& scene, const std::string& setting, bool friction);

/// Returns the bound of the recommended setting's cost, measured for a second time.
Bound cost_bound(const std::string& scene);

/// Returns the bound of the error of `contact` over that of `paper`.
Bound paper_bound(const std::string& scene);

std::vector<Bound> precision_bounds();

}  // namespace godobject::report
