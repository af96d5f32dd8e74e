#include "core/scene/edge.h"

#include <cmath>

namespace godobject {
namespace {

using Vector3Map = Eigen::Map<const Vector3>;

}  // namespace

ValueAndGradient wedge_distance(const format::Edge& edge, const Vector3& p) noexcept {
  const Vector3Map normal0(edge.normal[0]);
  const Vector3Map normal1(edge.normal[1]);
  const Vector3Map face0(edge.face[0]);
  const Vector3 from = p - Vector3Map(edge.point);
  const double above0 = normal0.dot(from);
  const double above1 = normal1.dot(from);
  const double along0 = face0.dot(from);
  double distance = 0.0;
  Vector3 gradient = Vector3::Zero();
  if (above0 <= 0.0 && above1 <= 0.0) {
    distance = std::max(above0, above1);
    gradient = above0 >= above1 ? normal0 : normal1;
  } else if (above0 > 0.0 && along0 >= 0.0) {
    distance = above0;
    gradient = normal0;
  } else if (above1 > 0.0 && Vector3Map(edge.face[1]).dot(from) >= 0.0) {
    distance = above1;
    gradient = normal1;
  } else {
    distance = std::sqrt(above0 * above0 + along0 * along0);
    if (distance > 0.0) gradient = (above0 * normal0 + along0 * face0) / distance;
  }
  return {edge.side * distance + edge.offset, edge.side * gradient};
}

ValueAndGradient edge_weight(const format::Edge& edge, const Vector3& p) noexcept {
  const Vector3Map along(edge.along);
  const Vector3 from = p - Vector3Map(edge.point);
  const double t = along.dot(from);
  if (!(t > edge.begin && t < edge.end)) return {};
  const bool nearer_begin = t - edge.begin <= edge.end - t;
  const double to_end = nearer_begin ? t - edge.begin : edge.end - t;
  const Vector3 inward = nearer_begin ? Vector3(along) : Vector3(-along);
  const double radius = edge_radius(edge, t);
  const Vector3 across = from - t * along;
  const double r = across.norm();
  if (r >= radius) return {};
  const double round = 2.0 * (1.0 - r / radius);
  const double axial = to_end / edge.ramp;
  if (round >= 1.0 && axial >= 1.0) return {1.0, Vector3::Zero()};
  if (axial <= round) return {axial, inward / edge.ramp};
  const double widens = radius < edge.radius ? edge.slope : 0.0;
  return {round, 2.0 / radius * (r / radius * widens * inward - across / r)};
}

}  // namespace godobject
