#pragma once

#include <cstdint>
#include <filesystem>

#include "core/scene/scene_view.h"
#include "toolchain/parallel/parallel.h"

namespace godobject::query {

/// Reads rows `x,y,z` in W [m] and writes `x,y,z,distance,nx,ny,nz,known`. Skips a first row of names; other lines as
/// in CsvLines. Distances are from the still mesh: a ball's image plus its radius. Copies x, y, z as they are written.
/// Returns the number of rows. Throws Failure: kNoInput, kIo, or kBadData naming the line of the first bad row; then
/// there is no output.
std::uint64_t query_points(const SceneView& scene, const std::filesystem::path& points,
                           const std::filesystem::path& output, const parallel::Progress& progress);

}  // namespace godobject::query
