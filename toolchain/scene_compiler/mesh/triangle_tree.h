#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "toolchain/scene_compiler/mesh/box.h"
#include "toolchain/scene_compiler/mesh/triangle_geometry.h"

namespace godobject::scene_compiler {

/// Bounding-volume hierarchy over triangles: nearest point, ray hits, generalised winding number. Double precision.
/// Const calls may run on many threads.
class TriangleTree {
 public:
  struct Triangle {
    Eigen::Vector3d a, b, c;
    std::uint32_t id;  ///< returned by queries
  };

  struct Nearest {
    double squared_distance;
    Eigen::Vector3d point;
    std::uint32_t id;
  };

  struct RayHit {
    double t;
    std::uint32_t id;
    Eigen::Vector3d normal;  ///< unit, of the triangle as given to the tree
  };

  TriangleTree() = default;
  explicit TriangleTree(std::vector<Triangle> triangles);

  bool empty() const noexcept { return triangles_.empty(); }

  /// The smallest box around all triangles.
  Box box() const noexcept { return nodes_.empty() ? Box{} : nodes_[0].box; }

  /// Finds the nearest point of all triangles with a squared distance below `bound_squared`. False if there is none.
  bool nearest(const Eigen::Vector3d& p, double bound_squared, Nearest& nearest) const noexcept;

  /// The same among the triangles with counts(id).
  bool nearest(const Eigen::Vector3d& p, double bound_squared, const std::function<bool(std::uint32_t)>& counts,
               Nearest& nearest) const;

  /// Calls visit(triangle) for all triangles at most `radius` from p, and for some others.
  template <class Visit>
  void within(const Eigen::Vector3d& p, double radius, const Visit& visit) const {
    for (std::size_t n = 0; n < nodes_.size();) {
      const Node& node = nodes_[n];
      if (node.box.squared_distance(p) > radius * radius) {
        n = node.after;
        continue;
      }
      for (std::uint32_t i = node.right; i < node.right + node.count; ++i) visit(triangles_[i]);
      ++n;
    }
  }

  /// Finds the first triangle at t_min < t < t_max on origin + t direction.
  bool first_hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double t_min, double t_max,
                 RayHit& hit) const noexcept;

  /// Returns the change of the winding number from one place to another: the number of triangles that the segment
  /// enters at their front, less those that it leaves. Empty if rounding might decide whether it meets one, and if a
  /// triangle's edge is too near. The surface must have no open boundary.
  std::optional<int> winding_change(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const noexcept;

  /// Returns the sum of solid angles over 4 pi. A subtree farther away than `opening` times its radius counts as one
  /// dipole (Barill et al. 2018). An infinite opening gives the exact sum.
  double winding_number(const Eigen::Vector3d& p, double opening) const noexcept;

 private:
  struct Node {
    Box box;
    std::uint32_t right;  ///< second child; the first is the next node. Leaf: first triangle
    std::uint32_t count;  ///< triangles of a leaf; 0 for an inner node
    std::uint32_t after;  ///< the node after the subtree
  };
  struct Dipole {
    Eigen::Vector3d center;  ///< centroid, weighted by area
    Eigen::Vector3d area;    ///< sum of the triangles' area vectors [m^2]
    double radius;           ///< of a sphere around all of the subtree's vertices
  };

  template <class Counts>
  bool nearest_of(const Eigen::Vector3d& p, double bound_squared, const Counts& counts, Nearest& nearest) const;
  std::uint32_t build(std::uint32_t begin, std::uint32_t end, std::vector<Eigen::Vector3d>& centroids);
  struct Extent {
    int axis;
    double low, high;  ///< of the centroids along the axis
  };
  std::uint32_t split(std::uint32_t begin, std::uint32_t end, std::vector<Eigen::Vector3d>& centroids);
  std::uint32_t split_by_bins(std::uint32_t begin, std::uint32_t end, const Extent& extent,
                              std::vector<Eigen::Vector3d>& centroids);
  std::uint32_t split_at_median(std::uint32_t begin, std::uint32_t end, int axis,
                                std::vector<Eigen::Vector3d>& centroids);
  void set_dipoles();

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
  std::vector<Dipole> dipoles_;
};

}  // namespace godobject::scene_compiler
