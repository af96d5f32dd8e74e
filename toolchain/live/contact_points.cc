#include "toolchain/live/contact_points.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "core/pipeline/penalty/penalty_contacts.h"

namespace godobject::live {
namespace {

using Column = Eigen::Matrix<double, 6, 1>;  // the wrench of a unit load, torques over the length

constexpr double kRegularisation = 1e-3;

struct NearPoint {
  ContactPoint point;
  double distance = 0.0;  // [m]
};

/// A point's gradient below this length has no direction.
constexpr double kFlat = 1e-6;

void add(std::vector<NearPoint>& near, const Vector3& p_W, const Vector3& gradient_W, double distance) {
  const double length = gradient_W.norm();
  if (length > kFlat) near.push_back({{p_W, gradient_W / length, 0.0}, distance});
}

/// The points of both directions whose distance is below `reach` [m].
std::vector<NearPoint> near_points(const SceneView& scene, const Pose& H_WS, double reach) {
  std::vector<NearPoint> near;
  visit_points_below(reach, scene.voxelmap, scene.pointshell, H_WS, [&](std::size_t, const Vector3& p_W) {
    const FieldSample sample = scene.voxelmap.sample(p_W);
    if (sample.distance < reach) add(near, p_W, sample.gradient, sample.distance);
    return reach;
  });
  if (!scene.has_features()) return near;
  const Pose H_SF = H_WS.inverse() * Pose{Quaternion::Identity(), scene.features_origin};
  visit_points_below(reach, scene.body_map, scene.features, H_SF, [&](std::size_t, const Vector3& p_S) {
    const FieldSample sample = scene.body_map.sample(p_S);
    if (sample.distance < reach) {
      add(near, H_WS * p_S, H_WS.rotation._transformVector(-sample.gradient), sample.distance);
    }
    return reach;
  });
  return near;
}

/// The nearest points, the nearest first, none of them closer than `apart` [m] to another one with about the same
/// normal. Stops at one more than a picture shows.
std::vector<ContactPoint> apart_by(const std::vector<NearPoint>& near, double apart) {
  constexpr double kSameNormal = 0.9;  // cosine
  std::vector<ContactPoint> chosen;
  for (const auto& [point, distance] : near) {
    const bool shown = std::any_of(chosen.begin(), chosen.end(), [&](const ContactPoint& other) {
      return (other.p_W - point.p_W).squaredNorm() < apart * apart && other.normal_W.dot(point.normal_W) > kSameNormal;
    });
    if (!shown) chosen.push_back(point);
    if (chosen.size() > kMostContactPoints) break;
  }
  return chosen;
}

/// Points that stand for all, `apart` [m] from each other, or farther if there are too many.
std::vector<ContactPoint> spread(std::vector<NearPoint> near, double apart) {
  constexpr double kFarther = 1.4;
  std::stable_sort(near.begin(), near.end(),
                   [](const NearPoint& a, const NearPoint& b) { return a.distance < b.distance; });
  std::vector<ContactPoint> chosen = apart_by(near, apart);
  for (int i = 0; chosen.size() > kMostContactPoints && i < 20; ++i) {
    apart *= kFarther;
    chosen = apart_by(near, apart);
  }
  chosen.resize(std::min(chosen.size(), kMostContactPoints));
  return chosen;
}

/// Returns the loads of least squares with regularisation, on those points alone that push.
std::vector<double> pushing_loads(const std::vector<Column>& columns, const Column& wanted) {
  std::vector<double> loads(columns.size());
  std::vector<bool> used(columns.size(), true);
  for (bool pulls = true; pulls;) {
    Eigen::Matrix<double, 6, 6> sum = kRegularisation * Eigen::Matrix<double, 6, 6>::Identity();
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (used[i]) sum += columns[i] * columns[i].transpose();
    }
    const Column dual = sum.ldlt().solve(wanted);
    pulls = false;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      loads[i] = used[i] ? columns[i].dot(dual) : 0.0;
      if (loads[i] >= 0.0) continue;
      loads[i] = 0.0;
      used[i] = false;
      pulls = true;
    }
  }
  return loads;
}

}  // namespace

/// Minimises |A x - w|^2 + kRegularisation |x|^2 for loads x >= 0, where the regularisation chooses among equal
/// explanations. It begins with the solution without the bound, from which points that would pull are left out until
/// none does. One load after the other (Gauss and Seidel) then comes to the minimum.
void set_loads(std::vector<ContactPoint>& points, const Vector3& c_W, const Wrench& wrench_W, double length) {
  constexpr int kSweeps = 50;
  std::vector<Column> columns;
  Column wanted;
  wanted << wrench_W.force, wrench_W.torque / length;
  for (const ContactPoint& point : points) {
    columns.emplace_back();
    columns.back() << point.normal_W, (point.p_W - c_W).cross(point.normal_W) / length;
  }
  std::vector<double> loads = pushing_loads(columns, wanted);
  Column rest = wanted;
  for (std::size_t i = 0; i < loads.size(); ++i) rest -= loads[i] * columns[i];
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (std::size_t i = 0; i < loads.size(); ++i) {
      const double slope = columns[i].dot(rest) - kRegularisation * loads[i];
      const double load = std::max(0.0, loads[i] + slope / (columns[i].squaredNorm() + kRegularisation));
      rest -= (load - loads[i]) * columns[i];
      loads[i] = load;
    }
  }
  for (std::size_t i = 0; i < loads.size(); ++i) points[i].load = loads[i];
}

std::vector<ContactPoint> contact_points(const SceneView& scene, const Pose& H_WS, const Wrench& wrench_W) {
  constexpr double kApart = 0.02;  // share of the body's radius
  const double margin = scene.settings.margin;
  const double nearest = smallest_distance(scene.voxelmap, scene.pointshell, H_WS);
  if (nearest > 2.0 * std::max(margin, scene.settings.safety_distance)) return {};
  const double radius = scene.body.sphere_radius;
  std::vector<ContactPoint> points = spread(near_points(scene, H_WS, nearest + margin), kApart * radius);
  set_loads(points, H_WS.translation, wrench_W, radius);
  return points;
}

}  // namespace godobject::live
