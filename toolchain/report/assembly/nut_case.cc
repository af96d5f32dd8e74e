#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "toolchain/report/assembly/bounds.h"
#include "toolchain/report/assembly/carried_part.h"
#include "toolchain/report/assembly/cases.h"
#include "toolchain/report/assembly/screw.h"
#include "toolchain/report/assembly/tally.h"

namespace godobject::report {
namespace {

constexpr double kWholeTurn = 2.0 * std::numbers::pi;

/// The nut after a cycle of the turn.
struct Turned {
  double angle = 0.0;   ///< of the nut about z, continuous [rad]
  double climb = 0.0;   ///< [m]
  double force = 0.0;   ///< of the spring along z [N]
  double torque = 0.0;  ///< of the spring about z [Nm]
};

/// A turn of the nut by a quarter, in which its play is used up, and then up and down again.
struct Path {
  std::vector<Turned> up;
  std::vector<Turned> down;
};

double angle_about_z(const Pose& pose) { return 2.0 * std::atan2(pose.rotation.z(), pose.rotation.w()); }

/// Turns the device at a constant height, and rests at the top. The nut climbs, and the spring presses it down on the
/// flanks. The play must be less than a quarter of a turn, which is turned at four times the speed.
Path turn(CarriedPart& part, const NutPlace& place) {
  constexpr int kRest = 20;
  constexpr double kFirst = 0.25 * kWholeTurn;
  const double step = kWholeTurn / place.cycles_of_turn;
  Pose device;
  device.translation.z() = place.start_z;
  part.start(device);
  const auto turn_to = [&](double angle) -> Turned {
    device.rotation = exp_rotation({0.0, 0.0, angle});
    const Wrench spring = part.follow(device).force.spring_W;
    const double found = angle_about_z(part.pose());
    return {found + kWholeTurn * std::round((angle - found) / kWholeTurn), part.pose().translation.z() - place.start_z,
            spring.force.z(), spring.torque.z()};
  };
  for (double angle = 0.0; angle < kFirst; angle += 4.0 * step) turn_to(angle);
  Path path;
  const auto cycles = static_cast<int>(place.turns * place.cycles_of_turn);
  for (int i = 1; i <= cycles; ++i) path.up.push_back(turn_to(kFirst + step * i));
  for (int i = 0; i < kRest; ++i) turn_to(kFirst + step * cycles);
  for (int i = cycles - 1; i >= 0; --i) path.down.push_back(turn_to(kFirst + step * i));
  return path;
}

/// Deviations of a turn from the theory.
struct TurnErrors {
  double slack = 0.0;     ///< turn until the nut climbs [rad]
  double climb = 0.0;     ///< from pitch x turn, of the climb [%]
  double torque = 0.0;    ///< from the power screw, while the nut climbs [%]
  double lowering = 0.0;  ///< mean torque on the way down over the force [m]
};

TurnErrors compare(const Path& path, const Screw& screw, double friction) {
  TurnErrors errors;
  // the angle at which the climb begins: the mean over both ways, which removes ripples of the facets
  for (const std::vector<Turned>& way : {path.up, path.down}) {
    for (const Turned& at : way) errors.slack += at.angle - kWholeTurn * at.climb / screw.pitch;
  }
  errors.slack /= static_cast<double>(path.up.size() + path.down.size());
  for (const std::vector<Turned>& way : {path.up, path.down}) {
    for (const Turned& at : way) {
      const double expected = screw.pitch * (at.angle - errors.slack) / kWholeTurn;
      errors.climb = std::max(errors.climb, 100.0 * std::abs(at.climb - expected) / expected);
    }
  }
  double torque = 0.0;
  double expected_torque = 0.0;
  for (const Turned& at : path.up) {
    torque -= at.torque;  // the spring turns the device back
    expected_torque += raising_torque(screw, screw.mean_radius(), friction) * at.force;
  }
  errors.torque = 100.0 * std::abs(torque / expected_torque - 1.0);
  double lowering = 0.0;
  double force = 0.0;
  for (const Turned& at : path.down) {
    lowering -= at.torque;
    force += at.force;
  }
  errors.lowering = lowering / force;
  return errors;
}

/// Returns the number of cycles until a nut that begins inside the bolt's flanks is free.
int cycles_until_free(const Pair& pair, double z, const AssemblyFault& fault) {
  constexpr int kMost = 1000;
  CarriedPart part(pair, 0.0, fault);
  Pose device;
  device.translation.z() = z;
  int cycles = 0;
  const CycleReport* report = &part.start(device);
  while (report->outcome == Outcome::kStartInside && cycles < kMost) {
    report = &part.follow(device);
    ++cycles;
  }
  return cycles;
}

}  // namespace

CaseResult nut_case(const std::string& name, const Pair& pair, const NutPlace& place, const AssemblyEffort& effort) {
  const Screw screw = measure_screw(pair.still, pair.moving, place.low, place.high);
  const double locking = self_locking_friction(screw, screw.mean_radius());
  Tally tally(name, pair);
  CaseResult result;
  Sheet sheet{.name = "assembly_nut",
              .columns = {"pair", "friction", "turn_rad", "climb_m", "force_n", "torque_nm"},
              .rows = {}};
  double play = 0.0;
  std::vector<std::pair<double, double>> lowering;  // friction, torque over force
  for (const double share : {0.0, 0.8}) {
    const double friction = share * locking;
    CarriedPart part(pair, friction, effort.fault);
    part.watch_overlap(place.overlap_every);
    const Path path = turn(part, place);
    const TurnErrors errors = compare(path, screw, friction);
    play = errors.slack / kWholeTurn * screw.pitch;
    lowering.emplace_back(friction, errors.lowering);
    const std::string where = fmt::format("friction {:.4f}", friction);
    result.findings.push_back(judged(assembly_bound::climb(name), errors.climb, where));
    result.findings.push_back(judged(assembly_bound::torque(name), errors.torque, where));
    for (const std::vector<Turned>& way : {path.up, path.down}) {
      for (std::size_t i = 0; i < way.size(); i += 13) {  // at all phases of the facets
        const Turned& at = way[i];
        sheet.rows.push_back({name, cell(friction), cell(at.angle), cell(at.climb), cell(at.force), cell(at.torque)});
      }
    }
    tally.add(part.carried());
  }
  // the coefficient at which the mean torque on the way down vanishes: from there on the nut locks itself. The theory's
  // torque is linear in the coefficient but for 0.2 % (a lead of 5 degrees)
  const auto [from, torque_from] = lowering[0];
  const auto [to, torque_to] = lowering[1];
  const double found = to + torque_to * (to - from) / (torque_from - torque_to);
  constexpr double kInside = 3e-5;  // [m]
  result.findings.push_back(judged(assembly_bound::self_locking(name), 100.0 * std::abs(found / locking - 1.0)));
  result.findings.push_back(
      judged(assembly_bound::comes_free(name), cycles_until_free(pair, place.start_z - play - kInside, effort.fault)));
  result.sheets = {sheet,
                   {.name = "assembly_screw",
                    .columns = {"pair", "pitch_m", "flank_angle_rad", "inner_radius_m", "outer_radius_m",
                                "locking_theory", "locking_measured"},
                    .rows = {{name, cell(screw.pitch), cell(screw.flank_angle), cell(screw.inner_radius),
                              cell(screw.outer_radius), cell(locking), cell(found)}}}};
  tally.conclude(result);
  return result;
}

}  // namespace godobject::report
