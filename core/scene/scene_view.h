#pragma once

#include <cstddef>
#include <span>

#include "core/scene/format.h"
#include "core/scene/pointshell.h"
#include "core/scene/sharp_edges.h"
#include "core/scene/voxelmap.h"
#include "core/scene/workspace_box.h"
#include "godobject/pose.h"
#include "godobject/scene.h"
#include "godobject/status.h"

namespace godobject {

/// A validated scene image, read in place: settings, the still body's voxelmap, the moving body's pointshell and mass,
/// where the image has it the other direction: feature points of the still body, voxelmap of the moving one; and where
/// the image has them the sharp edges of both bodies.
/// A view of the bytes it was opened on, which must stay where they are and unchanged.
struct SceneView {
  format::Settings settings{};
  format::Grid grid{};
  format::Body body{};
  WorkspaceBox workspace;
  Voxelmap voxelmap;
  Pointshell pointshell;
  Voxelmap body_map;    ///< of the moving body, in B; only with features
  Pointshell features;  ///< of the still body, in frame F: W shifted to `features_origin`
  Vector3 features_origin = Vector3::Zero();
  SharpEdges edges;                       ///< of the still body, in W; empty if one of the bodies has none
  SharpEdges body_edges;                  ///< of the moving body, in B
  Pose H_MB;                              ///< body frame (centre of mass, principal axes) in the moving mesh's frame
  std::span<const std::byte> provenance;  ///< UTF-8 JSON, for people

  /// Checks the whole image once (checksums, layout, every index and every number) and fills the view.
  /// `image` must begin at a multiple of format::kAlignment. Cost: one pass over the bytes, about 1 ms per MiB; no
  /// allocation. kImageTruncated, kImageForeign, kImageVersion, kImageChecksum, kImageLayout, kImageValue: see Status;
  /// `scene` is unchanged.
  static Status open(std::span<const std::byte> image, SceneView& scene) noexcept;

  format::Solver default_solver() const noexcept { return static_cast<format::Solver>(settings.default_solver); }
  bool has_features() const noexcept { return features.size > 0; }
  bool has_edges() const noexcept { return !edges.empty(); }
  bool holds(format::Solver solver) const noexcept {
    return (settings.solvers >> static_cast<std::uint32_t>(solver)) & 1u;
  }
};

/// Tells whether stiffness, damping and rotational stiffness are within the ranges of an image.
bool valid_gains(const format::Settings& settings) noexcept;
/// True if a period is within the range of Settings::period [s].
bool valid_period(double period) noexcept;

}  // namespace godobject
