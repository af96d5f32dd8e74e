#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "toolchain/scene_compiler/mesh/triangle_mesh.h"
#include "toolchain/scene_compiler/mesh/triangle_tree.h"

namespace godobject::scene_compiler {

enum class SurfaceKind { kAuto, kSolid, kShell };

/// A mesh as a body. Each of its components is either a solid or a thickened shell. Gives the exact distance and
/// winding number at any point. Queries may run on many threads.
class SolidSurface {
 public:
  struct Component {
    bool shell = false;       ///< thickened: phi = |d| - thickness / 2
    bool inside_out = false;  ///< its triangles wind the wrong way round; its distances count with the other sign
    std::uint32_t triangles = 0;
    double winding = 0.0;  ///< principal value of the whole mesh's winding number on the component: see classify()
  };

  struct Closest {
    double distance = 0.0;  ///< unsigned, to the nearest triangle [m]; infinity if p is not finite
    Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< on that triangle
    std::uint32_t triangle = 0;
  };

  /// `thickness` of shells [m]. `dilation` [m]: adds everything within this distance to the body, so every distance is
  /// smaller by it. Inside the body that is exact only for convex solids.
  SolidSurface(TriangleMesh mesh, SurfaceKind kind, double thickness, double dilation = 0.0);
  SolidSurface(SolidSurface&& other) noexcept;
  ~SolidSurface();

  const TriangleMesh& mesh() const;
  const std::vector<Component>& components() const;
  const std::vector<std::uint32_t>& component_of_triangle() const;
  double thickness() const;
  double dilation() const;

  /// Returns the signed distance, positive outside: the smaller one of |d| to the solid components, negative where the
  /// winding number is above 0.5, and |d| - thickness / 2 to the shells; less the dilation. `hint`, if not negative, is
  /// an upper bound of the unsigned distance to any triangle.
  double signed_distance(const Eigen::Vector3d& p, double hint = -1.0) const;

  /// Returns the nearest triangle of any component.
  Closest closest(const Eigen::Vector3d& p, double hint = -1.0) const;

  /// Returns the generalised winding number of the solid components: 1 inside, 0 outside of closed ones.
  double winding_number(const Eigen::Vector3d& p) const;

  /// True if the solid components together have no open boundary.
  bool sealed() const;

  /// True if the surface is that of sealed solids alone, not dilated: the sign of the distance then changes at
  /// triangles only.
  bool is_only_sealed_solids() const;

  /// Returns the length of the paths from p along which the winding number stays on its side of 1/2, if they cross no
  /// triangle of a solid [m]. Along such a path the winding number changes by at most L / (4 pi r^2) per metre (Biot
  /// and Savart), L the length of the open boundary and r the distance from it. Infinity if the solids are sealed.
  double constant_side_path(const Eigen::Vector3d& p, double winding_number) const;

  /// Returns the unsigned distance to the triangles of one kind; infinity if there are none. `hint` as above, for that
  /// kind.
  double distance_to_solids(const Eigen::Vector3d& p, double hint = -1.0) const;
  double distance_to_shells(const Eigen::Vector3d& p, double hint = -1.0) const;

  /// Returns the triangles of one kind as a tree with the ids of `mesh()`. Those of an inside-out component are
  /// reversed.
  const TriangleTree& solid_triangles() const;
  const TriangleTree& shell_triangles() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace godobject::scene_compiler
