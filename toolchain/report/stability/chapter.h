#pragma once

#include "toolchain/report/stability/cases.h"

namespace godobject::report {

/// Returns the chapter on the stability of the sampled, delayed loop, in virtual time and compared with theory. Throws
/// Failure: kNoInput if a device file is missing.
Chapter stability_chapter(const StabilityRequest& request);

}  // namespace godobject::report
