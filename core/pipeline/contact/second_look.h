#pragma once

#include <algorithm>
#include <limits>

#include "core/pipeline/contact/certificate.h"
#include "core/pipeline/contact/contact_directions.h"
#include "core/pipeline/contact/contact_lengths.h"
#include "core/pipeline/contact/contact_limits.h"
#include "core/pipeline/contact/qp/contact_rows.h"
#include "core/pipeline/contact/search/near_points.h"

/// The second look: the surface at an obstacle becomes one more row of the point that met it. Where two faces of the
/// field meet in a valley, the gradient at the start of the motion describes only one of them.
namespace godobject::detail {

/// Returns the required gap increase of the new row [m]. `displacement`: from the start of the chord to the obstacle,
/// in the field's frame [m]; `start_distance`: stored distance at the start [m]; `steepness`: length of the gradient at
/// the obstacle [1]; `loss`: gap increase at the obstacle that the row promises and the motion does not keep [m].
///
/// Without a loss the row requires no more than the point's row at the start, so that rest remains feasible. A point on
/// a long lever moves along an arc, which the row takes for its tangent; the row must promise what the arc loses
/// (second-order correction of sequential quadratic programming, Nocedal and Wright, Numerical Optimization, 18.3).
inline double second_look_gain(const ContactLengths& lengths, const FieldSample& at_obstacle,
                               const Vector3& displacement, double start_distance, double steepness,
                               double loss) noexcept {
  // extrapolated to the start, the distance differs by the gradient times the displacement
  const double gain = (lengths.margin - at_obstacle.distance + at_obstacle.gradient.dot(displacement)) / steepness;
  return std::min(gain, std::max(0.0, kRecovery * (lengths.margin - start_distance))) + std::max(0.0, loss);
}

/// Returns the bound of the squared distance from the aim, less that at rest, after a second look with the loss of an
/// arc [m^2]: a quarter of what the share that was tried would change. `whole_gain`: change by the whole motion, of
/// squared length `square` [m^2].
///
/// The loss is that of the motion that was tried. A much shorter one loses much less, and its row would hold the point
/// off a surface that is several margins away: an arc may cost as much as the motion to the surface. Where the loss
/// leaves less than a quarter, the row without it leads farther. Chosen: half of the motion gains about half. A motion
/// that leads away from the aim only regains margins, and has no bound.
inline double most_arc_gain(double whole_gain, double square, double share) noexcept {
  constexpr double kLeast = 0.25;
  const double gain = share * (whole_gain - (1.0 - share) * square);
  return gain < 0.0 ? kLeast * gain : std::numeric_limits<double>::infinity();
}

/// Returns the stored distance at the end of a motion that a row leads one to expect [m], from the one at its start.
/// `increase`: of the distance, in the row's linear motion [m]. It counts from `at_start` if the row describes the
/// surface nearest at the start. The row of another face, which a second look saw, leads to the margin, or to the same
/// distance if that is less; one that makes up for an arc, to no more than the gap law demands.
inline double expected_distance(const ContactLengths& lengths, double at_start, double increase) noexcept {
  const double missing = std::max(0.0, lengths.margin - at_start);
  const double most = lengths.margin - (1.0 - kRecovery) * missing;
  const double least = std::min(at_start, lengths.margin);
  return std::clamp(at_start + increase, least, most);
}

/// Tells whether the face of a second look ends before a point that rests on it. Its row holds a plane, which leads on
/// beyond the face. Where the plane is the surface, the field behind it, by the gap of an open contact, has the plane's
/// normal. Within that gap of a ridge the face counts as ended. `point` [m] and unit `normal` are in the field's frame.
/// Cost: a look-up. Real-time safe.
template <DistanceField Field>
bool face_ends_before(const Field& field, const Vector3& point, const Vector3& normal,
                      const ContactLengths& lengths) noexcept {
  constexpr double kSameFace = 0.9;  // cosine, chosen: within a margin a ball of ten margins turns by less
  const FieldSample behind = field.sample(point - (lengths.margin + lengths.opening) * normal);
  return behind.known && !(behind.gradient.dot(normal) > kSameFace * behind.gradient.norm());
}

/// The motion that met an obstacle, as the frame of one direction has it.
struct Attempt {
  const Pose& H0;       ///< start
  const Pose& H1;       ///< end, at a share of the motion
  const Motion& step;   ///< whole motion in S
  double share = 1.0;   ///< share that was tried
  bool is_arc = false;  ///< the row makes up for the arc on which the point moves
};

/// Adds the row of an obstacle that a motion met. False: there is no room for a row, or the field has no gradient at
/// the obstacle. Real-time safe.
template <class Direction>
bool push_obstacle(const Attempt& attempt, const ContactLengths& lengths, const NearPoints& near,
                   const Obstacle& obstacle, ContactRows& rows) noexcept {
  if (rows.full() || !obstacle.sample.known || !(obstacle.sample.gradient.norm() > kFlat)) return false;
  const Matrix3 R0 = attempt.H0.rotation.toRotationMatrix();
  const Vector3 p = near.point(obstacle.near);
  const Vector3 p0 = R0 * p + attempt.H0.translation;
  const Vector3 displacement = obstacle.share * (attempt.H1 * p - p0);
  const ContactPoint contact = Direction::contact(p, p0, obstacle.sample.gradient, R0);
  const double steepness = contact.gradient_S.norm();
  const Vector3 normal_S = contact.gradient_S / steepness;
  double loss = 0.0;
  if (attempt.is_arc) {
    const Motion& step = attempt.step;
    const double promised =
        attempt.share * obstacle.share * normal_S.dot(step.translation + step.rotation.cross(contact.point_S));
    // the row promises for the whole step; the loss grows with the square of the share
    loss = (promised - obstacle.sample.gradient.dot(displacement) / steepness) / attempt.share;
  }
  rows.push(Direction::kId | near.index[obstacle.near], normal_S, contact.point_S,
            second_look_gain(lengths, obstacle.sample, displacement, near.distance[obstacle.near], steepness, loss));
  return true;
}

}  // namespace godobject::detail
