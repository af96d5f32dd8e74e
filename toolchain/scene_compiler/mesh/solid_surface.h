#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "toolchain/scene_compiler/mesh/triangle_mesh.h"
#include "toolchain/scene_compiler/mesh/triangle_tree.h"

namespace godobject::scene_compiler {

enum class SurfaceKind { kAuto, kSolid, kShell };

/// A mesh as a body: which of its components enclose a solid and which are thickened shells, with exact distance and
/// winding number anywhere. All queries are const and may run on many threads.
class SolidSurface {
 public:
  struct Component {
    bool shell = false;       ///< thickened: phi = |d| - thickness / 2
    bool inside_out = false;  ///< its triangles wind the wrong way round; taken with the other sign
    std::uint32_t triangles = 0;
    double winding = 0.0;  ///< principal value of the whole mesh's winding number on the component: see classify
  };

  struct Closest {
    double distance = 0.0;  ///< unsigned, to the nearest triangle [m]; infinity where p is not finite
    Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< on that triangle
    std::uint32_t triangle = 0;
  };

  /// `thickness` of shells [m]. `dilation` [m]: the body is taken with all that is this near to it, every distance is
  /// less by it; inside that is exact only of convex solids, which it is for.
  SolidSurface(TriangleMesh mesh, SurfaceKind kind, double thickness, double dilation = 0.0);
  SolidSurface(SolidSurface&& other) noexcept;
  ~SolidSurface();

  const TriangleMesh& mesh() const;
  const std::vector<Component>& components() const;
  const std::vector<std::uint32_t>& component_of_triangle() const;
  double thickness() const;
  double dilation() const;

  /// Signed distance, positive outside: of solid components |d| with the sign of (winding number > 0.5 is inside), of
  /// shells |d| - thickness / 2, the smaller of both; less the dilation. `hint` (if not negative) is an upper bound of
  /// the unsigned distance to any triangle.
  double signed_distance(const Eigen::Vector3d& p, double hint = -1.0) const;

  /// Nearest triangle of any component.
  Closest closest(const Eigen::Vector3d& p, double hint = -1.0) const;

  /// Generalised winding number of the solid components: 1 inside, 0 outside of closed ones.
  double winding_number(const Eigen::Vector3d& p) const;

  /// Whether the solid components together have no open boundary.
  bool sealed() const;

  /// How far one may go from p, without crossing a solid's triangle, before the winding number can pass 1/2 [m]. Along
  /// such a path the winding number changes by at most L / (4 pi r^2) a metre, L the length of the open boundary and r
  /// the distance from it (Biot and Savart); infinity where the solids are sealed.
  double constant_side_path(const Eigen::Vector3d& p, double winding_number) const;

  /// Unsigned distance to the triangles of one kind; infinity if there are none. `hint` as above, for that kind.
  double distance_to_solids(const Eigen::Vector3d& p, double hint = -1.0) const;
  double distance_to_shells(const Eigen::Vector3d& p, double hint = -1.0) const;

  /// Triangles of one kind as a tree, ids those of `mesh()`; those of an inside-out component turned round.
  const TriangleTree& solid_triangles() const;
  const TriangleTree& shell_triangles() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace godobject::scene_compiler
