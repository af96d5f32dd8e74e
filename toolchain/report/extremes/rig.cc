#include "toolchain/report/extremes/rig.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/pipeline/cycle/workspace_limit.h"
#include "core/pipeline/penalty/penalty_contacts.h"
#include "core/pipeline/session.h"
#include "toolchain/report/analytic/sampled_body.h"
#include "toolchain/report/analytic/solid.h"
#include "toolchain/report/extremes/compiled_world.h"
#include "toolchain/report/extremes/draw.h"
#include "toolchain/session/owned_god_object.h"
#include "toolchain/watch/oracle.h"
#include "toolchain/watch/watched_scene.h"

namespace godobject::report {
namespace {

constexpr double kUp = 0.7071067811865476;

using analytic::Solid;
using Field = analytic::AnalyticField;

/// Returns the box of the moving body's origin, about a place a little above the still body.
WorkspaceBox workspace_of(const Setup& setup) {
  WorkspaceBox box;
  if (setup.workspace == 0.0) return box;
  const double s = setup.scale;
  const Vector3 middle = placement(setup) * Vector3(0.0, 0.0, 0.5 * s * setup.body_scale);
  box.limited = true;
  box.low = middle - Vector3::Constant(setup.workspace * s);
  box.high = middle + Vector3::Constant(setup.workspace * s);
  return box;
}

Solid solid_of(const Setup& setup) {
  using analytic::Ball;
  using analytic::Bore;
  using analytic::Box;
  using analytic::HalfSpace;
  const double s = setup.scale;
  const double w = setup.width * s;
  if (setup.world == "plane") return Solid({HalfSpace{}});
  if (setup.world == "slot") return Solid({HalfSpace{Vector3::UnitX(), -w}, HalfSpace{-Vector3::UnitX(), -w}});
  if (setup.world == "groove") return Solid({HalfSpace{{kUp, 0.0, kUp}, -w}, HalfSpace{{-kUp, 0.0, kUp}, -w}});
  if (setup.world == "bore") return Solid({Bore{w}});
  if (setup.world == "plate") {
    const double half = setup.voxel * s;
    return Solid({Box{{0.0, 0.0, -half}, {50.0 * s, 50.0 * s, half}, 0.0}});
  }
  Draw draw(setup.seed + 2);
  std::vector<analytic::Primitive> heap;
  const int count = 1 + static_cast<int>(draw.between(0.0, 4.0));
  for (int i = 0; i < count; ++i) {
    const Vector3 center = draw.in_cube(1.5 * s) - Vector3(0.0, 0.0, 1.5 * s);
    const Vector3 half = s * Vector3(draw.between(0.1, 1.5), draw.between(0.1, 1.5), draw.between(0.1, 1.5));
    const double radius = draw.between(0.0, 1.0) < 0.5 ? 0.0 : 0.2 * s;
    if (draw.between(0.0, 1.0) < 0.4) {
      heap.emplace_back(Ball{center, half.x()});
    } else {
      heap.emplace_back(Box{center, half, radius});
    }
  }
  return Solid(heap);
}

/// An ell: two boxes with a common edge, about the middle of their corner; a concave body.
analytic::SampledBody ell_of(const Setup& setup, int count, Draw& draw) {
  const double s = setup.scale * setup.body_scale;
  const Vector3 half(0.6 * s, 0.2 * s, 0.25 * s);
  std::vector<Vector3> points;
  std::vector<Vector3> normals;
  for (int i = 0; i < count; ++i) {
    const auto face = static_cast<Eigen::Index>(draw.between(0.0, 3.0));
    Vector3 p = draw.in_cube(1.0);
    p[face] = p[face] < 0.0 ? -1.0 : 1.0;
    if (i < 16) p = Vector3((i & 1) != 0 ? 1.0 : -1.0, (i & 2) != 0 ? 1.0 : -1.0, (i & 4) != 0 ? 1.0 : -1.0);
    Vector3 at = half.cwiseProduct(p) + Vector3(0.3 * s, -0.2 * s, 0.0);
    Vector3 normal = (p[face] < 0.0 ? 1.0 : -1.0) * Vector3::Unit(face);
    if ((i < 16 ? i / 8 : i) % 2 == 1) {  // the other arm: along y
      std::swap(at.x(), at.y());
      std::swap(normal.x(), normal.y());
    }
    points.push_back(at);
    normals.push_back(normal);
  }
  return {points, normals, s * s * Vector3(0.1, 0.15, 0.2), setup.voxel * setup.scale};
}

analytic::SampledBody body_of(const Setup& setup) {
  Draw draw(setup.seed + 3);
  const double radius = setup.scale * setup.body_scale;
  std::vector<Vector3> points;
  std::vector<Vector3> normals;
  const int count = setup.body == "point" ? 1 : std::max(setup.points, 1);
  if (setup.body == "ball") {
    for (int i = 0; i < count; ++i) {
      const Vector3 out = draw.direction();
      points.push_back(radius * out);
      normals.push_back(-out);
    }
    return {points, normals, Vector3::Constant(0.4 * radius * radius), setup.voxel * setup.scale};
  }
  if (setup.body == "ell") return ell_of(setup, count, draw);
  const Vector3 half = half_edges(setup);
  for (int i = 0; i < count; ++i) {
    // corners first, then anywhere on the faces
    const auto face = static_cast<Eigen::Index>(draw.between(0.0, 3.0));
    Vector3 p = draw.in_cube(1.0);
    p[face] = p[face] < 0.0 ? -1.0 : 1.0;
    if (i < 8) p = Vector3((i & 1) != 0 ? 1.0 : -1.0, (i & 2) != 0 ? 1.0 : -1.0, (i & 4) != 0 ? 1.0 : -1.0);
    points.push_back(half.cwiseProduct(p));
    normals.push_back((p[face] < 0.0 ? 1.0 : -1.0) * Vector3::Unit(face));
  }
  const Vector3 squares = half.cwiseProduct(half);
  return {points, normals, (Vector3::Constant(squares.sum()) - squares) / 3.0, setup.voxel * setup.scale};
}

Parameters parameters_of(const Setup& setup, const MassModel& mass) {
  Parameters q;
  q.voxel_size = setup.voxel * setup.scale;
  q.safety_distance = setup.safety_distance();
  q.margin = setup.margin();
  q.stiffness = setup.stiffness;
  q.damping = setup.damping;
  q.coupling_rotation = setup.coupling_rotation * setup.scale * setup.scale;
  q.period = setup.period;
  if (setup.point_budget > 0) q.point_budget = static_cast<std::uint32_t>(setup.point_budget);
  if (setup.work_budget > 0.0) q.work_budget = static_cast<std::uint64_t>(setup.work_budget);
  q.workspace = workspace_of(setup);
  q.friction = {setup.friction_static, setup.friction_kinetic, setup.friction_viscous};
  q.paper_friction = {setup.friction_static, setup.friction_kinetic, setup.friction_static, setup.friction_kinetic,
                      0.0};
  q.mass = mass;
  return q;
}

double rounding_of(const Setup& setup) { return 1e-12 * setup.scale * (1.0 + setup.far); }

/// The solid itself, as the watch sees it.
class SolidOracle final : public watch::Oracle {
 public:
  explicit SolidOracle(const Solid& solid) : solid_(solid) {}
  double distance(const Vector3& p) const override { return solid_.distance(p); }
  Vector3 gradient(const Vector3& p) const override { return solid_.gradient(p); }
  double lipschitz() const override { return 1.0; }

