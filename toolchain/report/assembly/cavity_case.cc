#include <algorithm>
#include <cmath>
#include <numbers>

#include "toolchain/report/assembly/bounds.h"
#include "toolchain/report/assembly/carried_part.h"
#include "toolchain/report/assembly/cases.h"
#include "toolchain/report/assembly/tally.h"

namespace godobject::report {
namespace {

constexpr double kPress = 6e-3;     ///< of the device beyond the cube's place [m]
constexpr double kPressTurn = 0.5;  ///< [rad]
constexpr double kFriction = 0.2;
constexpr int kPressRamp = 60;
constexpr int kPressRest = 5;

/// Moves the device from the cube's place in the middle to a translation and a turn, and rests there.
const CycleReport& press(CarriedPart& part, const Vector3& translation, const Vector3& turn) {
  part.watch_overlap(4);
  const CycleReport* report = &part.start(Pose{});
  for (int i = 1; i <= kPressRamp + kPressRest; ++i) {
    const double share = std::min(1.0, static_cast<double>(i) / kPressRamp);
    Pose device;
    device.rotation = exp_rotation(share * turn);
    device.translation = share * translation;
    report = &part.follow(device);
  }
  return *report;
}

}  // namespace

CaseResult cavity_case(const std::string& name, const Pair& pair, const CubeInCavity& cube,
                       const AssemblyEffort& effort) {
  Tally tally(name, pair);
  Sheet sheet{.name = "assembly_cavity", .columns = {"pair", "x", "y", "z", "expected_n", "off_n"}, .rows = {}};
  double off = 0.0;
  for (int i = 1; i < 27; ++i) {
    const Vector3 side(i % 3 - (i % 3 == 2 ? 3 : 0), i / 3 % 3 - (i / 3 % 3 == 2 ? 3 : 0),
                       i / 9 % 3 - (i / 9 % 3 == 2 ? 3 : 0));
    CarriedPart part(pair, kFriction, effort.fault);
    const CycleReport& report = press(part, kPress * side, Vector3::Zero());
    const Vector3 expected = -part.stiffness() * (kPress - cube.clearance) * side;
    const double wrong = (report.force.spring_W.force - expected).norm();
    off = std::max(off, 100.0 * wrong / expected.norm());
    sheet.rows.push_back({name, cell(side.x()), cell(side.y()), cell(side.z()), cell(expected.norm()), cell(wrong)});
    tally.add(part.carried());
  }
  double twist = 0.0;
  for (int i = 0; i < 6; ++i) {
    const Vector3 axis = (i < 3 ? 1.0 : -1.0) * Vector3::Unit(i % 3);
    CarriedPart part(pair, kFriction, effort.fault);
    const CycleReport& report = press(part, Vector3::Zero(), kPressTurn * axis);
    // four edges of the cube touch the walls: a (cos w + sin w) = a + c
    const double ratio = 1.0 + cube.clearance / cube.half_edge;
    const double play = std::asin(ratio / std::sqrt(2.0)) - 0.25 * std::numbers::pi;
    const Vector3 expected = -part.turning_stiffness() * (kPressTurn - play) * axis;
    twist = std::max(twist, 100.0 * (report.force.spring_W.torque - expected).norm() / expected.norm());
    tally.add(part.carried());
  }
  CaseResult result;
  result.findings = {judged(assembly_bound::kPress, off), judged(assembly_bound::kTwist, twist)};
  result.sheets = {sheet};
  tally.conclude(result);
  return result;
}

}  // namespace godobject::report
