#pragma once

#include <cstdint>

#include "core/pipeline/contact/contact_directions.h"
#include "core/pipeline/contact/contact_limits.h"
#include "core/pipeline/contact/contact_scene.h"
#include "core/pipeline/contact/qp/least_constraint.h"

namespace godobject::detail {

/// The state of the holding contacts at the end of a motion.
struct Arrival {
  bool opened = false;     ///< a holding point left the surface: it passed an edge, beyond which its row is not valid
  double overshoot = 0.0;  ///< rise of the coupling's energy at the end over its fall at the start, see `arrive` [1]
};

/// Returns by how much the coupling's energy rises because the points move along arcs in the motion (x, r) =
/// step.motion [m^2]. A row takes the path of its point P for straight; in second order it misses
///     (r x (r x P)) / 2   for a sample point,   -r x x - (r x (r x P)) / 2   for a feature point.
/// The force, multiplier lambda and normal n, has to make up for what is lost along n, which takes the energy
///     -2 sum of lambda n . (...).
/// Cost: six forces. Real-time safe.
inline double arc_energy(const ConstrainedStep& step) noexcept {
  const Vector3& r = step.motion.rotation;
  double energy = 0.0;
  for (std::uint32_t i = 0; i < step.force_count; ++i) {
    const ContactForce& force = step.forces[i];
    const Vector3 half = 0.5 * r.cross(r.cross(force.point));
    const Vector3 missed = (force.id & kFeature) == 0 ? half : Vector3(-r.cross(step.motion.translation) - half);
    energy -= 2.0 * force.multiplier * force.normal.dot(missed);
  }
  return energy;
}

/// Looks up the holding points at the end of the motion v = step.motion from H0 to H1.
///
/// Overshoot: at the start of v the energy of the coupling falls by |v|^2 per unit of the motion. Where the contact
/// forces at the end (the multipliers lambda of the rows times the normals n_1 there) point backwards, it rises there
/// by
///     arcs - sum of lambda (n_1 - n_0) . (p_1 - p_0) = overshoot |v|^2.
/// By the secant the energy is least at 1 / (1 + overshoot) of the motion. `squared_length`: |v|^2 in the metric in
/// which `step` was solved; `arcs`: energy of the arcs (`arc_energy`), less the part that this metric contains [m^2].
/// Cost: one look-up for each force, at most six. Real-time safe.
template <DistanceField Field, DistanceField BodyField>
Arrival arrive(const ContactScene<Field, BodyField>& scene, const Pose& H0, const Pose& H1, const ConstrainedStep& step,
               double squared_length, double arcs) noexcept {
  const double open = scene.lengths.margin + scene.lengths.opening;
  Arrival arrival;
  double rise = arcs;
  for (std::uint32_t i = 0; i < step.force_count; ++i) {
    const ContactForce& force = step.forces[i];
    const Vector3 normal_W = H0.rotation._transformVector(force.normal);
    Vector3 displacement_W;
    Vector3 gradient_W;
    double distance = 0.0;
    if ((force.id & kFeature) == 0) {
      const Vector3 p = scene.shell->point(force.id);
      const Vector3 p1_W = H1 * p;
      const FieldSample sample = scene.field->sample(p1_W);
      displacement_W = p1_W - H0 * p;
      gradient_W = sample.gradient;
      distance = sample.distance;
    } else if (scene.has_features()) {
      const Vector3 q_W = scene.features.origin_W + scene.features.points.point(force.id & ~kFeature);
      const FieldSample sample = scene.features.map->sample(H1.inverse() * q_W);
      displacement_W = H1 * (H0.inverse() * q_W) - q_W;
      gradient_W = -H1.rotation._transformVector(sample.gradient);
      distance = sample.distance;
    } else {
      continue;
    }
    arrival.opened |= distance > open;
    const double steepness = gradient_W.norm();
    if (steepness > kFlat) rise -= force.multiplier * (gradient_W / steepness - normal_W).dot(displacement_W);
  }
  if (rise > 0.0 && squared_length > 0.0) arrival.overshoot = rise / squared_length;
  return arrival;
}

}  // namespace godobject::detail
