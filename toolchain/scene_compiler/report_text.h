#pragma once

#include <string>

#include "toolchain/scene_compiler/compile_report.h"

namespace godobject::scene_compiler {

/// Returns one line: "ready", or "ready, with limits" and each property of the image that misses the scene's settings.
std::string verdict_text(const CompileReport& report);

/// Returns the report for people, about one screen. The verdict is its last line.
std::string report_text(const CompileReport& report);

}  // namespace godobject::scene_compiler
