#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <span>
#include <vector>

#include "toolchain/report/assembly/bounds.h"
#include "toolchain/report/assembly/carried_part.h"
#include "toolchain/report/assembly/cases.h"
#include "toolchain/report/assembly/jamming.h"
#include "toolchain/report/assembly/peg_fit.h"
#include "toolchain/report/assembly/tally.h"

namespace godobject::report {
namespace {

constexpr double kPush = 0.04;  ///< along the axis [N]; results do not depend on its size

/// A load on a peg that leans in its hole.
struct JammingLoad {
  double depth_ratio = 0.0;   ///< depth of the tip's edge below the rim, over the diameter
  double force_ratio = 0.0;   ///< force towards the wall that the tip touches, over the push along the axis
  double moment_ratio = 0.0;  ///< moment about the middle of the tip's edge, over radius times push
  bool pulls = false;         ///< out of the hole
};

/// A peg that touches its hole at two places.
struct Leaning {
  Pose H_WM;
  /// Tip and rim; and the rim again with the wall's normal: points of the peg's side within the margin below the rim
  /// touch the wall.
  std::array<PlaneContact, 3> contacts;
  Vector3 tip_W;       ///< middle of the tip's edge
  double depth = 0.0;  ///< between the two places, along z [m]
};

Vector2 plane(const Vector3& v) { return {v.x(), v.z()}; }

/// Lets the peg lean towards x until the hole holds it at two places, without friction.
Leaning lean(const Pair& pair, const PegFit& fit, double depth, const AssemblyFault& fault, Tally& tally) {
  constexpr double kTurn = 0.15;  // far beyond the play [rad]
  constexpr int kRamp = 100;
  constexpr int kRest = 60;
  constexpr int kOverlapEvery = 40;
  CarriedPart part(pair, 0.0, {.outcome = fault.outcome});
  part.watch_overlap(kOverlapEvery);
  Pose upright;
  upright.translation.z() = fit.rim_z - fit.edge_z - depth;
  part.start(upright);
  const Vector3 pivot(0.0, 0.0, fit.rim_z - 0.5 * depth);
  for (int i = 1; i <= kRamp + kRest; ++i) {
    Pose device;
    device.rotation = exp_rotation({0.0, kTurn * std::min(1.0, static_cast<double>(i) / kRamp), 0.0});
    device.translation = pivot + device.rotation._transformVector(upright.translation - pivot);
    part.follow(device);
  }
  tally.add(part.carried());
  Leaning leaning{.H_WM = part.pose(), .contacts = {}, .tip_W = part.pose() * Vector3(0.0, 0.0, fit.edge_z)};
  const Vector3 edge = leaning.H_WM * Vector3(-fit.peg_radius, 0.0, fit.edge_z);
  leaning.contacts[0] = {plane(edge), Vector2::UnitX()};
  leaning.contacts[1] = {{fit.hole_radius, fit.rim_z},
                         plane(leaning.H_WM.rotation._transformVector(-Vector3::UnitX()))};
  leaning.contacts[2] = {leaning.contacts[1].point, -Vector2::UnitX()};
  leaning.depth = fit.rim_z - edge.z();
  return leaning;
}

Vector3 force_of(const JammingLoad& load) { return {-load.force_ratio * kPush, 0.0, load.pulls ? kPush : -kPush}; }

/// The coefficients between which the peg may be held or move, by the rim's normal.
struct Theory {
  double held = 0.0;   ///< below it nothing holds the load
  double moves = 0.0;  ///< the largest coefficient at which one normal alone lets it move
};

Theory theory(const Leaning& leaning, const PegFit& fit, const JammingLoad& load) {
  const Vector3 force = force_of(load);
  const PlaneLoad all{plane(force), load.moment_ratio * fit.peg_radius * kPush + leaning.tip_W.cross(force).y()};
  const std::array<PlaneContact, 2> wall{leaning.contacts[0], leaning.contacts[2]};
  return {holding_friction(leaning.contacts, all),
          std::max(holding_friction(std::span(leaning.contacts).first(2), all), holding_friction(wall, all))};
}

/// Returns how far the load moves the peg along the axis in a cycle [m].
double motion(const Pair& pair, const PegFit& fit, const Leaning& leaning, const JammingLoad& load, double friction,
              const AssemblyFault& fault, Tally& tally) {
  constexpr int kSettling = 25;  // until the guide has drawn the peg into the plane
  constexpr int kWatched = 3;
  CarriedPart part(pair, friction, fault);
  part.watch_overlap(kSettling + kWatched);
  part.start(leaning.H_WM);
  const Vector3 force = force_of(load);
  const auto step = [&] {
    const Vector3 tip_W = part.pose() * Vector3(0.0, 0.0, fit.edge_z);
    const Vector3 torque =
        Vector3(0.0, load.moment_ratio * fit.peg_radius * kPush, 0.0) + (tip_W - part.center_W()).cross(force);
    part.load({force, torque});
  };
  for (int i = 0; i < kSettling; ++i) step();
  const double before = part.pose().translation.z();
  for (int i = 0; i < kWatched; ++i) step();
  tally.add(part.carried());
  return (part.pose().translation.z() - before) / kWatched * (load.pulls ? 1.0 : -1.0);
}

/// A load on a leaning peg, and its motion at a coefficient well below the theory's.
class LoadedPeg {
 public:
  LoadedPeg(const Pair& pair, const PegFit& fit, const JammingLoad& load, const AssemblyFault& fault, Tally& tally)
      : pair_(pair),
        fit_(fit),
        load_(load),
        fault_(fault),
        tally_(tally),
        leaning_(lean(pair, fit, load.depth_ratio * 2.0 * fit.peg_radius, fault, tally)),
        theory_(report::theory(leaning_, fit, load)) {
    constexpr double kSlippery = 0.2;
    constexpr double kStill = 1e-2;
    still_ = kStill * motion(pair, fit, leaning_, load, kSlippery * theory_.held, {}, tally);
  }

