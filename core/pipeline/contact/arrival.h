#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "core/pipeline/contact/contact_directions.h"
#include "core/pipeline/contact/contact_limits.h"
#include "core/pipeline/contact/contact_scene.h"
#include "core/pipeline/contact/edges/near_edges.h"
#include "core/pipeline/contact/qp/least_constraint.h"
#include "core/pipeline/contact/second_look.h"

namespace godobject::detail {

/// The holding points at the end of a motion.
struct Arrival {
  bool opened = false;  ///< one left the surface: it passed an edge, beyond which its row is not valid
  double turn = 0.0;    ///< largest angle by which the normal of one has turned [rad, small]
  double rise = 0.0;    ///< of the energy because their surfaces have turned, see `arrive` [m^2]
};

/// The contact forces in a motion, and the gaps of their points at its end.
struct EndGaps {
  double energy = 0.0;  ///< of the forces at the end, less that at the start, see `end_gaps` [m^2]
  double most = 0.0;    ///< largest distance that a point lacks there [m]; 0: none
  std::uint32_t id{};   ///< of its point
  FieldSample sample;   ///< the field there
};

/// Returns by how much the coupling's energy rises because the point of a force moves along an arc in a motion (x, r)
/// [m^2]. A row takes the path of its point P for straight; in second order it misses
///     (r x (r x P)) / 2   for a sample point or a point of an edge,   -r x x - (r x (r x P)) / 2   for a feature
///     point.
/// The force, multiplier lambda and normal n, has to make up for what is lost along n, which takes the energy
///     -2 lambda n . (...).
inline double arc_energy(const ContactForce& force, const Motion& motion) noexcept {
  const Vector3& r = motion.rotation;
  const Vector3 half = 0.5 * r.cross(r.cross(force.point));
  const Vector3 missed = (force.id & kFeature) == 0 ? half : Vector3(-r.cross(motion.translation) - half);
  return -2.0 * force.multiplier * force.normal.dot(missed);
}

/// The same for all forces in step.motion. Cost: six forces. Real-time safe.
inline double arc_energy(const ConstrainedStep& step) noexcept {
  double energy = 0.0;
  for (std::uint32_t i = 0; i < step.force_count; ++i) energy += arc_energy(step.forces[i], step.motion);
  return energy;
}

/// A holding point at the end of a motion.
struct EndOfForce {
  FieldSample at_start;                      ///< the field at its point before the motion, if asked for
  FieldSample at_end;                        ///< the field at its point
  Vector3 displacement_W = Vector3::Zero();  ///< of the point, or of the body at the point [m]
  Vector3 gradient_W = Vector3::Zero();      ///< at the end, along which the gap grows [1]
};

/// Returns the gap of an edge pair as a field's value at the nearest point of the moving edge. `normal_W`: the normal
/// of its force; on the other side of the still edge the distance is negative.
inline FieldSample sample_of(const EdgeGap& gap, const Vector3& normal_W) noexcept {
  const double side = gap.normal.dot(normal_W) < 0.0 ? -1.0 : 1.0;
  return {.distance = side * gap.distance, .gradient = side * gap.normal, .known = true};
}

/// Looks up the point of a force at the end of the motion from H0 to H1, and with `with_start` also before it.
template <DistanceField Field, DistanceField BodyField>
EndOfForce end_of(const ContactScene<Field, BodyField>& scene, const Pose& H0, const Pose& H1,
                  const ContactForce& force, bool with_start) noexcept {
  EndOfForce end;
  if (scene.has_edges() && is_edge_pair(force.id)) {
    const EdgePair pair = pair_of(force.id);
    const Vector3 normal_W = H0.rotation._transformVector(force.normal);
    if (with_start) end.at_start = sample_of(gap_at(scene.edges, pair, H0), normal_W);
    end.at_end = sample_of(gap_at(scene.edges, pair, H1), normal_W);
    end.displacement_W = H1 * force.point - H0 * force.point;
    end.gradient_W = end.at_end.gradient;
  } else if ((force.id & kFeature) == 0) {
    const Vector3 p = scene.shell->point(force.id);
    const Vector3 p0_W = H0 * p;
    const Vector3 p1_W = H1 * p;
    if (with_start) end.at_start = scene.field->sample(p0_W);
    end.at_end = scene.field->sample(p1_W);
    end.displacement_W = p1_W - p0_W;
    end.gradient_W = end.at_end.gradient;
  } else if (scene.has_features()) {
    const Vector3 q_W = scene.features.origin_W + scene.features.points.point(force.id & ~kFeature);
    const Vector3 q0_S = H0.inverse() * q_W;
    if (with_start) end.at_start = scene.features.map->sample(q0_S);
    end.at_end = scene.features.map->sample(H1.inverse() * q_W);
    end.displacement_W = H1 * q0_S - q_W;
    end.gradient_W = -H1.rotation._transformVector(end.at_end.gradient);
  }
  return end;
}

/// Returns the least angle between a direction in S and the normals of a point's forces: in the valley between two
/// faces a point has one force of each, but the field there knows only one face [rad, small].
inline double least_turn(const ConstrainedStep& step, std::uint32_t id, const Vector3& normal_S) noexcept {
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < step.force_count; ++i) {
    if (step.forces[i].id == id) least = std::min(least, (step.forces[i].normal - normal_S).norm());
  }
  return least;
}

