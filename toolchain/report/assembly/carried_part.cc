#include "toolchain/report/assembly/carried_part.h"

#include <algorithm>
#include <cmath>

#include "toolchain/command_line/failure.h"

namespace godobject::report {
namespace {

/// Returns an upper bound of the displacement of any point of the body between two poses of its mesh [m].
double displacement(const Vector3& center_M, double radius, const Pose& one, const Pose& other) {
  const double angle = log_rotation(one.rotation.conjugate() * other.rotation).norm();
  return (one * center_M - other * center_M).norm() + radius * angle;
}

}  // namespace

CarriedPart::CarriedPart(const Pair& pair, double friction, const AssemblyFault& fault)
    : pair_(pair), fault_(fault), faulty_(fault.cycle) {
  SceneView scene = pair.image.scene;
  scene.settings.friction_static = scene.settings.friction_kinetic = fault.friction_gain * friction;
  if (god_object_.start(scene, Solver::kContact, friction > 0.0) != Status::kOk) {
    throw command::Failure(command::ExitCode::kBadConfig,
                           "the scene file of an assembly lacks its [friction] table; add one");
  }
  const Parameters& parameters = god_object_.parameters();
  stiffness_ = parameters.stiffness * parameters.coupling_translation;
  turning_ = parameters.stiffness * parameters.coupling_rotation;
}

const CycleReport& CarriedPart::start(const Pose& H_WM) {
  god_object_->reset();
  return run(H_WM);
}

const CycleReport& CarriedPart::follow(const Pose& H_WM) { return run(H_WM); }

const CycleReport& CarriedPart::load(const Wrench& load_W) {
  const Vector3& center_M = pair_.image.scene.H_MB.translation;
  const double pitch = 2.0 * std::atan2(H_WM_.rotation.y(), H_WM_.rotation.w());
  Pose device;
  device.rotation = exp_rotation({0.0, pitch + load_W.torque.y() / turning_, 0.0});
  Vector3 moved_center = center_W() + load_W.force / stiffness_;
  moved_center.y() = center_M.y();
  device.translation = moved_center - device.rotation._transformVector(center_M);
  return run(device);
}

const CycleReport& CarriedPart::run(const Pose& H_WM) {
  if (god_object_->update({H_WM, Motion{}}, report_) != Status::kOk) {
    throw command::Failure(command::ExitCode::kInternal, "a cycle of an assembly failed");
  }
  faulty_.spoil(report_);
  if (fault_.outcome) report_.outcome = *fault_.outcome;
  H_WM_ = report_.H_WS * pair_.image.scene.H_MB.inverse();
  if (fault_.turn_gain != 1.0) H_WM_.rotation = exp_rotation(fault_.turn_gain * log_rotation(H_WM_.rotation));
  count();
  if (watch_every_ > 0) watch();
  return report_;
}

void CarriedPart::count() {
  ++carried_.cycles;
  carried_.touching += report_.outcome != Outcome::kFree ? 1 : 0;
  carried_.overflow += report_.outcome == Outcome::kOverflow ? 1 : 0;
  carried_.started_inside += report_.outcome == Outcome::kStartInside ? 1 : 0;
  carried_.cut += report_.outcome == Outcome::kCut ? 1 : 0;
  carried_.infeasible += report_.outcome == Outcome::kInfeasible ? 1 : 0;
  carried_.friction_not_found += report_.unconverged ? 1 : 0;
}

void CarriedPart::watch() {
  if (measured_) {
    const double moved =
        displacement(pair_.image.scene.H_MB.translation, god_object_.parameters().mass.radius, measured_at_, H_WM_);
    if (measured_depth_ + moved <= pair_.accuracy) return;
  }
  if (measured_ && ++waited_ < watch_every_) return;
  waited_ = 0;
  measured_ = true;
  measured_at_ = H_WM_;
  measured_depth_ = pair_.overlap.depth(H_WM_);
  carried_.overlap = std::max(carried_.overlap, measured_depth_);
  ++carried_.overlaps;
}

}  // namespace godobject::report
