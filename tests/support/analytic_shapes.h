#pragma once

#include <cmath>
#include <vector>

#include "godobject/pose.h"
#include "toolchain/report/analytic/field.h"

namespace godobject::test {

/// Returns the exact signed distance to a ball centred at the origin [m].
inline double ball_distance(const Vector3& p, double radius) { return p.norm() - radius; }

using analytic::box_distance;

/// Sample points of a surface with unit normals that point into the body.
struct SurfaceSamples {
  std::vector<Vector3> points;
  std::vector<Vector3> normals;
};

/// Returns `count` points that are spread evenly (golden spiral) over a ball centred at the origin.
inline SurfaceSamples sample_ball(double radius, int count) {
  constexpr double kGoldenAngle = 2.399963229728653;
  SurfaceSamples samples;
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    const double ring = std::sqrt(1.0 - z * z);
    const Vector3 outward(ring * std::cos(kGoldenAngle * i), ring * std::sin(kGoldenAngle * i), z);
    samples.points.push_back(radius * outward);
    samples.normals.push_back(-outward);
  }
  return samples;
}

/// Returns the outer points of a lattice that fills a box centred at the origin; per_edge >= 2 points along each edge.
inline SurfaceSamples sample_box(const Vector3& half_edges, int per_edge) {
  SurfaceSamples samples;
  const int last = per_edge - 1;
  for (int z = 0; z <= last; ++z) {
    for (int y = 0; y <= last; ++y) {
      for (int x = 0; x <= last; ++x) {
        const auto side = [last](int i) { return i == 0 ? -1.0 : i == last ? 1.0 : 0.0; };
        const Vector3 outward(side(x), side(y), side(z));
        if (outward.isZero()) continue;
        const Vector3 at = 2.0 / last * Vector3(x, y, z) - Vector3::Ones();
        samples.points.push_back(at.cwiseProduct(half_edges));
        samples.normals.push_back(-outward.normalized());
      }
    }
  }
  return samples;
}

}  // namespace godobject::test
