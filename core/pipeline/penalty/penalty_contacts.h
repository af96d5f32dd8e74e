#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/scene/field.h"
#include "core/scene/pointshell.h"
#include "core/scene/sample_batch.h"
#include "godobject/pose.h"

namespace godobject {

/// The result of step #1: the paper's f_P, t_P and p_d (d is a parameter), from any penalty method.
struct PenaltyContacts {
  Wrench wrench_S;          ///< f_P [m], t_P [m^2]: sums of eq (2), in S about the centre of mass
  double depth = 0.0;       ///< p_d [m]: largest V; if negative (region C), every point is at least -p_d from contact
  std::uint32_t count = 0;  ///< points with V > 0

  /// Tells whether the sum of the forces has a direction. It has none where contacts oppose each other, or where the
  /// field has no gradient. Derived: a single contact has a force of `depth`; the rounding of opposed ones leaves about
  /// 1e-12 of it.
  bool has_direction() const noexcept { return depth > 0.0 && wrench_S.force.norm() > 1e-6 * depth; }
};

/// The penetration of one sample point: V of eq (1) and the contact normal.
struct PointPenetration {
  double value = 0.0;                  ///< V [m], safety distance included
  Vector3 normal_W = Vector3::Zero();  ///< n: into the moving body; zero where unknown (deep inside, medial axis)
};

/// Eq (1) as printed: with the integer layer of the voxel around the point and the pointshell's normal as n.
struct LayerPenetration {
  /// Returns the stored distance phi up to which V > 0 is possible [m]: V <= contact_distance - phi. It is d plus half
  /// a layer of rounding, half a voxel diagonal for e, and half a diagonal for phi(C).
  static double contact_distance(double safety_distance, double voxel_size) noexcept {
    return safety_distance + (0.5 + 2.0 * 0.8660254037844387) * voxel_size;
  }

  /// Returns the penetration of point `i`, which is at p_W.
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

/// Eq (1) exact to first order: V = -phi + d and n = grad phi / |grad phi|, both of the stored field. Integer layers
/// err by 0.29 s rms and jump by up to 0.94 s; pointshell normals are not the field's gradient.
struct DistancePenetration {
  /// Returns the stored distance up to which V > 0 is possible [m].
  static double contact_distance(double safety_distance, double /*voxel_size*/) noexcept { return safety_distance; }

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

/// Calls `visit(i, p_W)` for every sample point whose stored distance may be below `cutoff` [m] and returns a lower
/// bound of the stored distance of all other points [m] (infinity if there is none). `visit` returns the cutoff to use
/// from then on, which may only shrink. Cost: one look-up for each visited node and point; bounded by the number of
/// nodes and points. Real-time safe.
template <DistanceField Field, class Visit>
double visit_points_below(double cutoff, const Field& field, const Pointshell& shell, const Pose& H_WS,
                          Visit&& visit) noexcept {
  const Matrix3 R_WS = H_WS.rotation.toRotationMatrix();
  double of_others = std::numeric_limits<double>::infinity();
  const auto node_count = static_cast<std::uint32_t>(shell.nodes.size());
  for (std::uint32_t n = 0; n < node_count;) {
    const format::Node& node = shell.nodes[n];
    const Vector3 center_S(static_cast<double>(node.center[0]), static_cast<double>(node.center[1]),
                           static_cast<double>(node.center[2]));
    const double bound = field.lower_bound(R_WS * center_S + H_WS.translation, static_cast<double>(node.radius));
    if (bound >= cutoff) {
      of_others = std::min(of_others, bound);
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
  return of_others;
}

/// Returns the penalty values of the god object at H_WS by sphere tree and voxel look-up. Step #1 (paper, section 2.1).
/// In region C, -`depth` is a lower bound of the distance to contact, exact where that is below `travel` [m]: a motion
/// that displaces points by `travel` needs no more. Sums run in the tree's order, so equal input gives equal bits.
/// Real-time safe.
template <class Penetration, DistanceField Field>
PenaltyContacts penalty_contacts(const Field& field, const Pointshell& shell, const Pose& H_WS, double safety_distance,
                                 double travel) noexcept {
  const Matrix3 R_WS = H_WS.rotation.toRotationMatrix();
  const double contact_distance = Penetration::contact_distance(safety_distance, field.voxel_size());
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
    // before the first contact, points farther away than the nearest so far change nothing
    return std::max(contact_distance, std::min(contact_distance + travel, contact_distance - depth));
  };
  const double of_others = visit_points_below(contact_distance + travel, field, shell, H_WS, visit);
  contacts.depth = std::max(depth, contact_distance - of_others);  // V <= contact_distance - phi
  contacts.wrench_S.force = R_WS.transpose() * wrench_W.force;
  contacts.wrench_S.torque = R_WS.transpose() * wrench_W.torque;
  return contacts;
}

/// Returns the smallest stored distance of all sample points at H_WS [m], at most the band. A replay reports minus this
/// as the depth. Cost: as visit_points_below with a cutoff that shrinks after every 64 points only. Real-time safe.
template <DistanceField Field>
double smallest_distance(const Field& field, const Pointshell& shell, const Pose& H_WS) noexcept {
  double smallest = field.band();
  SampleBatch batch;
  const auto look_up = [&]() noexcept {
    field.samples(H_WS, batch);
    for (std::uint32_t k = 0; k < batch.count; ++k) smallest = std::min(smallest, batch.distance[k]);
    batch.count = 0;
  };
  visit_points_below(smallest, field, shell, H_WS, [&](std::size_t i, const Vector3&) noexcept {
    batch.x[batch.count] = shell.x[i];
    batch.y[batch.count] = shell.y[i];
    batch.z[batch.count] = shell.z[i];
    if (++batch.count == SampleBatch::kCapacity) look_up();
    return smallest;
  });
  if (batch.count > 0) look_up();
  return smallest;
}

}  // namespace godobject
