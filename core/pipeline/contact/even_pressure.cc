#include "core/pipeline/contact/even_pressure.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace godobject::detail {
namespace {

constexpr std::uint32_t kLeastPoints = 12;  // fewer do not describe a face
constexpr double kFaceCosine = 0.98;        // of a point's normal with the face's; those of edges differ by more

/// The load on one face.
struct FaceLoad {
  Vector3 normal = Vector3::Zero();
  Vector3 centre = Vector3::Zero();
  double load = 0.0;           ///< [m], as the multipliers
  double mean_distance = 0.0;  ///< of the forces from the centre [m]
};

/// Returns the load of the forces on the face of force `first`, and takes them out of `left`, a bit mask.
FaceLoad take_face(const ConstrainedStep& step, std::uint32_t first, double thickness, std::uint32_t& left) noexcept {
  FaceLoad face;
  face.normal = step.forces[first].normal;
  std::uint32_t taken = 0;
  for (std::uint32_t i = first; i < step.force_count; ++i) {
    const ContactForce& force = step.forces[i];
    const double height = face.normal.dot(force.point - step.forces[first].point);
    if ((left >> i & 1) == 0 || !ContactPatches::have_one_normal(face.normal, force.normal)) continue;
    if (std::fabs(height) > thickness) continue;
    taken |= 1u << i;
    face.load += force.multiplier;
    face.centre += force.multiplier * force.point;
  }
  left &= ~taken;
  if (!(face.load > 0.0)) return face;
  face.centre /= face.load;
  for (std::uint32_t i = first; i < step.force_count; ++i) {
    if ((taken >> i & 1) == 0) continue;
    const ContactForce& force = step.forces[i];
    face.mean_distance += force.multiplier / face.load * (force.point - face.centre).norm();
  }
  return face;
}

/// Calls visit(x, y) for the touching sample points of the face, from its centre in the plane of t and u [m].
template <class Visit>
void for_each_touching(const FaceLoad& face, const NearPoints& samples, const Pointshell& shell,
                       const ContactLengths& lengths, const Vector3& t, const Vector3& u, const Visit& visit) noexcept {
  const double touching = 2.0 * lengths.margin;
  for (std::uint32_t k = 0; k < samples.count; ++k) {
    if (!(samples.distance[k] <= touching)) continue;
    const Vector3 from_centre = samples.point(k) - face.centre;
    if (!(std::fabs(face.normal.dot(from_centre)) <= touching)) continue;
    if (shell.normal_x != nullptr && !(shell.normal(samples.index[k]).dot(face.normal) > kFaceCosine)) continue;
    visit(t.dot(from_centre), u.dot(from_centre));
  }
}

/// Returns the mean distance of the touching sample points from the centre, weighted by the linear pressure with that
/// centre [m]; 0 if too few touch, or all on one line.
double mean_distance_of(const FaceLoad& face, const NearPoints& samples, const Pointshell& shell,
                        const ContactLengths& lengths) noexcept {
  const Vector3 t = face.normal.unitOrthogonal();
  const Vector3 u = face.normal.cross(t);
  std::uint32_t count = 0;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  for_each_touching(face, samples, shell, lengths, t, u, [&](double x, double y) noexcept {
    const Eigen::Vector2d q(x, y);
    ++count;
    sum += q;
    squares += q * q.transpose();
  });
  if (count < kLeastPoints) return 0.0;
  const Eigen::Vector2d middle = sum / count;
  const Eigen::Matrix2d spread = squares / count - middle * middle.transpose();
  const double trace = spread.trace();
  if (!(spread.determinant() > 1e-6 * trace * trace)) return 0.0;
  // p(q) = 1 + slope . (q - middle) has its centre at q = 0
  const Eigen::Vector2d slope = -(spread.inverse() * middle);
  double pressure = 0.0;
  double moment = 0.0;
  for_each_touching(face, samples, shell, lengths, t, u, [&](double x, double y) noexcept {
    const Eigen::Vector2d q(x, y);
    const double here = std::max(0.0, 1.0 + slope.dot(q - middle));
    pressure += here;
    moment += here * q.norm();
  });
  return pressure > 0.0 ? moment / pressure : 0.0;
}

}  // namespace

ContactPatches patches_of(const ConstrainedStep& last, const NearPoints& samples, const Pointshell& shell,
                          const ContactLengths& lengths) noexcept {
  ContactPatches found;
  std::uint32_t left = (1u << last.force_count) - 1;
  for (std::uint32_t i = 0; i < last.force_count && found.count < ContactPatches::kMost; ++i) {
    if ((left >> i & 1) == 0) continue;
    const FaceLoad face = take_face(last, i, lengths.margin, left);
    if (!(face.mean_distance > lengths.margin)) continue;
    const double even = mean_distance_of(face, samples, shell, lengths);
    if (!(even > 0.0)) continue;
    found.patch[found.count++] = {face.normal, face.centre, std::min(1.0, even / face.mean_distance)};
  }
  return found;
}

}  // namespace godobject::detail
