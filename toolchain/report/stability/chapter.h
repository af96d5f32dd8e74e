#pragma once

#include "toolchain/report/stability/cases.h"

namespace godobject::report {

/// What the sampled, delayed loop is stable with, in virtual time, against theory. Throws Failure: kNoInput where a
/// device file is missing.
Chapter stability_chapter(const StabilityRequest& request);

}  // namespace godobject::report