 private:
  Solid solid_;
};

class AnalyticRig final : public Rig {
 public:
  explicit AnalyticRig(const Setup& setup)
      : setup_(setup),
        solid_(solid_of(setup).moved(placement(setup))),
        oracle_(solid_),
        field_(solid_, setup.voxel * setup.scale),
        body_(body_of(setup)),
        shell_(body_.pointshell()),
        q_(parameters_of(setup, body_.mass)),
        words_(setup.remembers ? RigSession::search_words(shell_, {}) : 0) {
    session_->start(field_, shell_, {}, q_, setup.solver, setup.friction, words_);
  }

  Status update(const Pose& H_WD, const Motion& velocity_W, CycleReport& report) override {
    const CycleInput input = input_within(H_WD, velocity_W, q_);
    if (input.outside && !session_->state().started) {
      report = CycleReport{};
      report.H_WS = H_WD;
      report.outside = true;
      return Status::kOk;
    }
    const Status status = session_->update(input, report);
    if (status == Status::kOk) return status;
    report = CycleReport{};
    report.H_WS = session_->state().H_WS;
    report.outcome = Outcome::kBadInput;
    return status;
  }

  std::span<const Pose> path() const override { return session_->path().poses(); }

  watch::WatchedSession watched() const override {
    watch::WatchedSession watched;
    watched.directions.push_back({.field = &oracle_, .points = watch::points_of(shell_)});
    watched.parameters = q_;
    watched.solver = setup_.solver;
    watched.friction = setup_.friction;
    watched.rounding = rounding_of(setup_);
    return watched;
  }

