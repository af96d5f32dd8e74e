#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "core/scene/field.h"
#include "core/scene/pointshell.h"
#include "core/spatial/pose.h"

namespace godobject {

/// A bound on how far any point of the moving body has gone in a session: the sum of |x| + R_max |r| over its poses.
class Odometer {
 public:
  void reset() noexcept { *this = Odometer{}; }

  /// The body, all of whose points lie within `radius` of its origin, is at H_WS now. Whatever way it took, only the
  /// poses that are looked at count: between two of them a point p moves by (R_1 - R_0) p + x_1 - x_0, of which the
  /// first part is at most 2 |sin(angle / 2)| |p|.
  void move_to(const Pose& H_WS, double radius) noexcept {
    constexpr double kRounding = 1e-9;
    if (started_) {
      const double turn = 2.0 * (H_WS.rotation * H_.rotation.conjugate()).vec().norm();
      const double way = (H_WS.translation - H_.translation).norm() + radius * turn;
      way_ += way + kRounding * (way + radius);
    }
    H_ = H_WS;
    started_ = true;
  }

  double way() const noexcept { return way_; }

 private:
  Pose H_;
  double way_ = 0.0;  ///< [m]
  bool started_ = false;
};

/// Step #1 of `contact`: the points of a shell whose clearance in a field is below a bound. With memory of its own it
/// looks at a node of the sphere tree, or at a point, only when the motion since it was last looked at could have
/// brought it there, so a cycle costs as much as there is near; what it finds does not depend on it.
///
/// **Bound.** Let C = clearance(c) and |x - c| <= r + t for a point x that was within r of c when the body had gone t
/// less. The stored field at x is then at least C - r - t, or at least the band: within the band it falls by at most
/// lipschitz a metre along the way, and C is the distance divided by that; beyond it C is itself such a bound. A
/// look-up divides a distance by at most L = lipschitz(), and one of at least the band gives at least band / L, so
///     clearance(x) >= min(C - r - t, band) / L.
/// For any bound `cut` <= band / L, x is not near while C - r - t >= L cut. Since L >= 1, also while
/// (C - r) / L - t >= cut, and while C - r - (L - 1) longest - t >= cut for all cuts up to `longest`. So the larger of
///     way + (C - r) / L   and   way + C - r - (L - 1) longest
/// is kept, and neither node nor point is looked at again before way + cut exceeds it. Where x may move by f >= 1 times
/// what the odometer says, both are divided by f.
class NearSearch {
 public:
  /// Numbers that a search of this shell remembers.
  static std::size_t memory(const Pointshell& shell) noexcept { return shell.nodes.size() + shell.size; }

  /// Begins anew. `memory`: memory(shell) numbers that outlive the search, or none; then all nodes are looked at in
  /// every cycle. `longest`: largest `cut`, at most the field's band / lipschitz [m].
  void start(std::span<double> memory, double longest) noexcept {
    until_ = memory;
    std::fill(until_.begin(), until_.end(), 0.0);
    longest_ = longest;
    certain_ = 0.0;
  }

  /// The last `find` knows that up to this reading of the odometer nothing comes nearer than `longest`.
  bool is_free(double way) const noexcept { return way + longest_ <= certain_; }

  /// Calls visit(i, p, p_field, sample) for all points with a clearance below `cut` <= `longest`, ascending. The shell
  /// is at H in the field's frame; `way` is the odometer's reading there. Cost: a comparison for each node and point
  /// beside those that are near, a look-up for each that is due; at most all nodes and points.
  ///
  /// `Direction::stretch(lever)`: a point of the shell that stays within `lever` [m] of the moving body's origin moves
  /// in the field's frame by at most this times the odometer's difference; 1 or more.
  template <class Direction, DistanceField Field, class Visit>
  void find(const Direction& direction, const Field& field, const Pointshell& shell, const Pose& H, double way,
            double cut, Visit&& visit) noexcept {
    const Matrix3 R = H.rotation.toRotationMatrix();
    const double needed = way + cut;
    const double slope = field.lipschitz();
    const double rounding = kFieldRounding * field.voxel_size();
    // until when a ball of this radius about a point of the field's frame is not near
    const auto free_until = [&](double clearance, const Vector3& center_field, double radius) noexcept {
      const double free = clearance - radius - rounding;
      const double room = std::max(free / slope, free - (slope - 1.0) * longest_);
      return way + room / direction.stretch(center_field.norm() + radius + std::max(0.0, room));
    };
    const auto node_count = static_cast<std::uint32_t>(shell.nodes.size());
    std::array<Open, format::kMaxLevels + 1> open;
    std::size_t depth = 0;
    double least = kNever;
    for (std::uint32_t n = 0;;) {
      while (depth > 0 && n >= open[depth - 1].end) {
        const Open& closing = open[--depth];
        const double until = least >= needed ? least : kOpen;
        remember(closing.node, until);
        least = std::min(closing.least, until);
      }
      if (n >= node_count) break;
      const format::Node& node = shell.nodes[n];
      double until = remembered(n);
      if (until < needed && until != kOpen) {
        const Vector3 center(static_cast<double>(node.center[0]), static_cast<double>(node.center[1]),
                             static_cast<double>(node.center[2]));
        // spheres come in single precision: they may be this much too small
        const double radius = static_cast<double>(node.radius) * (1.0 + kRounding) + kRounding * center.norm();
        const Vector3 center_field = R * center + H.translation;
        until = free_until(field.sample(center_field).clearance, center_field, radius);
        remember(n, until >= needed ? until : kOpen);
      }
      if (until >= needed) {
        least = std::min(least, until);
        n = node.skip;
        continue;
      }
      open[depth++] = {n, node.skip, least};
      least = kNever;
      if (node.leaf != 0) {
        for (std::uint32_t i = node.first_point; i < node.first_point + node.point_count; ++i) {
          double point_until = remembered(node_count + i);
          if (point_until < needed) {
            const Vector3 p = shell.point(i);
            const Vector3 p_field = R * p + H.translation;
            const FieldSample sample = field.sample(p_field);
            point_until = free_until(sample.clearance, p_field, 0.0);
            remember(node_count + i, point_until);
            if (sample.clearance < cut) visit(i, p, p_field, sample);
          }
          least = std::min(least, point_until);
        }
        n = node.skip;
      } else {
        ++n;
      }
    }
    certain_ = least;
  }

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();
  static constexpr double kOpen = -kNever;        ///< of a node: something below it was near at the last look
  static constexpr double kRounding = 2e-6;       ///< of spheres [1]
  static constexpr double kFieldRounding = 1e-5;  ///< of stored distances [voxels]

  struct Open {
    std::uint32_t node, end;
    double least;  ///< of what was visited before, in the parent
  };

  double remembered(std::uint32_t i) const noexcept { return until_.empty() ? 0.0 : until_[i]; }
  void remember(std::uint32_t i, double until) noexcept {
    if (!until_.empty()) until_[i] = until;
  }

  std::span<double> until_;  ///< odometer readings [m], of nodes, then of points
  double longest_ = 0.0;
  double certain_ = kNever;  ///< what is known of the whole shell as of a node [m]
};

}  // namespace godobject
