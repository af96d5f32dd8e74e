#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "core/scene/format.h"
#include "toolchain/scene_compiler/field/refinement.h"
#include "toolchain/scene_compiler/mesh/solid_surface.h"

namespace godobject::scene_compiler {

/// The settings of a scene file, checked, with defaults filled in. SI units.
struct SceneConfig {
  struct Mesh {
    std::filesystem::path file;  ///< relative to the working directory, or absolute
    std::string name;            ///< as written in the scene file
    double scale = 1.0;          ///< mesh unit -> metre
    SurfaceKind surface = SurfaceKind::kAuto;
  };

  Mesh still;
  double voxel_size = 0.0;      ///< s [m]
  bool chooses_voxels = false;  ///< the file states an accuracy and no still.voxel_size: the compiler chooses it
  double thickness = 0.0;       ///< of shells [m]
  /// Largest depth of the stored surface inside a body; outside it 5 times as much [voxels]
  double field_tolerance = 0.0;
  /// In place of field_tolerance: largest distance between the stored surfaces and the meshes', on either side [m]
  std::optional<double> accuracy;
  Mesh moving;
  double body_voxel_size = 0.0;      ///< of the moving body's own field [m]
  bool chooses_body_voxels = false;  ///< nor moving.voxel_size
  bool ball = false;                 ///< the moving mesh is a ball, to be rendered by its centre alone
  std::uint32_t points = 0;          ///< no meaning for a ball, like the next three members
  std::uint32_t levels = 0;
  std::optional<bool> edges;                   ///< edge against edge; not set: if edges are few
  bool both_directions = true;                 ///< also feature points of the still body in the moving body's field
  double between_points = 0.0;                 ///< wanted bound of the penetration between points [m]
  std::optional<format::Workspace> workspace;  ///< box that the moving body's centre of mass does not leave, in W
  format::Settings settings{};

  /// Returns how far the surface in the moving body's own field may lie from the mesh's [m]. That field is smaller by
  /// the tolerance outside, so that only half of an accuracy is left to its errors.
  SurfaceTolerance moving_tolerance() const {
    const SurfaceTolerance tolerance = surface_tolerance(body_voxel_size);
    return accuracy ? tolerance.times(0.5) : tolerance;
  }

  /// Returns how far the surface in a field with this voxel edge may lie from the mesh's [m].
  SurfaceTolerance surface_tolerance(double voxel_edge) const {
    if (accuracy) return {*accuracy, *accuracy};
    return SurfaceTolerance::of_depth(field_tolerance * voxel_edge);
  }
};

/// Voxel edges for a scene file that leaves them to the compiler [m].
struct VoxelSizes {
  std::optional<double> still;   ///< not set: a first guess from the accuracy
  std::optional<double> moving;  ///< not set: as the still body's
};

/// Reads and checks a scene file. `chosen` stands for voxel edges that a file with an accuracy leaves out; other
/// lengths have defaults that follow them. Throws Failure: kNoInput if it cannot be read; kBadConfig naming file, line
/// and key for an unknown key, a missing key, a wrong type or a value out of range.
SceneConfig read_scene_config(const std::filesystem::path& file, const VoxelSizes& chosen = {});

}  // namespace godobject::scene_compiler
