#pragma once

#include <optional>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include "core/pipeline/cycle/scene_traits.h"
#include "core/scene/format.h"
#include "toolchain/files/scene_image.h"

/// The contents of a scene image as JSON, for the report and for `godobject-scenec --inspect`. Lengths in metres.
namespace godobject::scene_compiler {

using Json = nlohmann::ordered_json;

const char* section_name(format::SectionId id);

Json vector_json(const Eigen::Vector3d& v);
Json settings_json(const format::Settings& settings);
Json workspace_json(const std::optional<format::Workspace>& workspace);
Json traits_json(const SceneTraits& traits);
Json grid_json(const format::Grid& grid);
Json body_json(const format::Body& body);

/// Returns the contents of an opened image: header, settings, grid, body, sections, build traits and provenance.
Json inspect_json(const files::SceneImage& image);

}  // namespace godobject::scene_compiler
