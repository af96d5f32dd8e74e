#include "toolchain/report/extremes/run.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "toolchain/report/extremes/draw.h"
#include "toolchain/report/extremes/seeker.h"
#include "toolchain/watch/watch.h"

namespace godobject::report {
namespace {

constexpr int kKindsOfBadInput = 6;

/// Makes a pose or a velocity invalid; `which` selects the kind in turn.
void make_bad(Pose& H_WD, Motion& velocity_W, int which) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  switch (which % kKindsOfBadInput) {
    case 0: H_WD.translation.x() = kNan; break;
    case 1: H_WD.translation.z() = kInfinity; break;
    case 2: H_WD.rotation.coeffs() *= 1.01; break;
    case 3: H_WD.rotation.coeffs().setConstant(kNan); break;
    case 4: velocity_W.translation.y() = kNan; break;
    default: velocity_W.rotation.z() = -kInfinity; break;
  }
}

}  // namespace

Motion velocity_between(const Pose& before, const Pose& now, double period) {
  return {(now.translation - before.translation) / period,
          now.rotation._transformVector(log_rotation(before.rotation.conjugate() * now.rotation)) / period};
}

std::vector<Pose> device_path(const Setup& setup) {
  Draw draw(setup.seed + setup.session);
  const double s = setup.scale;
  const Vector3 axis = draw.direction();
  const Vector3 way = draw.direction();
  const Vector3 rates(draw.between(0.3, 1.0), draw.between(0.3, 1.0), draw.between(0.3, 1.0));
  const Vector3 phases = draw.in_cube(3.0);
  const Pose H_WO = placement(setup);
  std::vector<Pose> path;
  Pose jumped;
  for (int k = 0; k < setup.cycles; ++k) {
    const double t = setup.period * k;
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

watch::Findings run_setup(const Setup& setup, Rig& rig) {
  watch::Watch watch(rig.watched());
  std::optional<Seeker> seeker;
  std::vector<Pose> path;
  if (setup.motion == "seek") {
    seeker.emplace(setup);
  } else {
    path = device_path(setup);
  }
  Pose before;
  Pose H_WS;
  bool has_started = false;
  for (int k = 0; k < setup.cycles; ++k) {
    watch::WatchedCycle cycle;
    cycle.H_WD =
        seeker ? seeker->next(has_started ? H_WS : before, watch.nearest()) : path[static_cast<std::size_t>(k)];
    if (k > 0) cycle.velocity_W = velocity_between(before, cycle.H_WD, setup.period);
    before = cycle.H_WD;
    cycle.is_valid = !is_compiled(setup) || setup.bad_every == 0 || k % setup.bad_every != setup.bad_every - 1;
    if (!cycle.is_valid) make_bad(cycle.H_WD, cycle.velocity_W, k / setup.bad_every);
    cycle.status = rig.update(cycle.H_WD, cycle.velocity_W, cycle.report);
    cycle.path = rig.path();
    watch.cycle(cycle);
    if (cycle.status == Status::kOk) {
      H_WS = cycle.report.H_WS;
      has_started = true;
    }
  }
  return watch.findings();
}

}  // namespace godobject::report
