#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/pipeline/contact/contact_cycle.h"
#include "core/pipeline/cycle/parameters.h"
#include "toolchain/precision/mesh_field.h"
#include "toolchain/precision/trace.h"
#include "toolchain/scene_compiler/mesh/box.h"
#include "toolchain/scene_compiler/points/moving_body.h"
#include "toolchain/scene_compiler/points/still_features.h"

namespace godobject::precision {

/// A scene without voxels, by which settings are judged: exact distances to both meshes, and dense points on both that
/// do not depend on the setting.
class ExactScene {
 public:
  /// `points`: number on each body. Throws Failure (kNoInput, kBadData) if a mesh cannot be used.
  ExactScene(const scene_compiler::SceneConfig& config, std::uint32_t points);
  ExactScene(const ExactScene&) = delete;
  ExactScene& operator=(const ExactScene&) = delete;

  /// Returns the reference: the cycles of the solver `contact` along the paths on the exact distances, with all points
  /// of both bodies and a margin of a thousandth of the voxel edge. Cost: some milliseconds for each cycle.
  std::vector<TracedCycle> reference(const Paths& paths, bool friction) const;

  /// Returns the depth of the deepest point of either body in the other's mesh at a pose of the moving mesh's frame
  /// [m]; 0 if none is inside.
  double penetration(const Pose& H_WM) const;

  /// Returns the smallest distance of the moving body's points to the still mesh, and of the still body's points to the
  /// moving one [m]; negative inside.
  double clearance(const Pose& H_WM) const;

  const MeshField& still() const { return still_field_; }
  const Pointshell& points() const { return points_; }  ///< of the moving body, in B
  const Pose& H_MB() const { return H_MB_; }
  const Parameters& parameters() const { return parameters_; }

  /// Return the boxes around the bodies: the still one's in W, the moving one's in M.
  const scene_compiler::Box& still_box() const { return still_box_; }
  const scene_compiler::Box& moving_box() const { return moving_box_; }

 private:
  FeatureContacts<MeshField> feature_contacts() const;
  double smallest(const Pose& H_WM, double cutoff) const;

  scene_compiler::SolidSurface still_;
  scene_compiler::SolidSurface moving_;  ///< in the mesh's frame M
  scene_compiler::Box still_box_;
  scene_compiler::Box moving_box_;
  scene_compiler::MovingBody body_;
  scene_compiler::StillFeatures features_;
  Pose H_MB_;
  scene_compiler::SolidSurface body_surface_;  ///< the moving one in B
  MeshField still_field_;
  MeshField body_field_;
  Pointshell points_;
  Pointshell feature_points_;
  double body_radius_ = 0.0;
  Parameters parameters_;
};

}  // namespace godobject::precision
