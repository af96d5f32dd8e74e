#pragma once

#include "toolchain/scene_compiler/compile_report.h"
#include "toolchain/scene_compiler/image/image_json.h"

namespace godobject::scene_compiler {

/// Returns the part of the report that is the same in every run. The image stores it as its provenance. Lengths in
/// metres.
Json report_json(const CompileReport& report);

/// Returns the whole report: also the size of the image, times, and the code that a build for this scene leaves out.
Json full_report_json(const CompileReport& report);

/// Returns the code that a build with these traits leaves out of the core, with its size in bytes.
Json left_out_code_json(const SceneTraits& traits);

}  // namespace godobject::scene_compiler
