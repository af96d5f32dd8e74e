#pragma once

#include <cstdint>
#include <filesystem>

#include "core/scene/scene.h"
#include "toolchain/parallel/parallel.h"

namespace godobject::query {

/// Reads rows `x,y,z` in W [m] (a first row of names is skipped; lines as CsvLines tells them) and writes
/// `x,y,z,distance,nx,ny,nz,known`, distances from the still mesh: those of a ball's image plus its radius. The numbers
/// x, y, z appear as they came. Returns the number of rows. Throws Failure: kNoInput, kIo, or kBadData naming the line
/// of the first bad row; then there is no output.
std::uint64_t query_points(const Scene& scene, const std::filesystem::path& points, const std::filesystem::path& output,
                           const parallel::Progress& progress);

}  // namespace godobject::query
