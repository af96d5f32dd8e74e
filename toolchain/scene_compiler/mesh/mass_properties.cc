#include "toolchain/scene_compiler/mesh/mass_properties.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "toolchain/scene_compiler/mesh/box.h"
#include "toolchain/scene_compiler/mesh/triangle_geometry.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Of the bounding box's diagonal cubed. Chosen between the rounding of the sums, about 1e-15, and the thinnest body
/// with a useful inertia.
constexpr double kLeastVolume = 1e-10;
/// Of the largest moment. Single-precision coordinates some metres off the origin change equal moments by as much.
constexpr double kEqualMoments = 1e-5;

Matrix3d inertia_of_covariance(const Matrix3d& covariance) {
  return covariance.trace() * Matrix3d::Identity() - covariance;
}

Vector3d with_positive_largest(const Vector3d& axis) {
  // if components are equal up to rounding, the first decides
  int largest = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::abs(axis[i]) > std::abs(axis[largest]) + 1e-9) largest = i;
  }
  return axis[largest] < 0.0 ? Vector3d(-axis) : axis;
}

/// Returns the direction perpendicular to `axis` that is nearest to one of M's axes; the first of equally near ones.
Vector3d nearest_frame_axis_across(const Vector3d& axis) {
  int least = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::abs(axis[i]) < std::abs(axis[least]) - 1e-9) least = i;
  }
  return (Vector3d::Unit(least) - axis[least] * axis).normalized();
}

}  // namespace

MassMoments moments_of_volume(const TriangleMesh& closed_mesh) {
  MassMoments moments;
  if (closed_mesh.triangles.empty()) return moments;
  Box box;
  for (const auto& t : closed_mesh.triangles) {
    for (const std::uint32_t v : t) box.add(closed_mesh.vertices[v]);
  }
  const Vector3d reference = 0.5 * (box.low + box.high);
  Vector3d first = Vector3d::Zero();
  Matrix3d second = Matrix3d::Zero();
  double volume = 0.0;
  for (const auto& t : closed_mesh.triangles) {
    // integrals of 1, x and x x' over the tetrahedron from the reference to the triangle
    const Vector3d a = closed_mesh.vertices[t[0]] - reference;
    const Vector3d b = closed_mesh.vertices[t[1]] - reference;
    const Vector3d c = closed_mesh.vertices[t[2]] - reference;
    const double part = a.dot(b.cross(c)) / 6.0;
    const Vector3d sum = a + b + c;
    volume += part;
    first += part / 4.0 * sum;
    second += part / 20.0 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  if (!(volume > kLeastVolume * std::pow(box.diagonal(), 3))) return moments;
  const Vector3d offset = first / volume;
  moments.volume = volume;
  moments.center = reference + offset;
  moments.inertia = inertia_of_covariance(second / volume - offset * offset.transpose());
  return moments;
}

Vector3d centre_of_mass(const TriangleMesh& mesh, bool closed) {
  if (closed) {
    const MassMoments moments = moments_of_volume(mesh);
    if (moments.volume > 0.0) return moments.center;
  }
  Vector3d sum = Vector3d::Zero();
  double area = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vector3d &p = mesh.vertices[a], &q = mesh.vertices[b], &r = mesh.vertices[c];
    const double part = triangle_area(p, q, r);
    sum += part * (p + q + r) / 3.0;
    area += part;
  }
  return sum / area;
}

MassMoments moments_of_points(std::span<const Vector3d> points) {
  const double count = static_cast<double>(points.size());
  MassMoments moments;
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& point : points) sum += point - points.front();
  moments.center = points.front() + sum / count;
  Matrix3d covariance = Matrix3d::Zero();
  for (const Vector3d& point : points) covariance += (point - moments.center) * (point - moments.center).transpose();
  moments.inertia = inertia_of_covariance(covariance / count);
  return moments;
}

PrincipalAxes principal_axes(const Matrix3d& inertia) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(inertia);
  PrincipalAxes principal;
  principal.moments = solver.eigenvalues().cwiseMax(0.0);
  Vector3d& moments = principal.moments;
  Matrix3d& axes = principal.rotation_MB;
  const double equal = kEqualMoments * moments[2];
  if (moments[2] - moments[0] <= equal) {
    moments.setConstant(moments.mean());
    return principal;
  }
  if (moments[1] - moments[0] <= equal) {
    moments.head<2>().setConstant(0.5 * (moments[0] + moments[1]));
    axes.col(0) = with_positive_largest(nearest_frame_axis_across(solver.eigenvectors().col(2)));
    axes.col(1) = with_positive_largest(solver.eigenvectors().col(2).cross(axes.col(0)));
  } else if (moments[2] - moments[1] <= equal) {
    moments.tail<2>().setConstant(0.5 * (moments[1] + moments[2]));
    axes.col(0) = with_positive_largest(solver.eigenvectors().col(0));
    axes.col(1) = with_positive_largest(nearest_frame_axis_across(axes.col(0)));
  } else {
    axes.col(0) = with_positive_largest(solver.eigenvectors().col(0));
    axes.col(1) = with_positive_largest(solver.eigenvectors().col(1));
  }
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return principal;
}

}  // namespace godobject::scene_compiler
