#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/scene/field.h"
#include "core/scene/pointshell.h"
#include "godobject/pose.h"

namespace godobject {

/// What step #1 hands on: the paper's f_P, t_P, p_d (d is a parameter), whatever penalty method computed them.
struct PenaltyContacts {
  Wrench wrench_S;          ///< f_P [m], t_P [m^2]: sums of eq (2), in S about the centre of mass
  double depth = 0.0;       ///< p_d [m]: largest V; if negative (region C), no point is nearer than -p_d to contact
  std::uint32_t count = 0;  ///< points with V > 0

  /// The forces have a sum to constrain by: contacts may oppose each other, or lie where the field has no gradient.
  bool has_direction() const noexcept { return depth > 0.0 && wrench_S.force.norm() > 1e-6 * depth; }
};

/// V of eq (1) and the contact's direction at one sample point.
struct PointPenetration {
  double value = 0.0;  ///< V [m], safety distance included
  Vector3 normal_W =
      Vector3::Zero();  ///< n: into the moving body; zero where it is not known (deep inside, medial axis)
};

/// Eq (1) as printed: integer layer of the voxel around the point, n the pointshell's own normal.
struct LayerPenetration {
  /// V <= reach - phi, so V > 0 is possible up to this stored distance phi: half a layer of rounding, half a diagonal
  /// for e, and one for phi(C).
  static double reach(double safety_distance, double voxel_size) noexcept {
    return safety_distance + (0.5 + 2.0 * 0.8660254037844387) * voxel_size;
  }

  template <DistanceField Field>
  static PointPenetration at(const Field& field, const Pointshell& shell, std::size_t i, const Vector3& p_W,
                             const Matrix3& R_WS, double safety_distance) noexcept {
    const LayerSample sample = field.layer(p_W);
    PointPenetration point;
    point.normal_W = R_WS * shell.normal(i);
    point.value = sample.layer * field.voxel_size() + point.normal_W.dot(sample.to_center) + safety_distance;  // (1)
    return point;
  }
};

/// Eq (1) to first order exact: V = -phi + d and n = grad phi / |grad phi|, both of the stored field.
/// Integer layers cost 0.29 s rms and jump by up to 0.94 s; pointshell normals are not the field's gradient.
struct DistancePenetration {
  static double reach(double safety_distance, double /*voxel_size*/) noexcept { return safety_distance; }

  template <DistanceField Field>
  static PointPenetration at(const Field& field, const Pointshell& /*shell*/, std::size_t /*i*/, const Vector3& p_W,
                             const Matrix3& /*R_WS*/, double safety_distance) noexcept {
    const FieldSample sample = field.sample(p_W);
    PointPenetration point;
    point.value = safety_distance - sample.distance;
    const double length = sample.gradient.norm();
    if (length > kFlat) point.normal_W = sample.gradient / length;
    return point;
  }
};

/// Walks the sphere tree once, calling `visit(i, p_W)` for every sample point whose stored distance may be below
/// `cutoff`, and returns a lower bound of the stored distance of all points left out (infinity if none was). `visit`
/// returns the cutoff from there on, which may only shrink. Cost: one field look-up for each node and point visited;
/// bounded by the number of nodes and points, no stack.
template <DistanceField Field, class Visit>
double visit_points_below(double cutoff, const Field& field, const Pointshell& shell, const Pose& H_WS,
                          Visit&& visit) noexcept {
  const Matrix3 R_WS = H_WS.rotation.toRotationMatrix();
  double left_out = std::numeric_limits<double>::infinity();
  const auto node_count = static_cast<std::uint32_t>(shell.nodes.size());
  for (std::uint32_t n = 0; n < node_count;) {
    const format::Node& node = shell.nodes[n];
    const Vector3 center_S(static_cast<double>(node.center[0]), static_cast<double>(node.center[1]),
                           static_cast<double>(node.center[2]));
    const double bound = field.lower_bound(R_WS * center_S + H_WS.translation, static_cast<double>(node.radius));
    if (bound >= cutoff) {
      left_out = std::min(left_out, bound);
      n = node.skip;
      continue;
    }
    if (node.leaf != 0) {
      for (std::uint32_t i = node.first_point; i < node.first_point + node.point_count; ++i) {
        cutoff = visit(i, R_WS * shell.point(i) + H_WS.translation);
      }
    }
    ++n;
  }
  return left_out;
}

/// Step #1 (paper, section 2.1): the penalty values of the god object at H_WS, by sphere tree and voxel look-up.
/// In region C, `depth` is a bound good enough for a motion of `travel` [m] if there is that much room.
/// Sums run in the tree's order, so equal input gives equal bits.
template <class Penetration, DistanceField Field>
PenaltyContacts penalty_contacts(const Field& field, const Pointshell& shell, const Pose& H_WS, double safety_distance,
                                 double travel) noexcept {
  const Matrix3 R_WS = H_WS.rotation.toRotationMatrix();
  const double reach = Penetration::reach(safety_distance, field.voxel_size());
  PenaltyContacts contacts;
  Wrench wrench_W;
  double depth = -std::numeric_limits<double>::infinity();
  const auto visit = [&](std::size_t i, const Vector3& p_W) noexcept {
    const PointPenetration point = Penetration::at(field, shell, i, p_W, R_WS, safety_distance);
    depth = std::max(depth, point.value);
    if (point.value > 0.0) {
      const Vector3 force = point.value * point.normal_W;  // (2)
      wrench_W.force += force;
      wrench_W.torque += (p_W - H_WS.translation).cross(force);  // (2)
      ++contacts.count;
    }
    // without a contact yet, whatever is farther away than the nearest point so far does not matter
    return std::max(reach, std::min(reach + travel, reach - depth));
  };
  const double left_out = visit_points_below(reach + travel, field, shell, H_WS, visit);
  contacts.depth = std::max(depth, reach - left_out);  // V <= reach - phi
  contacts.wrench_S.force = R_WS.transpose() * wrench_W.force;
  contacts.wrench_S.torque = R_WS.transpose() * wrench_W.torque;
  return contacts;
}

/// Smallest stored distance over all sample points at H_WS [m], at most the band. What a replay reports as minus its
/// depth.
template <DistanceField Field>
double smallest_distance(const Field& field, const Pointshell& shell, const Pose& H_WS) noexcept {
  double smallest = field.band();
  visit_points_below(smallest, field, shell, H_WS, [&](std::size_t, const Vector3& p_W) noexcept {
    smallest = std::min(smallest, field.sample(p_W).distance);
    return smallest;
  });
  return smallest;
}

}  // namespace godobject
