#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "toolchain/scene_compiler/compile_scene.h"

namespace godobject::scene_compiler {

using Json = nlohmann::ordered_json;

/// The report without anything that differs from run to run: it goes into the image. Lengths in metres.
Json report_json(const CompileReport& report);

/// The same with sizes of the whole image and seconds of each phase.
Json full_report_json(const CompileReport& report);

/// One line for people: ready, and what is not as the scene wishes or what the voxels are too coarse for.
std::string verdict_text(const CompileReport& report);

/// A screenful for people; the verdict comes last.
std::string report_text(const CompileReport& report);

/// The facts of a compiled image.
Json inspect_json(const command::SceneImage& image);

}  // namespace godobject::scene_compiler
