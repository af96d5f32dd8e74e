#include "toolchain/report/extremes/run.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <fmt/format.h>

#include "core/pipeline/contact/contact_lengths.h"
#include "core/pipeline/penalty/penalty_contacts.h"
#include "core/pipeline/session.h"
#include "toolchain/report/analytic/sampled_body.h"
#include "toolchain/report/analytic/solid.h"
#include "toolchain/report/contact_quality/compiled_scene.h"
#include "toolchain/report/contact_quality/meshes.h"

namespace godobject::report {
namespace {

constexpr double kPeriod = 1e-3;
constexpr double kUp = 0.7071067811865476;

using analytic::Solid;
using Field = analytic::AnalyticField<Solid>;

class Draw {
 public:
  explicit Draw(std::uint32_t seed) : random_(seed) {}
  double between(double low, double high) { return low + (high - low) * static_cast<double>(random_()) / 4294967296.0; }
  Vector3 in_cube(double half) {
    const double x = between(-half, half);
    const double y = between(-half, half);
    return {x, y, between(-half, half)};
  }
  Vector3 direction() {
    for (;;) {
      const Vector3 v = in_cube(1.0);
      if (v.norm() < 1.0 && v.norm() > 0.1) return v.normalized();
    }
  }

 private:
  std::mt19937 random_;
};

Pose placement(const Setup& setup) {
  Pose H_WO;
  if (setup.far == 0.0) return H_WO;
  Draw draw(setup.seed + 1);
  H_WO.translation = setup.far * setup.scale * draw.direction();
  H_WO.rotation = exp_rotation(draw.between(0.0, 3.0) * draw.direction());
  return H_WO;
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

/// Returns the half edges of bodies that are boxes, or degenerate boxes.
Vector3 half_edges(const Setup& setup) {
  const double s = setup.scale;
  if (setup.body == "needle") return s * Vector3(1.0, 0.001, 0.001);
  if (setup.body == "flat") return s * Vector3(0.8, 0.6, 0.0);
  if (setup.body == "line") return s * Vector3(1.0, 0.0, 0.0);
  if (setup.body == "point") return Vector3::Zero();
  return s * Vector3(0.8, 0.5, 0.3);
}

analytic::SampledBody body_of(const Setup& setup) {
  Draw draw(setup.seed + 3);
  std::vector<Vector3> points;
  std::vector<Vector3> normals;
  const int count = setup.body == "point" ? 1 : std::max(setup.points, 1);
  if (setup.body == "ball") {
    for (int i = 0; i < count; ++i) {
      const Vector3 out = draw.direction();
      points.push_back(setup.scale * out);
      normals.push_back(-out);
    }
    return {points, normals, Vector3::Constant(0.4 * setup.scale * setup.scale), setup.voxel * setup.scale};
  }
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
  q.friction = {setup.friction_static, setup.friction_kinetic, 0.0};
  q.paper_friction = {setup.friction_static, setup.friction_kinetic, setup.friction_static, setup.friction_kinetic,
                      0.0};
  q.mass = mass;
  return q;
}

/// Returns the search radius of the longest sub-step; farther points are in no row.
double search_radius_of(const Parameters& q) { return ContactLengths::make(q).longest_search_radius; }

/// Calls visit(p, p_field, normal, gap) for the near points of the shell, which is at H in the field's frame.
template <class Field, class Visit>
void visit_near(const Field& field, const Pointshell& shell, const Pose& H, double reach, const Visit& visit) {
  for (std::size_t i = 0; i < shell.size; ++i) {
    const Vector3 p = shell.point(i);
    const Vector3 p_field = H * p;
    const FieldSample sample = field.sample(p_field);
    const double steepness = sample.gradient.norm();
    if (!(sample.distance < reach) || !(steepness > 1e-3)) continue;
    visit(p, p_field, Vector3(sample.gradient / steepness), sample.distance / steepness);
  }
}

template <class Field>
std::vector<Touch> sample_touches(const Field& field, const Pointshell& shell, const Pose& H_WS, double reach) {
  std::vector<Touch> touches;
  visit_near(field, shell, H_WS, reach, [&](const Vector3& p, const Vector3&, const Vector3& n, double gap) {
    touches.push_back({p, H_WS.rotation.conjugate() * n, gap});
  });
  return touches;
}

class AnalyticRig final : public Rig {
 public:
  explicit AnalyticRig(const Setup& setup)
      : field_(solid_of(setup).moved(placement(setup)), setup.voxel * setup.scale),
        body_(body_of(setup)),
        shell_(body_.pointshell()),
        q_(parameters_of(setup, body_.mass)),
        words_(RigSession::search_words(shell_, {})) {
    session_->start(field_, shell_, {}, q_, setup.solver, setup.friction, words_);
  }

  Status update(const Pose& H_WD, const Motion& velocity_W, CycleReport& report) override {
    CycleInput input;
    input.H_WD = H_WD;
    input.velocity_W = velocity_W;
    return session_->update(input, report);
  }

  double smallest_gap(const Pose& H_WS) const override { return smallest_distance(field_, shell_, H_WS); }
  std::vector<Touch> touches(const Pose& H_WS) const override {
    return sample_touches(field_, shell_, H_WS, search_radius_of(q_));
  }
  const Parameters& parameters() const override { return q_; }

 private:
  using RigSession = Session<Field, NoBodyField>;

  Field field_;
  analytic::SampledBody body_;
  Pointshell shell_;
  Parameters q_;
  std::vector<std::uint32_t> words_;
  std::unique_ptr<RigSession> session_ = std::make_unique<RigSession>();
};

TriangleMesh mesh_of(const Setup& setup) {
  const double s = setup.scale;
  Draw draw(setup.seed + 2);
  if (setup.world == "mesh-ball") return moved(ball_mesh(1.2 * s, 12), {Quaternion::Identity(), {0.0, 0.0, -1.2 * s}});
  if (setup.world == "mesh-turned") {
    const std::vector<TurnedCorner> profile = {{0.0, -2.0 * s},
                                               {draw.between(0.8, 1.6) * s, -2.0 * s},
                                               {draw.between(0.4, 0.8) * s, -draw.between(0.8, 1.4) * s},
                                               {draw.between(0.8, 1.6) * s, -draw.between(0.1, 0.5) * s},
                                               {0.0, 0.0}};
    return turned_solid(profile, 24);
  }
  return box_mesh({-1.6 * s, -1.4 * s, -1.2 * s}, {1.6 * s, 1.4 * s, 0.0});
}

/// A world from the scene compiler with the whole pipeline and both directions.
class CompiledRig final : public Rig {
 public:
  CompiledRig(const Setup& setup, const std::filesystem::path& work)
      : image_(compile("fuzz", text_of(setup, work), work)) {
    SceneView& scene = image_.scene;
    scene.settings.damping = setup.damping;
    H_BM_ = scene.H_MB.inverse();
    started_ = god_object_.start(scene, setup.solver, setup.friction);
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

  double smallest_gap(const Pose& H_WS) const override {
    return smallest_distance(image_.scene.voxelmap, image_.scene.pointshell, H_WS);
  }
  std::vector<Touch> touches(const Pose& H_WS) const override {
    const SceneView& scene = image_.scene;
    const double reach = search_radius_of(god_object_.parameters());
    std::vector<Touch> touches = sample_touches(scene.voxelmap, scene.pointshell, H_WS, reach);
    if (!scene.has_features()) return touches;
    Pose H_WF;
    H_WF.translation = scene.features_origin;
    visit_near(scene.body_map, scene.features, H_WS.inverse() * H_WF, reach,
               [&](const Vector3&, const Vector3& q_S, const Vector3& n, double gap) {
                 touches.push_back({q_S, -n, gap});
               });
    return touches;
  }
  const Parameters& parameters() const override { return god_object_.parameters(); }

 private:
  static SceneText text_of(const Setup& setup, const std::filesystem::path& work) {
    const Vector3 half =
        setup.body == "ball" ? Vector3::Constant(0.55 * setup.scale) : half_edges({.scale = setup.scale});
    const std::filesystem::path file = work / "body.ply";
    write_ply(setup.body == "ball" ? ball_mesh(0.9 * setup.scale, 8) : box_mesh(-half, half), file);
    return {.still = {.mesh = mesh_of(setup)},
            .body = file,
            .points = static_cast<std::uint32_t>(std::max(setup.points, 20)),
            .settings = {.voxel_size = setup.voxel * setup.scale,
                         .safety_distance = setup.safety_distance(),
                         .margin = setup.margin(),
                         .stiffness = setup.stiffness,
                         .coupling_rotation = setup.coupling_rotation * setup.scale * setup.scale,
                         .friction_static = setup.friction_static,
                         .friction_kinetic = setup.friction_kinetic}};
  }

  files::SceneImage image_;
  OwnedGodObject god_object_;
  Pose H_BM_;
  Status started_ = Status::kOk;
};

/// Returns an invalid pose; `which` selects the kind in turn.
Pose bad_pose(const Pose& pose, int which) {
  Pose bad = pose;
  switch (which % 4) {
    case 0: bad.translation.x() = std::numeric_limits<double>::quiet_NaN(); break;
    case 1: bad.translation.z() = std::numeric_limits<double>::infinity(); break;
    case 2: bad.rotation.coeffs() *= 1.01; break;
    default: bad.rotation.coeffs().setConstant(std::numeric_limits<double>::quiet_NaN()); break;
  }
  return bad;
}

double stretch(const Pose& H_WS, const Pose& H_WD, double rho_squared) {
  const Motion x = get_motion(H_WS.inverse() * H_WD);
  return std::sqrt(x.translation.squaredNorm() + rho_squared * x.rotation.squaredNorm());
}

/// Finds the violations of a cycle.
class Watch {
 public:
  Watch(const Setup& setup, const Rig& rig) : setup_(setup), rig_(rig), q_(rig.parameters()) {}

  void good_input(int cycle, Status status, const Pose& H_WD, const Motion& velocity, const CycleReport& report) {
    ++found.cycles;
    if (status != Status::kOk) {
      note(found.bad_status, cycle, fmt::format("refused: {}", describe(status)));
      return;
    }
    const DeviceForce& force = report.force;
    if (!report.H_WS.is_finite() || !force.total_W.force.allFinite() || !force.total_W.torque.allFinite()) {
      note(found.not_finite, cycle, "not finite");
      return;
    }
    if (std::fabs(report.H_WS.rotation.norm() - 1.0) > 1e-9) note(found.not_unit, cycle, "rotation not of unit length");
    check_force(cycle, H_WD, velocity, report);
    if (setup_.solver == Solver::kContact) check_constraints(cycle, H_WD, report);
    last_ = report.H_WS;
    started_ = true;
    was_inside_ = report.outcome == Outcome::kStartInside;
  }

  void bad_input(int cycle, Status status, const CycleReport& report) {
    ++found.cycles;
    if (status == Status::kOk) note(found.bad_status, cycle, "accepted an invalid pose");
    if (!report.force.total_W.force.isZero(0.0) || !report.force.total_W.torque.isZero(0.0)) {
      note(found.unbounded, cycle, "force without a pose");
    }
  }

  Violations found;

 private:
  void note(std::int64_t& count, int cycle, const std::string& what) {
    ++count;
    if (found.first.empty()) found.first = fmt::format("cycle {}: {}", cycle, what);
  }

  void check_force(int cycle, const Pose& H_WD, const Motion& velocity, const CycleReport& report) {
    constexpr double kRounding = 1.0 + 1e-6;
    const double rho_squared = q_.coupling_rotation / q_.coupling_translation;
    const double rho = std::sqrt(rho_squared);
    const Motion x = get_motion(report.H_WS.inverse() * H_WD);
    const double speed = std::hypot(velocity.translation.norm(), rho * velocity.rotation.norm());
    const double most_force = q_.stiffness * x.translation.norm() + q_.damping * speed;
    const double most_torque = q_.stiffness * q_.coupling_rotation * x.rotation.norm() + q_.damping * rho * speed;
    const double tiny = 1e-9 * q_.stiffness * setup_.scale * (1.0 + setup_.far);
    if (report.force.total_W.force.norm() > kRounding * most_force + tiny) {
      note(found.unbounded, cycle, fmt::format("{} N, at most {}", report.force.total_W.force.norm(), most_force));
    } else if (report.force.total_W.torque.norm() > kRounding * most_torque + rho * tiny) {
      note(found.unbounded, cycle, fmt::format("{} Nm, at most {}", report.force.total_W.torque.norm(), most_torque));
    }
  }

  void check_constraints(int cycle, const Pose& H_WD, const CycleReport& report) {
    if (report.outcome == Outcome::kStartInside) return;
    const double gap = rig_.smallest_gap(report.H_WS);
    const double rounding = 1e-12 * setup_.scale * (1.0 + setup_.far);
    if (gap < -rounding) note(found.crossings, cycle, fmt::format("a point is {} m inside", -gap));
    if (!started_ || was_inside_) return;
    const double rho_squared = q_.coupling_rotation / q_.coupling_translation;
    const double now = stretch(report.H_WS, H_WD, rho_squared);
    const double stayed = stretch(last_, H_WD, rho_squared);
    if (now <= stayed + 4.0 * q_.margin) return;
    const Motion wanted = get_motion(last_.inverse() * H_WD);
    Vector6 to_device;
    to_device << wanted.translation, std::sqrt(rho_squared) * wanted.rotation;
    const double out = (way_out(rig_.touches(last_), q_) - to_device).norm();
    if (now <= out + 4.0 * q_.margin) return;
    note(found.pulled_away, cycle,
         fmt::format("{} m from the device, {} without motion, {} by the shortest way out", now, stayed, out));
  }

  const Setup& setup_;
  const Rig& rig_;
  const Parameters& q_;
  Pose last_;
  bool started_ = false;
  bool was_inside_ = false;
};

}  // namespace

bool is_compiled(const Setup& setup) { return setup.world.starts_with("mesh"); }

std::unique_ptr<Rig> make_rig(const Setup& setup, const std::filesystem::path& work) {
  if (is_compiled(setup)) return std::make_unique<CompiledRig>(setup, work);
  return std::make_unique<AnalyticRig>(setup);
}

std::vector<Pose> device_path(const Setup& setup) {
  Draw draw(setup.seed);
  const double s = setup.scale;
  const Vector3 axis = draw.direction();
  const Vector3 way = draw.direction();
  const Vector3 rates(draw.between(0.3, 1.0), draw.between(0.3, 1.0), draw.between(0.3, 1.0));
  const Vector3 phases = draw.in_cube(3.0);
  const Pose H_WO = placement(setup);
  std::vector<Pose> path;
  Pose jumped;
  for (int k = 0; k < setup.cycles; ++k) {
    const double t = kPeriod * k;
    const double share = std::min(1.0, 5.0 * k / setup.cycles);  // of the way in
    Pose H_OD;
    if (setup.motion == "dash") {
      // back and forth through the origin, from 3 scales away
      const double along = std::fmod(setup.speed * t, 12.0);
      H_OD.translation = s * (along < 6.0 ? 3.0 - along : along - 9.0) * (way.z() < 0.0 ? Vector3(-way) : way);
      H_OD.rotation = exp_rotation(std::remainder(setup.spin * t, 2.0 * M_PI) * axis);
    } else if (setup.motion == "jump") {
      if (k % 20 == 0) {
        jumped.translation = k == 0 ? Vector3(0.0, 0.0, setup.start * s) : Vector3(draw.in_cube(3.0 * s));
        jumped.rotation = exp_rotation(draw.between(0.0, M_PI) * draw.direction());
      }
      H_OD = jumped;
    } else {
      const bool moves = setup.motion != "rest";
      const double z = setup.start + share * (-setup.depth - setup.start);
      const auto wave = [&](int i) { return moves ? share * std::sin(setup.speed * rates[i] * t + phases[i]) : 0.0; };
      H_OD.translation = s * Vector3(0.5 * wave(0), 0.5 * wave(1), z + setup.depth * wave(2));
      const double angle =
          setup.motion == "spin" ? std::remainder(setup.spin * t, 2.0 * M_PI) : 0.1 * setup.spin * wave(0);
      H_OD.rotation = exp_rotation(share * angle * axis);
      if (!moves) H_OD.translation += 1e-4 * s * draw.in_cube(1.0);  // the encoders' steps
    }
    path.push_back(H_WO * H_OD);
  }
  return path;
}

void Violations::add(const Violations& other) {
  cycles += other.cycles;
  bad_status += other.bad_status;
  not_finite += other.not_finite;
  not_unit += other.not_unit;
  crossings += other.crossings;
  unbounded += other.unbounded;
  pulled_away += other.pulled_away;
  if (first.empty()) first = other.first;
}

Violations run_setup(const Setup& setup, Rig& rig) {
  Watch watch(setup, rig);
  const std::vector<Pose> path = device_path(setup);
  Pose before = path.front();
  CycleReport report;
  for (int k = 0; k < setup.cycles; ++k) {
    const Pose& H_WD = path[static_cast<std::size_t>(k)];
    if (is_compiled(setup) && setup.bad_every > 0 && k % setup.bad_every == setup.bad_every - 1) {
      watch.bad_input(k, rig.update(bad_pose(H_WD, k / setup.bad_every), {}, report), report);
      continue;
    }
    Motion velocity;
    velocity.translation = (H_WD.translation - before.translation) / kPeriod;
    velocity.rotation =
        H_WD.rotation._transformVector(log_rotation(before.rotation.conjugate() * H_WD.rotation)) / kPeriod;
    before = H_WD;
    const Status status = rig.update(H_WD, velocity, report);
    watch.good_input(k, status, H_WD, velocity, report);
  }
  return watch.found;
}

}  // namespace godobject::report
