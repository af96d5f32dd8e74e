#include "toolchain/report/analytic/solid.h"

namespace godobject::analytic {
namespace {

double distance_to(const Primitive& primitive, const Vector3& p_O) noexcept {
  return std::visit([&](const auto& shape) { return shape.distance(p_O); }, primitive);
}

Vector3 gradient_of(const Primitive& primitive, const Vector3& p_O) noexcept {
  return std::visit([&](const auto& shape) { return shape.gradient(p_O); }, primitive);
}

}  // namespace

Vector3 Box::gradient(const Vector3& p) const noexcept {
  const Vector3 to_p = p - center;
  const Vector3 q = to_p.cwiseAbs() - half_edges;
  const auto outward = [&](int axis) { return to_p[axis] < 0.0 ? -1.0 : 1.0; };
  const Vector3 outside = q.cwiseMax(0.0);
  const double length = outside.norm();
  if (length > 0.0) return Vector3(outward(0) * outside[0], outward(1) * outside[1], outward(2) * outside[2]) / length;
  Eigen::Index axis = 0;
  q.maxCoeff(&axis);
  return outward(static_cast<int>(axis)) * Vector3::Unit(axis);
}

Vector3 Bore::gradient(const Vector3& p) const noexcept {
  const double length = p.head<2>().norm();
  return length > 0.0 ? Vector3(-p.x() / length, -p.y() / length, 0.0) : Vector3(Vector3::UnitX());
}

Solid Solid::moved(const Pose& H_WO) const {
  Solid result = *this;
  result.H_WO_ = H_WO;
  result.H_OW_ = H_WO.inverse();
  return result;
}

double Solid::distance(const Vector3& p_W) const noexcept {
  const Vector3 p_O = H_OW_ * p_W;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Primitive& primitive : primitives_) nearest = std::min(nearest, distance_to(primitive, p_O));
  return nearest;
}

Vector3 Solid::gradient(const Vector3& p_W) const noexcept {
  const Vector3 p_O = H_OW_ * p_W;
  const auto nearest = std::min_element(
      primitives_.begin(), primitives_.end(),
      [&](const Primitive& a, const Primitive& b) { return distance_to(a, p_O) < distance_to(b, p_O); });
  return H_WO_.rotation._transformVector(gradient_of(*nearest, p_O));
}

void Solid::pieces(const Vector3& p_W, std::vector<Piece>& out) const {
  const Vector3 p_O = H_OW_ * p_W;
  for (const Primitive& primitive : primitives_) {
    out.push_back({distance_to(primitive, p_O), H_WO_.rotation._transformVector(gradient_of(primitive, p_O))});
  }
}

}  // namespace godobject::analytic
