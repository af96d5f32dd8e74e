#include "toolchain/report/extremes/bad_input.h"

#include <cmath>
#include <iterator>
#include <limits>

#include <fmt/format.h>

#include "toolchain/report/contact_quality/compiled_scene.h"
#include "toolchain/report/contact_quality/meshes.h"
#include "toolchain/report/extremes/bounds.h"
#include "toolchain/session/owned_god_object.h"

namespace godobject::report {
namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Returns an input that is pressed into the block, and slides and turns on it.
GodObject::Input valid_input(std::int64_t k) {
  const double t = 1e-3 * static_cast<double>(k);
  GodObject::Input input;
  input.H_WM.translation = {0.01 * std::sin(7.0 * t), 0.008 * std::sin(5.0 * t), 0.009 + 0.006 * std::cos(20.0 * t)};
  input.H_WM.rotation = exp_rotation({0.1 * std::sin(4.0 * t), 0.1 * std::sin(6.0 * t), 0.2 * std::sin(2.0 * t)});
  input.velocity_W.translation = {0.07 * std::cos(7.0 * t), 0.04 * std::cos(5.0 * t), -0.12 * std::sin(20.0 * t)};
  return input;
}

using Spoil = void (*)(GodObject::Input& input, Eigen::Index axis);

/// All kinds of invalid inputs; `axis` is 0, 1 or 2.
constexpr Spoil kKinds[] = {
    [](GodObject::Input& input, Eigen::Index axis) { input.H_WM.translation[axis] = kNoNumber; },
    [](GodObject::Input& input, Eigen::Index axis) { input.H_WM.translation[axis] = kInfinite; },
    [](GodObject::Input& input, Eigen::Index axis) { input.H_WM.translation[axis] = -kInfinite; },
    [](GodObject::Input& input, Eigen::Index axis) { input.H_WM.translation[axis] = 1.1e7; },
    [](GodObject::Input& input, Eigen::Index axis) { input.H_WM.translation[axis] = -1e300; },
    [](GodObject::Input& input, Eigen::Index axis) { input.H_WM.rotation.coeffs()[axis] = kNoNumber; },
    [](GodObject::Input& input, Eigen::Index axis) { input.H_WM.rotation.coeffs()[axis] = kInfinite; },
    [](GodObject::Input& input, Eigen::Index axis) { input.H_WM.rotation.coeffs()[axis] = 1e200; },
    [](GodObject::Input& input, Eigen::Index) { input.H_WM.rotation.coeffs() *= 1.01; },
    [](GodObject::Input& input, Eigen::Index) { input.H_WM.rotation.coeffs() *= 0.99; },
    [](GodObject::Input& input, Eigen::Index) { input.H_WM.rotation.coeffs().setZero(); },
    [](GodObject::Input& input, Eigen::Index axis) { input.velocity_W.translation[axis] = kNoNumber; },
    [](GodObject::Input& input, Eigen::Index axis) { input.velocity_W.translation[axis] = kInfinite; },
    [](GodObject::Input& input, Eigen::Index axis) { input.velocity_W.rotation[axis] = kNoNumber; },
    [](GodObject::Input& input, Eigen::Index axis) { input.velocity_W.rotation[axis] = -kInfinite; }};

struct Flaws {
  double accepted = 0.0;
  double with_force = 0.0;
  double changed = 0.0;
  double contacts = 0.0;  ///< cycles in contact
};

bool equal(const CycleReport& a, const CycleReport& b) {
  return a.H_WS.translation == b.H_WS.translation && a.H_WS.rotation.coeffs() == b.H_WS.rotation.coeffs() &&
         a.force.total_W.force == b.force.total_W.force && a.force.total_W.torque == b.force.total_W.torque;
}

/// Runs a solver with the invalid inputs, and beside it the same solver without them.
Flaws run(const SceneView& scene, Solver solver, bool friction, std::int64_t cycles, const ExtremesFault& fault) {
  Flaws flaws;
  OwnedGodObject disturbed;
  OwnedGodObject sound;
  if (disturbed.start(scene, solver, friction) != Status::kOk || sound.start(scene, solver, friction) != Status::kOk) {
    return {.accepted = kNoNumber};
  }
  CycleReport report;
  CycleReport expected;
  for (std::int64_t k = 0; k < cycles; ++k) {
    const GodObject::Input valid = valid_input(k);
    const Status status = disturbed->update(valid, report);
    if (status != Status::kOk || sound->update(valid, expected) != Status::kOk) flaws.accepted += 1.0;
    if (!equal(report, expected)) flaws.changed += 1.0;
    if (expected.contacts > 0) flaws.contacts += 1.0;
    GodObject::Input invalid = valid;
    const auto count = static_cast<std::int64_t>(std::size(kKinds));
    kKinds[k % count](invalid, k / count % 3);
    if (fault.accepts_poses) {
      invalid = valid;
      invalid.H_WM.translation.x() += 1e-3;
    }
    if (disturbed->update(invalid, report) == Status::kOk) flaws.accepted += 1.0;
    const Wrench& force = report.force.total_W;
    if (!force.force.isZero(0.0) || !force.torque.isZero(0.0)) flaws.with_force += 1.0;
  }
  return flaws;
}

}  // namespace

CaseResult bad_input(std::int64_t cycles, const ExtremesFault& fault, const std::filesystem::path& work) {
  const std::filesystem::path body = work / "body.ply";
  write_ply(box_mesh({-0.01, -0.008, -0.006}, {0.01, 0.008, 0.006}), body);
  const files::SceneImage image = compile(
      "bad-input", {.still = {.mesh = box_mesh({-0.03, -0.03, -0.03}, {0.03, 0.03, 0.0})}, .body = body, .points = 60},
      work);
  CaseResult result;
  constexpr std::int64_t kVariants = 2 * format::kSolverCount;
  for (std::int64_t variant = 0; variant < kVariants; ++variant) {
    const auto solver = static_cast<Solver>(variant / 2);
    const bool friction = variant % 2 == 1;
    const std::int64_t each = (cycles + kVariants - 1) / kVariants;
    const Flaws flaws = run(image.scene, solver, friction, each, fault);
    const std::string where = fmt::format("{}, friction {}, {} invalid inputs, {:.0f} valid ones in contact",
                                          format::kSolverNames[static_cast<std::size_t>(solver)],
                                          friction ? "on" : "off", each, flaws.contacts);
    result.findings.push_back(
        judged(extremes_bound::kAccepted, flaws.contacts > 0.0 ? flaws.accepted : kNoNumber, where));
    result.findings.push_back(judged(extremes_bound::kForce, flaws.with_force, where));
    result.findings.push_back(judged(extremes_bound::kChanged, flaws.changed, where));
  }
  return result;
}

}  // namespace godobject::report
