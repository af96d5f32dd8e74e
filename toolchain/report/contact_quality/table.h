#pragma once

#include <string>
#include <vector>

#include "toolchain/report/contact_quality/quantities.h"

namespace godobject::report {

/// Returns "held", "missed by 1.3 mm", "-" without a target, or "not run" without `contact`; the targets are those of
/// `contact`.
std::string verdict_text(const QuantitySpec& quantity, const std::optional<Verdict>& contact);

/// Returns a table of fixed width with one line per quantity: target, one column per solver, verdict, and the worst
/// scene of `contact`.
std::string text_table(const std::vector<Measurement>& measurements);

/// Returns notes below the table: reasons for missed targets, number of scenes, and explanations of the terms.
std::string notes(const std::vector<Measurement>& measurements);

/// Returns CSV: quantity,unit,target,paper,corrected,contact,worst_scene_paper,..,verdict
std::string summary_csv(const std::vector<Measurement>& measurements);

/// Returns CSV with one row per measurement: scene,world,solver,quantity,unit,value,target,verdict
std::string measurements_csv(const std::vector<Measurement>& measurements);

}  // namespace godobject::report
