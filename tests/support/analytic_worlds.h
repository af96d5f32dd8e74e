#pragma once

#include <cmath>
#include <memory>

#include "core/pipeline/contact/contact_cycle.h"
#include "core/pipeline/corrected/corrected_cycle.h"
#include "core/pipeline/paper/paper_cycle.h"
#include "tests/support/analytic_shapes.h"
#include "toolchain/report/analytic/field.h"
#include "toolchain/report/analytic/sampled_body.h"

namespace godobject::test {

using analytic::AnalyticField;
using analytic::Ball;
using analytic::HalfSpace;

/// Two solid walls that face each other across the gap |x| < half_width.
struct Slot {
  double half_width = 0.02;
  double distance(const Vector3& p) const noexcept { return half_width - std::fabs(p.x()); }
  Vector3 gradient(const Vector3& p) const noexcept { return {p.x() > 0.0 ? -1.0 : 1.0, 0.0, 0.0}; }
};

/// An infinite plate with the middle plane z = 0; `thickness` is its full thickness.
struct Plate {
  double thickness = 0.002;
  double distance(const Vector3& p) const noexcept { return std::fabs(p.z()) - 0.5 * thickness; }
  Vector3 gradient(const Vector3& p) const noexcept { return {0.0, 0.0, p.z() < 0.0 ? -1.0 : 1.0}; }
};

/// The sampled body of the desk tools, constructed from samples of a surface.
class SampledBody : public analytic::SampledBody {
 public:
  /// `principal_inertia`: J_B / m [m^2].
  SampledBody(const SurfaceSamples& samples, const Vector3& principal_inertia, double voxel_size = 0.002)
      : analytic::SampledBody(samples.points, samples.normals, principal_inertia, voxel_size) {}
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

/// The cycles of the three solvers, each with the memory that the solver carries to the next cycle.
template <bool kFriction>
struct PaperCycle {
  template <class Field>
  Status operator()(const Field& field, const Pointshell& shell, const Parameters& q, const CycleInput& input,
                    ProxyState& state, CycleReport& report) {
    return paper_cycle<kFriction>(field, shell, q, input, state, report);
  }
};
template <bool kFriction>
struct CorrectedCycle {
  ProjectionState memory;
  template <class Field>
  Status operator()(const Field& field, const Pointshell& shell, const Parameters& q, const CycleInput& input,
                    ProxyState& state, CycleReport& report) {
    return corrected_cycle<kFriction>(field, shell, q, input, memory, state, report);
  }
};
/// Restarts the search in every cycle, so that each search looks at all points.
template <bool kFriction>
struct ContactCycle {
  std::unique_ptr<ContactMemory> memory = std::make_unique<ContactMemory>();
  bool is_first = true;
  template <class Field>
  Status operator()(const Field& field, const Pointshell& shell, const Parameters& q, const CycleInput& input,
                    ProxyState& state, CycleReport& report) {
    const ContactScene<Field, NoBodyField> scene(field, shell, {}, q);
    memory->search.start(scene, {});
    if (is_first) memory->H_WD_last = state.H_WS;
    is_first = false;
    return contact_cycle<kFriction>(scene, input, *memory, state, report);
  }
};

/// Runs one solver for a body in an analytic world, as GodObject does in a compiled scene. The body starts outside.
template <class Field, class Cycle>
struct AnalyticRun {
  const Field& field;
  const SampledBody& body;
  Parameters parameters;
  ProxyState state;
  CycleReport report;
  Cycle cycle;

  AnalyticRun(const Field& f, const SampledBody& b, const Pose& start) : field(f), body(b) {
    parameters.mass = b.mass;
    parameters.voxel_size = f.voxel_size();
    state.H_WS = start;
    state.started = true;
  }

  Status step(const Pose& H_WD, const Motion& velocity_W = {}) {
    const CycleInput input = input_within(H_WD, velocity_W, parameters);
    return cycle(field, body.pointshell(), parameters, input, state, report);
  }

  /// Returns the depth of the deepest sample point at the god object's pose [m], positive inside.
  double depth() const { return -smallest_distance(field, body.pointshell(), state.H_WS); }
};

}  // namespace godobject::test
