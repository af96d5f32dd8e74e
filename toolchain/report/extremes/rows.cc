#include "toolchain/report/extremes/rows.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/report/analytic/field.h"
#include "toolchain/report/contact_quality/compiled_scene.h"
#include "toolchain/report/contact_quality/meshes.h"
#include "toolchain/report/extremes/bounds.h"
#include "toolchain/report/extremes/run.h"
#include "toolchain/scene_compiler/compile_scene.h"

namespace godobject::report {
namespace {

namespace bound = extremes_bound;

constexpr double kPeriod = 1e-3;

double to_double(bool yes) { return yes ? 1.0 : 0.0; }

/// Returns a scene with a body, for look-ups only.
SceneText with_a_body(CompiledStill still, double voxel_size, const std::filesystem::path& work) {
  const std::filesystem::path body = work / "body.ply";
  write_ply(box_mesh(Vector3::Constant(-0.01), Vector3::Constant(0.01)), body);
  return {.still = std::move(still),
          .body = body,
          .points = 60,
          .settings = {.voxel_size = voxel_size, .safety_distance = 1.5 * voxel_size},
          .only_solver = format::Solver::kPaper};
}

struct LookUps {
  std::int64_t not_finite = 0;
  std::int64_t wrong_sign = 0;  ///< only where the exact distance exceeds a voxel
};

LookUps look_up(const SceneView& scene, const Vector3& half, int count, bool open, double distance_gain,
                std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  LookUps found;
  for (int i = 0; i < count; ++i) {
    const double reach = i % 10 == 0 ? 100.0 : 1.3;  // some far outside the grid
    const Vector3 p = reach * half.cwiseProduct(Vector3(unit(random), unit(random), unit(random)));
    FieldSample sample = scene.voxelmap.sample(p);
    sample.distance *= distance_gain;
    const LayerSample layer = scene.voxelmap.layer(p);
    if (!std::isfinite(sample.distance) || !sample.gradient.allFinite() || !layer.to_center.allFinite())
      ++found.not_finite;
    const double exact = analytic::box_distance(p, half);
    if (!open && std::fabs(exact) > scene.grid.voxel_size && std::signbit(exact) != std::signbit(sample.distance)) {
      ++found.wrong_sign;
    }
  }
  return found;
}

/// Returns the compiler's report, or one without flaws if a fault hides them.
scene_compiler::MeshReport told_flaws(const scene_compiler::MeshReport& report, const ExtremesFault& fault) {
  return fault.hides_flaws ? scene_compiler::MeshReport{} : report;
}

/// Returns a mesh of the box with a flaw of this kind.
TriangleMesh flawed_box(const std::string& kind, const Vector3& half) {
  TriangleMesh mesh = box_mesh(-half, half);
  auto& triangles = mesh.triangles;
  const auto first = triangles.front();
  if (kind == "degenerate") {
    for (int i = 0; i < 5; ++i) triangles.push_back({first[0], first[1], first[1]});
  } else if (kind == "duplicate") {
    for (int i = 0; i < 5; ++i) triangles.push_back(first);
  } else if (kind == "flipped") {
    std::swap(triangles.front()[0], triangles.front()[1]);
  } else if (kind == "open") {
    triangles.pop_back();
  }
  return mesh;
}

/// Tells if the report contains the flaw of this kind.
bool is_reported(const std::string& kind, const scene_compiler::MeshReport& report) {
  if (kind == "degenerate") return report.degenerate_triangles == 5;
  if (kind == "duplicate") return report.duplicate_triangles == 5;
  if (kind == "flipped") return report.turned_triangles == 1;
  return kind != "open" || report.boundary_edges != 0;
}

}  // namespace

CaseResult bad_meshes(const RowRequest& request, const std::filesystem::path& work) {
  const Vector3 half(0.03, 0.02, 0.01);
  const int look_ups = request.quick ? 100'000 : 20'000'000;
  CaseResult result;
  const auto note = [&](const Bound& bound, double value, const std::string& where) {
    result.findings.push_back(judged(bound, value, where));
  };
  const std::vector<std::string> kinds =
      request.one_place ? std::vector<std::string>{"degenerate"}
                        : std::vector<std::string>{"sound", "degenerate", "duplicate", "flipped", "open"};
  for (const std::string& kind : kinds) {
    const std::string of_each = fmt::format("{}, {} look-ups", kind, look_ups);
    const bool is_repairable = kind != "flipped" && kind != "open";
    const std::filesystem::path folder = work / kind;
    std::filesystem::create_directories(folder);
    const SceneText text = with_a_body({.mesh = flawed_box(kind, half)}, 0.002, folder);
    try {
      const auto told = compile_image(kind, text, folder);
      if (request.fault.refuses_meshes) throw command::Failure(command::ExitCode::kBadData, "planted");
      const auto image = files::SceneImage::read(folder / (kind + ".scene"));
      const LookUps found =
          look_up(image.scene, half, look_ups, kind == "open", request.fault.distance_gain, 7 + request.seed);
      note(bound::kNotFinite, static_cast<double>(found.not_finite), of_each);
      if (is_repairable) note(bound::kWrongSign, static_cast<double>(found.wrong_sign), of_each);
      const bool reported = is_reported(kind, told_flaws(told.still.report, request.fault));
      if (kind != "sound") note(bound::kNotReported, to_double(!reported), kind);
      if (is_repairable) note(bound::kRefused, 0.0, kind);
    } catch (const command::Failure& failure) {
      // a refusal is as good, except for a mesh that can be repaired
      note(bound::kRefused, to_double(is_repairable), fmt::format("{}: {}", kind, failure.what()));
    }
  }
  return result;
}

CaseResult gap_near_the_voxel(const RowRequest& request, const std::filesystem::path& work) {
  constexpr double kVoxel = 0.002;
  CaseResult result;
  Sheet sheet{.name = "extremes_gap", .columns = {"gap_over_voxel", "outcome"}, .rows = {}};
  const std::vector<double> gaps = request.one_place ? std::vector<double>{1.5}
                                   : request.quick   ? std::vector<double>{0.9, 1.5, 2.5}
                                                     : std::vector<double>{0.5, 0.9, 1.1, 1.5, 1.9, 2.5, 4.0};
  for (const double gap : gaps) {
    const double half = 0.5 * gap * kVoxel;
    const std::vector<double> x = {-0.02, -half, half, 0.02};
    const TriangleMesh still =
        cell_solid({x, {-0.02, 0.02}, {-0.02, -0.01, 0.02}}, [](int i, int, int k) { return i != 1 || k == 0; });
    const std::string name = fmt::format("gap-{}", gap);
    const std::filesystem::path folder = work / name;
    std::filesystem::create_directories(folder);
    const SceneText text = with_a_body({.mesh = still}, kVoxel, folder);
    std::string outcome;
    try {
      const auto told = compile_image(name, text, folder);
      outcome = told.thin.gaps.samples > 0 && !request.fault.hides_flaws ? "flagged" : "taken";
    } catch (const command::Failure& failure) {
      outcome = "refused";
    }
    sheet.rows.push_back({cell(gap), outcome});
    const bool wrong = gap < 2.0 ? outcome == "taken" : outcome == "refused";
    result.findings.push_back(judged(bound::kGap, to_double(wrong), fmt::format("{} voxels: {}", gap, outcome)));
  }
  result.sheets.push_back(sheet);
  return result;
}

CaseResult same_at_every_scale(const RowRequest& request) {
  CaseResult result;
  std::mt19937 random(11 + request.seed);
  for (int i = 0; i < (request.quick ? 5 : 40); ++i) {
    Setup setup = setup_of(kRows[0], random);
    setup.motion = "press";
    setup.world = i % 2 == 0 ? "plane" : "heap";
    setup.far = 0.0;
    setup.friction = false;
    setup.cycles = 400;
    const auto god_objects = [&request](const Setup& at) {
      const auto rig = make_rig(at, {});
      FaultyReports reports(request.fault.cycle);
      std::vector<Pose> poses;
      CycleReport report;
      for (const Pose& H_WD : device_path(at)) {
        if (rig->update(H_WD, {}, report) != Status::kOk) report.H_WS.translation.setConstant(std::nan(""));
        reports.spoil(report);
        poses.push_back(report.H_WS);
      }
      return poses;
    };
    setup.scale = 1.0;  // others are powers of two from it, so that the float sample points round in the same way
    const auto unit = god_objects(setup);
    for (const double scale : {0x1p-10, 0x1p-6, 0x1p6, 0x1p10}) {
      Setup scaled = setup;
      scaled.scale = scale;
      const auto poses = god_objects(scaled);
      double worst = 0.0;
      for (std::size_t k = 0; k < poses.size(); ++k) {
        const double off = (poses[k].translation / scale - unit[k].translation).norm() +
                           poses[k].rotation.angularDistance(unit[k].rotation);
        worst = std::isnan(off) ? off : std::max(worst, off);
        if (std::isnan(off)) break;
      }
      result.findings.push_back(judged(bound::kScale, worst / setup.voxel,
                                       fmt::format("{}, {}, scale {} m", setup.world, setup.body, scale)));
    }
  }
  return result;
}

CaseResult long_run(std::int64_t cycles, const RowRequest& request) {
  CaseResult result;
  Setup setup{.row = "long run", .world = "plane", .body = "box", .motion = "spin", .points = 60, .depth = 0.2};
  // the whole motion repeats every second; poses one second apart are compared
  const auto rig = make_rig(setup, {});
  FaultyReports reports(request.fault.cycle);
  CycleReport report;
  double off_unit = 0.0;
  double drift = 0.0;
  Pose first;
  for (std::int64_t k = 0; k < cycles; ++k) {
    const double w = 2.0 * M_PI * kPeriod * static_cast<double>(k % 1000);
    Pose H_WD;
    H_WD.translation = setup.scale * Vector3(0.3 * std::sin(w), 0.3 * std::cos(w), 0.1 * std::sin(2.0 * w));
    H_WD.rotation = exp_rotation({0.3 * std::sin(w), 0.2 * std::cos(w), 0.0}) * exp_rotation({0.0, 0.0, w});
    if (rig->update(H_WD, {}, report) != Status::kOk) off_unit = std::nan("");
    reports.spoil(report);
    off_unit = std::max(off_unit, std::fabs(report.H_WS.rotation.norm() - 1.0));
    if (k == 2999) first = report.H_WS;
    if (k > 2999 && k % 1000 == 999) {
      drift = std::max(drift, (report.H_WS.translation - first.translation).norm() / (setup.voxel * setup.scale));
    }
  }
  result.findings.push_back(judged(bound::kOffUnit, off_unit, fmt::format("{} cycles", cycles)));
  result.findings.push_back(judged(bound::kDrift, drift * std::min(1.0, 1e7 / static_cast<double>(cycles)),
                                   fmt::format("{} cycles", cycles)));
  return result;
}

namespace {

/// The account of a closed path.
struct ClosedPath {
  double work = 0.0;  ///< on the hand [J]
  double lag = 0.0;   ///< the part of it that one motion in a cycle may add, see `most_lag` [J]
  double peak = 0.0;  ///< largest energy in the coupling [J]
  std::int64_t different = 0;
};

/// Returns the work [J] on a hand that moves by `moved` while the spring wrench changes from `before` to `after`: their
/// mean, by the trapezoidal rule. Where the force changes by more than twice the stiffness times the motion, the god
/// object jumped, round an edge for example; the rule's error would count as work there. So the smaller work counts.
double least_work(const Wrench& before, const Wrench& after, const Motion& moved, const Parameters& q) {
  const auto work = [&moved](const Wrench& F) { return F.force.dot(moved.translation) + F.torque.dot(moved.rotation); };
  const double length = moved.translation.norm() + q.mass.radius * moved.rotation.norm();
  const bool jumps = (after.force - before.force).norm() > 2.0 * q.stiffness * length;
  return jumps ? std::min(work(before), work(after)) : 0.5 * (work(before) + work(after));
}

/// Returns the most work [J] that a god object may add in a cycle in which it moves from `H0` to `H1` under the force
/// F, since it moves once. Its contact forces balance the spring by the levers at the start of the motion. A turn r
/// moves a lever P by r x P, and until the next cycle the torque F x (r x P) is not balanced; along r it does the work
/// F . (r x (r x P)), at most F R_max |r|^2. It is of second order: a path at half the speed takes half of it.
double most_lag(const Pose& H0, const Pose& H1, const Wrench& F, const Parameters& q) {
  return F.force.norm() * q.mass.radius * log_rotation(H0.rotation.conjugate() * H1.rotation).squaredNorm();
}

/// Runs the path and its replay. A planted fault is in the first run only.
ClosedPath run_closed_path(const Setup& setup, const CycleFault& fault) {
  const auto rig = make_rig(setup, {});
  const auto again = make_rig(setup, {});
  const Parameters q = rig->watched().parameters;
  FaultyReports reports(fault);
  CycleReport report;
  CycleReport repeated;
  Pose before;
  Pose H_WS_before;
  Wrench force_before;
  ClosedPath path;
  for (int k = 0; k < setup.cycles; ++k) {
    // from above down and back, slowly, twice around: 3 s each
    const double w = 2.0 * M_PI * k / 3000.0;
    Pose H_WD;
    H_WD.translation = setup.scale * Vector3(0.3 * std::sin(w), 0.2 * std::sin(2.0 * w),
                                             2.0 * std::cos(0.5 * w) * std::cos(0.5 * w) - 0.3);
    H_WD.rotation = exp_rotation({0.2 * std::sin(w), 0.1 * std::sin(2.0 * w), 0.0});
    const Status status = rig->update(H_WD, {}, report);
    reports.spoil(report);
    if (status != Status::kOk || again->update(H_WD, {}, repeated) != status) ++path.different;
    if (report.H_WS.rotation.coeffs() != repeated.H_WS.rotation.coeffs() ||
        report.H_WS.translation != repeated.H_WS.translation)
      ++path.different;
    const Wrench& force = report.force.spring_W;
    if (k > 0) {
      const Vector3 turned = H_WD.rotation._transformVector(log_rotation(before.rotation.conjugate() * H_WD.rotation));
      const Motion moved{H_WD.translation - before.translation, turned};
      path.work += least_work(force_before, force, moved, q);
      path.lag += most_lag(H_WS_before, report.H_WS, force, q);
    }
    const Motion x = get_motion(report.H_WS.inverse() * H_WD);
    const double energy =
        0.5 * q.stiffness * (x.translation.squaredNorm() + q.coupling_rotation * x.rotation.squaredNorm());
    path.peak = std::max(path.peak, energy);
    if (report.outcome == Outcome::kStartInside) {  // the way out drives: the account begins where it ends
      path.work = -energy;
      path.lag = 0.0;
    }
    before = H_WD;
    H_WS_before = report.H_WS;
    force_before = force;
  }
  return path;
}

}  // namespace

CaseResult closed_path(const RowRequest& request) {
  CaseResult result;
  std::mt19937 random(12 + request.seed);
  for (const char* world : {"plane", "groove", "heap"}) {
    for (int i = 0; i < (request.quick ? 2 : 10); ++i) {
      Setup setup = setup_of(kRows[0], random);
      setup.world = world;
      setup.body = i % 2 == 0 ? "box" : "ball";
      setup.friction = false;
      setup.damping = 0.0;
      setup.scale = 0.02;
      setup.far = 0.0;
      setup.cycles = 6000;
      const ClosedPath path = run_closed_path(setup, request.fault.cycle);
      const std::string where = fmt::format("{}, {}, {}", world, setup.body, i);
      const double work = std::max(0.0, path.work - path.lag);
      result.findings.push_back(judged(bound::kNetWork, path.peak > 0.0 ? work / path.peak : 0.0, where));
      result.findings.push_back(judged(bound::kReplay, static_cast<double>(path.different), where));
    }
  }
  return result;
}

}  // namespace godobject::report
