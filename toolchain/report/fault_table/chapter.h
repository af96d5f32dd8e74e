#pragma once

#include <filesystem>

#include "toolchain/report/study/case.h"

namespace godobject::report {

/// Returns the chapter that runs the tests which inject faults, one case per test program of the folder `tests`. It
/// writes faults.csv and faults.html, with the messages of failed tests and programs. Throws Failure: kNoInput if a
/// program is missing.
Chapter fault_chapter(const std::filesystem::path& tests);

}  // namespace godobject::report
