#include "toolchain/report/contact_quality/cycle_fault.h"

#include <Eigen/Geometry>

namespace godobject::report {

void FaultyReports::spoil(CycleReport& report) {
  if (fault_.late > 0) {
    waiting_.push_back(report);
    report = waiting_.front();
    if (waiting_.size() > static_cast<std::size_t>(fault_.late)) waiting_.pop_front();
  }
  const Quaternion turned(Eigen::AngleAxisd(fault_.turn, Vector3::UnitZ()));
  const bool hit = ++cycle_ % fault_.every == 0;
  for (Wrench* wrench : {&report.force.spring_W, &report.force.total_W}) {
    wrench->force = fault_.gain * turned._transformVector(wrench->force);
    wrench->torque *= fault_.gain;
    if (hit) wrench->force += fault_.push_W;
  }
  if (hit) report.H_WS.translation += fault_.shift_W;
  report.H_WS.translation += cycle_ * fault_.drift_W;
  report.H_WS.rotation.coeffs() *= fault_.rotation_length;
}

}  // namespace godobject::report