  const Leaning& leaning() const { return leaning_; }
  const Theory& theory() const { return theory_; }

  /// Tells if the theory has one answer: below wedging, at coefficients that occur.
  bool is_judged() const {
    constexpr double kLeast = 0.03;
    constexpr double kMost = 1.0;
    const double wedging = wedging_friction({leaning_.contacts[0], leaning_.contacts[2]});
    return theory_.held > kLeast && theory_.moves < std::min(kMost, 1.01 * wedging);
  }

  bool moves(double friction) const { return motion(pair_, fit_, leaning_, load_, friction, fault_, tally_) > still_; }

  /// Returns the coefficient of friction from which on the peg is held.
  double measured() const {
    constexpr double kFinest = 1e-3;
    double moving = 0.5 * theory_.held;
    double held = 1.5 * theory_.moves;
    while (held - moving > kFinest * held) {
      const double middle = 0.5 * (moving + held);
      (moves(middle) ? moving : held) = middle;
    }
    return 0.5 * (moving + held);
  }

 private:
  const Pair& pair_;
  const PegFit& fit_;
  JammingLoad load_;
  AssemblyFault fault_;
  Tally& tally_;
  Leaning leaning_;
  Theory theory_;
  double still_ = 0.0;
};

/// `only_wedging`: only a push and a pull along the side.
std::vector<JammingLoad> loads(bool quick, bool only_wedging) {
  if (only_wedging) return {{0.7, 0.0, 1.0, false}, {0.7, 0.0, 1.0, true}};
  std::vector<JammingLoad> all;
  for (const double depth : {0.7, 0.9}) {
    for (const double moment : {1.0, 1.5, 2.0}) {
      all.push_back({depth, 0.0, moment, false});
      all.push_back({depth, 0.0, moment, true});
    }
    all.push_back({depth, 0.3, 1.5, false});
    if (quick) break;
  }
  return all;
}

/// Returns the number of random loads that move at 1.1 times the theory's coefficient, or are held at 0.9 times; NaN if
/// the theory has one answer for none of them.
double wrong_sides(const Pair& pair, const PegFit& fit, const AssemblyEffort& effort, Tally& tally) {
  std::mt19937 random(7 + effort.seed);
  const auto draw = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  double wrong = std::nan("");
  const int draws = effort.quick ? 4 : 20;
  for (int i = 0; i < draws; ++i) {
    const JammingLoad load{draw(0.6, 0.9), draw(0.0, 0.5), draw(1.0, 3.0), i % 2 == 1};
    const LoadedPeg peg(pair, fit, load, effort.fault, tally);
    if (!peg.is_judged()) continue;
    if (std::isnan(wrong)) wrong = 0.0;
    wrong += peg.moves(0.9 * peg.theory().held) ? 0.0 : 1.0;
    wrong += peg.moves(1.1 * peg.theory().moves) ? 1.0 : 0.0;
  }
  return wrong;
}

}  // namespace

CaseResult jamming_case(const std::string& name, const Pair& pair, OtherLoads others, const AssemblyEffort& effort) {
  const PegFit fit = measure_peg_fit(pair);
  Tally tally(name, pair);
  Sheet sheet{.name = "assembly_jamming",
              .columns = {"pair", "depth_m", "force_ratio", "moment_ratio", "pulls", "whitney", "held_above",
                          "moves_below", "measured"},
              .rows = {}};
  double wedging = std::nan("");  // until a load is judged
  double jamming = std::nan("");
  const bool only_wedging = effort.quick && others == OtherLoads::kShown;
  for (const JammingLoad& load : loads(effort.quick, only_wedging)) {
    const LoadedPeg peg(pair, fit, load, effort.fault, tally);
    if (!peg.is_judged()) continue;
    const double found = peg.measured();
    const Theory& expected = peg.theory();
    const double off = 100.0 * std::max({0.0, 1.0 - found / expected.held, found / expected.moves - 1.0});
    double& worst = load.force_ratio == 0.0 && load.moment_ratio == 1.0 ? wedging : jamming;
    worst = std::fmax(worst, off);
    const double depth = peg.leaning().depth;
    sheet.rows.push_back({name, cell(depth), cell(load.force_ratio), cell(load.moment_ratio), load.pulls ? "1" : "0",
                          cell(whitney_friction(depth, 2.0 * fit.peg_radius, load.force_ratio, load.moment_ratio)),
                          cell(expected.held), cell(expected.moves), cell(found)});
  }
  const auto of_others = [&](const Bound& bound, double value) {
    Finding finding = judged(bound, value);
    if (others == OtherLoads::kShown) finding.most.reset();
    return finding;
  };
  CaseResult result;
  result.findings = {judged(assembly_bound::wedging(name), wedging)};
  if (!only_wedging) {
    result.findings.push_back(of_others(assembly_bound::jamming(name), jamming));
    result.findings.push_back(of_others(assembly_bound::wrong_side(name), wrong_sides(pair, fit, effort, tally)));
  }
  result.sheets = {sheet};
  tally.conclude(result);
  return result;
}

}  // namespace godobject::report