/// Looks up the holding points at the end of the motion v from H0 to H1, `share` of the step.
///
/// At the start of v the energy of coupling and contact forces falls by 2 |v|^2 per unit of the motion. By the rows it
/// is least at the end of v. Where the contact forces there (the multipliers lambda of the rows times the normals n_1)
/// point backwards, it is higher by
///     rise = -sum of lambda (n_1 - n_0) . (p_1 - p_0),
/// to which the arcs of the points add (`arc_energy`). In the valley between two faces the field at a point knows only
/// one of them, and its normal may turn although the other face still holds the point; `end_gaps` is exact there.
///
/// The contact of an edge pair slides along both edges. Neither the arc of the body's point nor the turn of the normal
/// contains that, so the rise is that of the measured gap g, less the energy of the arc:
///     rise = -2 lambda (g_1 - g_0 - n_0 . v) - arc.
/// Cost: one look-up for each force, two for one of edges, of at most six. Real-time safe.
template <DistanceField Field, DistanceField BodyField>
Arrival arrive(const ContactScene<Field, BodyField>& scene, const Pose& H0, const Pose& H1, const ConstrainedStep& step,
               double share) noexcept {
  Arrival arrival;
  for (std::uint32_t i = 0; i < step.force_count; ++i) {
    const ContactForce& force = step.forces[i];
    const bool is_edge = scene.has_edges() && is_edge_pair(force.id);
    const EndOfForce end = end_of(scene, H0, H1, force, is_edge);
    arrival.opened |= end.at_end.distance > scene.lengths.margin + scene.lengths.opening;
    const double steepness = end.gradient_W.norm();
    if (!(steepness > kFlat)) continue;
    const Vector3 normal_W = H0.rotation._transformVector(force.normal);
    const Vector3 turned_S = H0.rotation.conjugate() * Vector3(end.gradient_W / steepness);
    arrival.turn = std::max(arrival.turn, least_turn(step, force.id, turned_S));
    if (is_edge) {
      const Vector3 displacement = step.motion.translation + step.motion.rotation.cross(force.point);
      const double growth = end.at_end.distance - end.at_start.distance - share * force.normal.dot(displacement);
      arrival.rise -= 2.0 * force.multiplier * growth + share * share * arc_energy(force, step.motion);
    } else {
      arrival.rise -= force.multiplier * (end.gradient_W / steepness - normal_W).dot(end.displacement_W);
    }
  }
  return arrival;
}

/// Returns the energy of the contact forces in the motion from H0 to H1, `share` of the step: with the growth of the
/// gaps and the friction mu lambda d against the displacement u of the points
///     -2 sum of lambda (growth of the gap - mu d . u).
/// The growth is that of the row's linear motion, less what the end lacks (`expected_distance`).
/// Cost: two look-ups for each force, at most twelve. Real-time safe.
template <DistanceField Field, DistanceField BodyField>
EndGaps end_gaps(const ContactScene<Field, BodyField>& scene, const Pose& H0, const Pose& H1,
                 const ConstrainedStep& step, double share) noexcept {
  EndGaps gaps;
  for (std::uint32_t i = 0; i < step.force_count; ++i) {
    const ContactForce& force = step.forces[i];
    const EndOfForce end = end_of(scene, H0, H1, force, true);
    const double steepness = end.gradient_W.norm();
    if (!(steepness > kFlat)) continue;
    const double start = end.at_start.distance;
    const Vector3 displacement = step.motion.translation + step.motion.rotation.cross(force.point);
    const double increase = force.normal.dot(displacement);
    const double expected = expected_distance(scene.lengths, start, steepness * increase);
    const Vector3 of_grip = step.motion.translation + step.motion.rotation.cross(force.grip);
    const double friction = share * force.ratio * force.slip.dot(of_grip);
    gaps.energy += 2.0 * force.multiplier * ((expected - end.at_end.distance) / steepness - increase + friction);
    const double lacks = start + share * (expected - start) - end.at_end.distance;
    if (!(lacks > gaps.most)) continue;
    gaps.most = lacks;
    gaps.id = force.id;
    gaps.sample = end.at_end;
  }
  return gaps;
}

}  // namespace godobject::detail
