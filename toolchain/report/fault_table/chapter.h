#pragma once

#include <filesystem>

#include "toolchain/report/study/case.h"

namespace godobject::report {

/// Runs the tests that inject faults, a case a test program of the folder `tests`; writes faults.csv and faults.html.
/// What a test or its program fails with is in them. Throws Failure: kNoInput where a program is not there.
Chapter fault_chapter(const std::filesystem::path& tests);

}  // namespace godobject::report
