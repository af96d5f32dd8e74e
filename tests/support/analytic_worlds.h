#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/pipeline/cycle.h"
#include "core/scene/pointshell.h"
#include "tests/support/analytic_shapes.h"
#include "toolchain/report/analytic/field.h"

namespace godobject::test {

using analytic::AnalyticField;
using analytic::Ball;
using analytic::HalfSpace;

/// Solid but for the gap |x| < half_width: two walls that face each other.
struct Slot {
  double half_width = 0.02;
  double distance(const Vector3& p) const noexcept { return half_width - std::fabs(p.x()); }
  Vector3 gradient(const Vector3& p) const noexcept { return {p.x() > 0.0 ? -1.0 : 1.0, 0.0, 0.0}; }
};

/// A plate of full `thickness` about z = 0, without end.
struct Plate {
  double thickness = 0.002;
  double distance(const Vector3& p) const noexcept { return std::fabs(p.z()) - 0.5 * thickness; }
  Vector3 gradient(const Vector3& p) const noexcept { return {0.0, 0.0, p.z() < 0.0 ? -1.0 : 1.0}; }
};

/// Sample points with the sphere tree of one leaf; owns what its Pointshell looks at.
class SampledBody {
 public:
  /// `principal_inertia`: J_B / m [m^2].
  SampledBody(const SurfaceSamples& samples, const Vector3& principal_inertia, double voxel_size = 0.002)
      : count_(samples.points.size()) {
    for (const auto* vectors : {&samples.points, &samples.normals}) {
      for (int axis = 0; axis < 3; ++axis) {
        for (const Vector3& v : *vectors) values_.push_back(static_cast<float>(v[axis]));
      }
    }
    float radius = 0.0f;
    for (const Vector3& p : samples.points) radius = std::max(radius, static_cast<float>(p.norm() * (1.0 + 1e-6)));
    node_ = {{0.0f, 0.0f, 0.0f}, radius, 1, 0, static_cast<std::uint32_t>(count_), 0, 1};
    mass = MassModel::make(principal_inertia, static_cast<double>(radius),
                           std::max(static_cast<double>(radius), voxel_size));
  }

  Pointshell pointshell() const {
    const float* v = values_.data();
    return {count_, v, v + count_, v + 2 * count_, v + 3 * count_, v + 4 * count_, v + 5 * count_, {&node_, 1}};
  }

  MassModel mass;

 private:
  std::size_t count_;
  std::vector<float> values_;
  format::Node node_{};
};

/// A solid ball of 20 mm radius.
inline SampledBody ball_body(double radius = 0.02, int count = 2000) {
  return {sample_ball(radius, count), Vector3::Constant(0.4 * radius * radius)};
}

/// A solid box of 60 x 40 x 30 mm; axes sorted so that the principal moments ascend as in a compiled body.
inline SampledBody box_body(int per_edge = 13) {
  const Vector3 edges(0.06, 0.04, 0.03);
  const Vector3 squares = edges.cwiseProduct(edges);
  return {sample_box(0.5 * edges, per_edge), (Vector3::Constant(squares.sum()) - squares) / 12.0};
}

/// The god object of a body in an analytic world, with one solver: what GodObject is for compiled scenes.
template <class Field, auto kCycle>
struct AnalyticRun {
  const Field& field;
  const SampledBody& body;
  Parameters parameters;
  State state;
  CycleReport report;

  AnalyticRun(const Field& f, const SampledBody& b, const Pose& start) : field(f), body(b) {
    parameters.mass = b.mass;
    parameters.voxel_size = f.voxel_size();
    state.H_WS = start;
    state.started = true;
  }

  Status step(const Pose& H_WD, const Motion& velocity_W = {}) {
    return kCycle(field, body.pointshell(), parameters, CycleInput{H_WD, velocity_W}, state, report, nullptr);
  }

  /// Deepest sample point below the surface at the god object's pose [m], positive inside.
  double depth() const { return -smallest_distance(field, body.pointshell(), state.H_WS); }
};

}  // namespace godobject::test
