#pragma once

#include <cstdint>
#include <deque>

#include "godobject/report.h"

namespace godobject::report {

/// A fault that a test plants in the results of a solver's cycles. The default changes nothing.
struct CycleFault {
  double gain = 1.0;                  ///< of force and torque
  double turn = 0.0;                  ///< angle by which the force is turned about z [rad]
  Vector3 push_W = Vector3::Zero();   ///< additional force [N]
  Vector3 shift_W = Vector3::Zero();  ///< of the god object [m]
  Vector3 drift_W = Vector3::Zero();  ///< additional shift of the god object for each cycle [m]
  double rotation_length = 1.0;       ///< of the god object's quaternion
  int late = 0;                       ///< cycles by which the whole report is late
  int every = 1;                      ///< only every n-th cycle has push and shift
  std::int64_t slower_ns = 0;         ///< additional time of a cycle
};

/// Applies a fault to the reports of one run, in their order.
class FaultyReports {
 public:
  explicit FaultyReports(const CycleFault& fault) : fault_(fault) {}

  void spoil(CycleReport& report);

 private:
  CycleFault fault_;
  int cycle_ = 0;
  std::deque<CycleReport> waiting_;
};

}  // namespace godobject::report
