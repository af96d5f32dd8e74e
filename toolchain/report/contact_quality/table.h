#pragma once

#include <string>
#include <vector>

#include "toolchain/report/contact_quality/quantities.h"

namespace godobject::report {

/// "held", "missed by 1.3 mm", "-" without a target, "not run" without `contact`: the targets are those of `contact`.
std::string verdict_text(const QuantitySpec& quantity, const std::optional<Verdict>& contact);

/// One line a quantity: target, a column a solver, where `contact` is worst, verdict. Fixed width.
std::string text_table(const std::vector<Measurement>& measurements);

/// Lines: why targets are missed that are, how many scenes the table stands on, and what its words mean.
std::string notes(const std::vector<Measurement>& measurements);

/// quantity,unit,target,paper,corrected,contact,worst_scene_paper,..,verdict
std::string summary_csv(const std::vector<Measurement>& measurements);

/// scene,world,solver,quantity,unit,value,target,verdict; one row each.
std::string measurements_csv(const std::vector<Measurement>& measurements);

}  // namespace godobject::report