 private:
  using RigSession = Session<Field, NoBodyField>;

  Setup setup_;
  Solid solid_;
  SolidOracle oracle_;
  Field field_;
  analytic::SampledBody body_;
  Pointshell shell_;
  Parameters q_;
  std::vector<std::uint32_t> words_;
  std::unique_ptr<RigSession> session_ = std::make_unique<RigSession>();
};

/// A session in a world from the scene compiler with the whole pipeline and both directions.
class CompiledRig final : public Rig {
 public:
  CompiledRig(const Setup& setup, std::shared_ptr<const CompiledWorld> world)
      : setup_(setup), world_(std::move(world)), H_BM_(world_->scene().H_MB.inverse()) {
    SceneView scene = world_->scene();
    format::Settings& settings = scene.settings;
    settings.stiffness = setup.stiffness;
    settings.damping = setup.damping;
    settings.coupling_rotation = setup.coupling_rotation * setup.scale * setup.scale;
    settings.friction_static = setup.friction_static;
    settings.friction_kinetic = setup.friction_kinetic;
    settings.friction_viscous = setup.friction_viscous;
    settings.point_budget = static_cast<std::uint32_t>(setup.point_budget);
    scene.workspace = workspace_of(setup);
    started_ = god_object_.start(scene, setup.solver, setup.friction, setup.remembers);
    if (setup.work_budget > 0.0) god_object_->set_work_budget(static_cast<std::uint64_t>(setup.work_budget));
  }

  Status update(const Pose& H_WD, const Motion& velocity_W, CycleReport& report) override {
    if (started_ != Status::kOk) return started_;
    Pose H_WM = H_WD;  // unchanged: an invalid pose must arrive as it is
    if (H_WD.is_finite()) {
      H_WM.translation = H_WD * H_BM_.translation;
      H_WM.rotation = H_WD.rotation * H_BM_.rotation;
    }
    return god_object_->update({H_WM, velocity_W}, report);
  }

  std::span<const Pose> path() const override { return god_object_->session()->path().poses(); }

  watch::WatchedSession watched() const override {
    // H_MB and its inverse; points and the grid's origin in single precision
    const double rounding = 1e-7 * setup_.scale * (setup_.voxel + setup_.far);
    return world_->watched({setup_.solver, setup_.friction, god_object_.parameters()}, rounding);
  }

 private:
  Setup setup_;
  std::shared_ptr<const CompiledWorld> world_;
  Pose H_BM_;
  OwnedGodObject god_object_;
  Status started_ = Status::kOk;
};

}  // namespace

Vector3 half_edges(const Setup& setup) {
  const double s = setup.scale * setup.body_scale;
  if (setup.body == "needle") return s * Vector3(1.0, 0.001, 0.001);
  if (setup.body == "flat") return s * Vector3(0.8, 0.6, 0.0);
  if (setup.body == "line") return s * Vector3(1.0, 0.0, 0.0);
  if (setup.body == "point") return Vector3::Zero();
  return s * Vector3(0.8, 0.5, 0.3);
}

Pose placement(const Setup& setup) {
  Pose H_WO;
  if (setup.far == 0.0) return H_WO;
  Draw draw(setup.seed + 1);
  H_WO.translation = setup.far * setup.scale * draw.direction();
  H_WO.rotation = exp_rotation(draw.between(0.0, 3.0) * draw.direction());
  return H_WO;
}

Vector3 inner_place(const Setup& setup) {
  if (setup.world != "heap") return {0.0, 0.0, -0.5 * setup.scale};
  Draw draw(setup.seed + 2);
  static_cast<void>(draw.between(0.0, 4.0));  // the number of solids
  return draw.in_cube(1.5 * setup.scale) - Vector3(0.0, 0.0, 1.5 * setup.scale);
}

bool is_compiled(const Setup& setup) { return setup.world.starts_with("mesh"); }

std::unique_ptr<Rig> make_rig(const Setup& setup, const std::filesystem::path& work) {
  if (is_compiled(setup)) return make_rig_in(std::make_shared<const CompiledWorld>(setup, work), setup);
  return std::make_unique<AnalyticRig>(setup);
}

std::unique_ptr<Rig> make_rig_in(std::shared_ptr<const CompiledWorld> world, const Setup& setup) {
  return std::make_unique<CompiledRig>(setup, std::move(world));
}

}  // namespace godobject::report
