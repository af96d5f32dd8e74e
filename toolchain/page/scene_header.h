#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/scene/format.h"
#include "toolchain/page/column_pack.h"
#include "toolchain/viewer/camera.h"
#include "toolchain/viewer/scene_bodies.h"

namespace godobject::page {

/// Bodies, names and workspace of a scene, as a page shows them.
struct PageBodies {
  viewer::SceneBodies bodies;
  std::string still_name, moving_name;
  std::optional<format::Workspace> workspace;  ///< box of the moving body's centre of mass, in W [m]
  int up_axis = 2;                             ///< axis of W that points up: 0 .. 2
};

/// Reads the bodies, their names and the workspace of a scene file. Throws as viewer::read_scene_bodies.
PageBodies read_page_bodies(const std::filesystem::path& scene_file);

/// Largest number of triangles of a body: the page stays below ten megabytes.
inline constexpr std::size_t kMaxTriangles = 500'000;

/// Returns the keys of a page's header that belong to the scene (README.md), with their columns in `pack`. `shown`: one
/// or more placements that the camera shows; these and `zoom` as in viewer::View. Vertices are rounded to 1 / 65535 of
/// the bounding box. Throws Failure (kBadData) if a body has more than kMaxTriangles triangles.
nlohmann::json scene_header(const PageBodies& scene, std::vector<viewer::Placement> shown, ColumnPack& pack,
                            double zoom = 1.0);

/// Returns the data of a page: the length of the header (four bytes, lowest first), the header (JSON), and the columns
/// that it refers to.
std::string packed(const nlohmann::json& header, const ColumnPack& pack);

}  // namespace godobject::page
