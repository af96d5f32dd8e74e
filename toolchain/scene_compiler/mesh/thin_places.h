#pragma once

#include <cstdint>

#include "toolchain/parallel/parallel.h"
#include "toolchain/scene_compiler/mesh/solid_surface.h"

namespace godobject::scene_compiler {

/// Walls, or gaps, too thin for the field.
struct ThinPlaces {
  std::uint64_t samples = 0;                     ///< surface samples with a wall or gap thinner than two voxels
  double area = 0.0;                             ///< that they represent, one side counted [m^2]
  double smallest = 0.0;                         ///< smallest thickness [m]; 0 if there are no samples
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  ///< in the middle of it
  double voxel_needed = 0.0;                     ///< voxel edge that resolves it: half of the smallest thickness [m]
  double lost_area = 0.0;       ///< of everything thinner than one voxel, which the field loses, one side counted [m^2]
  double lost_patch = 0.0;      ///< largest connected area thinner than one voxel between nearly parallel faces [m^2]
  double lost_thickness = 0.0;  ///< smallest thickness of that patch [m]
  Eigen::Vector3d lost_at = Eigen::Vector3d::Zero();  ///< its place
};

/// The rule of require_walls_that_last, as text. The number of faces is chosen: the teapot of the demo has a patch of
/// 7.1 voxel faces at its handle (walls in the report of godobject-scenec) and must compile; a plate of 4 x 4 voxels
/// must not.
inline constexpr const char* kRefusalRule =
    "refused when thinner than one voxel between near-parallel faces over a connected patch of more than 12 voxel "
    "faces";
inline constexpr double kRefusedFaces = 12.0;

struct ThinReport {
  ThinPlaces walls;
  ThinPlaces gaps;
  double sample_spacing = 0.0;  ///< square root of the area for each sample [m]
};

/// Finds walls (looking inward) and gaps (looking outward) from samples of the still surface, half a voxel apart.
ThinReport find_thin_places(const SolidSurface& surface, double voxel_size, const parallel::Progress& progress);

/// Throws VoxelTooLarge naming `mesh_name` and the cure if a wall is lost by kRefusalRule. Near-parallel means
/// within ten degrees.
void require_walls_that_last(const ThinReport& report, double voxel_size, const std::string& mesh_name);

}  // namespace godobject::scene_compiler
