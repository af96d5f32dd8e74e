#pragma once

#include <cstdint>

#include "toolchain/parallel/parallel.h"
#include "toolchain/scene_compiler/mesh/solid_surface.h"

namespace godobject::scene_compiler {

/// Walls, or gaps, that are thinner than the field can show.
struct ThinPlaces {
  std::uint64_t samples = 0;                     ///< surface samples that see one thinner than two voxels
  double area = 0.0;                             ///< that they stand for, one side counted [m^2]
  double smallest = 0.0;                         ///< smallest thickness [m]; 0 samples: 0
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  ///< in the middle of it
  double voxel_needed = 0.0;                     ///< voxel edge that holds it: half of the smallest thickness [m]
  double lost_area = 0.0;   ///< of all that is thinner than one voxel, which the field loses, one side counted [m^2]
  double lost_patch = 0.0;  ///< largest connected area thinner than one voxel between nearly parallel faces [m^2]
  double lost_thickness = 0.0;                        ///< smallest thickness of that patch [m]
  Eigen::Vector3d lost_at = Eigen::Vector3d::Zero();  ///< where
};

/// The rule of require_walls_that_last, for people.
inline constexpr const char* kRefusalRule =
    "refused when thinner than one voxel between near-parallel faces over a connected patch of more than 12 voxel "
    "faces";
inline constexpr double kRefusedFaces = 12.0;

struct ThinReport {
  ThinPlaces walls;
  ThinPlaces gaps;
  double sample_spacing = 0.0;  ///< square root of the area that one sample stands for [m]
};

/// Looks inward (walls) and outward (gaps) from samples of the still surface, half a voxel apart.
ThinReport find_thin_places(const SolidSurface& surface, double voxel_size, const parallel::Progress& progress);

/// Throws Failure (kBadData), naming `mesh_name` and the cure, if a wall is lost by kRefusalRule. Near-parallel: within
/// ten degrees.
void require_walls_that_last(const ThinReport& report, double voxel_size, const std::string& mesh_name);

}  // namespace godobject::scene_compiler
