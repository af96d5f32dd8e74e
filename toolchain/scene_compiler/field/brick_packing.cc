#include "toolchain/scene_compiler/field/brick_packing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/parallel/parallel.h"

namespace godobject::scene_compiler {
namespace {

namespace index_entry = format::index_entry;

/// Returns the number of halvings of each brick.
std::vector<int> levels_of(const DistanceGrid& field) {
  std::vector<int> levels(field.bricks.size(), 0);
  const auto walk = [&](const auto& self, std::uint32_t entry, int level) -> void {
    if ((entry & index_entry::kFar) != 0) return;  // or coarse
    const std::uint32_t number = entry & index_entry::kNumber;
    if ((entry & index_entry::kRefined) == 0) {
      levels[number] = level;
      return;
    }
    const format::Refined& refined = field.refined[number];
    if (refined.brick != format::kNoBrick) levels[refined.brick] = level;
    for (const std::uint32_t child : refined.child) self(self, child, level + 1);
  };
  for (const std::uint32_t entry : field.index) walk(walk, entry, 0);
  return levels;
}

double deviation_code(const Brick& brick, double quantum) {
  return std::ceil(static_cast<double>(brick.deviation) / quantum);
}

format::Brick packed(const Brick& brick, double quantum, int level) {
  const double per_unit = std::ldexp(1.0 / quantum, level);
  format::Brick out{};
  for (std::size_t i = 0; i < std::size(brick.value); ++i) {
    out.value[i] = static_cast<std::int16_t>(std::lround(static_cast<double>(brick.value[i]) * per_unit));
  }
  out.lipschitz = format::encode_lipschitz(brick.lipschitz);
  out.deviation = static_cast<std::uint16_t>(deviation_code(brick, quantum));
  out.exact = static_cast<std::uint16_t>(brick.exact);
  return out;
}

bool fits(const Brick& brick, double quantum) {
  return brick.lipschitz <= format::kLargestLipschitz && brick.exact <= format::kLargestUnsigned &&
         deviation_code(brick, quantum) <= format::kLargestUnsigned;
}

}  // namespace

std::vector<format::Brick> packed_bricks(const DistanceGrid& field) {
  const double quantum = field.grid.quantum;
  if (!(quantum <= format::kLargestQuantum * field.grid.voxel_size)) {
    throw command::Failure(
        command::ExitCode::kBadData,
        fmt::format("the band of {:.4g} m is too wide for voxels of {:.4g} m: distances would be "
                    "stored in steps of {:.3g} m; take a smaller safety_distance or a larger voxel_size",
                    field.grid.band, field.grid.voxel_size, quantum));
  }
  for (const Brick& brick : field.bricks) {
    if (fits(brick, quantum)) continue;
    throw command::Failure(
        command::ExitCode::kBadData,
        fmt::format("a brick of the field exceeds a limit of the image: exact brick {} of {}, slope {:.3g} of {:.3g}, "
                    "deviation {:.3g} "
                    "of {:.3g} m; close the mesh, or take a smaller voxel_size or a larger field_tolerance",
                    brick.exact, format::kLargestUnsigned, brick.lipschitz, format::kLargestLipschitz, brick.deviation,
                    quantum * format::kLargestUnsigned));
  }
  const std::vector<int> levels = levels_of(field);
  std::vector<format::Brick> bricks(field.bricks.size());
  parallel::for_each_index(bricks.size(),
                           [&](std::size_t i) { bricks[i] = packed(field.bricks[i], quantum, levels[i]); });
  return bricks;
}

}  // namespace godobject::scene_compiler
