#pragma once

#include <string>

#include "toolchain/scene_compiler/compile_report.h"

namespace godobject::scene_compiler {

/// One line: "ready", and each limit of the image that the scene did not ask for.
std::string verdict_text(const CompileReport& report);

/// The report for people, about one screen. The verdict is its last line.
std::string report_text(const CompileReport& report);

}  // namespace godobject::scene_compiler
