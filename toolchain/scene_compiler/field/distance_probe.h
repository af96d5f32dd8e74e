#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "toolchain/scene_compiler/mesh/solid_surface.h"

namespace godobject::scene_compiler {

/// Signed distance along a walk, equal to SolidSurface::signed_distance but faster. The last answer bounds the next
/// search. The winding number is summed once; then the triangles that the walk crosses are counted. Near an open
/// boundary of the solids it is summed again. Use one probe for each thread.
class DistanceProbe {
 public:
  explicit DistanceProbe(const SolidSurface& surface) : surface_(surface) {}

  /// Begins a walk at a place where another one has been, with its answers: the signed distance to the solids there,
  /// rounded to single precision [m], and winding().
  void start(const Eigen::Vector3d& p, float distance, std::int16_t winding);

  /// Returns the winding number at the last place; nothing where crossings are not counted: for solids that have an
  /// open boundary, are dilated or beside shells.
  std::optional<std::int16_t> winding() const;

  /// `at_most`: some place of a solid's surface is known to be no farther away than this [m]. It saves time.
  double signed_distance(const Eigen::Vector3d& p, double at_most = std::numeric_limits<double>::infinity());

 private:
  bool keeps_side(const Eigen::Vector3d& p, double step) const;
  bool counts_crossings(const Eigen::Vector3d& p, double step);
  void sum_winding(const Eigen::Vector3d& p);
  std::optional<int> change_by_detour(const Eigen::Vector3d& p) const;

  const SolidSurface& surface_;
  Eigen::Vector3d last_ = Eigen::Vector3d::Zero();
  double to_solids_ = -1.0;  ///< at the last point; negative: no answer yet
  double to_shells_ = -1.0;
  bool inside_ = false;
  double path_left_ = 0.0;       ///< until the winding number must be summed again [m]
  double winding_number_ = 0.0;  ///< of the last sum, and the triangles crossed since
  Eigen::Vector3d summed_at_ = Eigen::Vector3d::Zero();
  double travelled_ = 0.0;  ///< since then [m]
};

}  // namespace godobject::scene_compiler
