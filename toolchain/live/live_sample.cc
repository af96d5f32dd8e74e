#include "toolchain/live/live_sample.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "firmware/cycle/fault.h"

namespace godobject::live {
namespace {

std::string fault_text(int fault) {
  const bool known = fault > 0 && fault <= static_cast<int>(firmware::kLastFault);
  return known ? describe(static_cast<firmware::Fault>(fault)) : "";
}

JointVector joint_vector(const std::vector<double>& values) {
  JointVector joints = JointVector::Zero();
  const auto count = std::min<std::size_t>(values.size(), kMaxJoints);
  for (std::size_t i = 0; i < count; ++i) joints[static_cast<Eigen::Index>(i)] = values[i];
  return joints;
}

}  // namespace

LiveSample sample_of(const figures::TelemetryRow& row) {
  LiveSample sample;
  sample.t = row.cycle.t;
  sample.mode = row.mode;
  sample.fault = fault_text(row.fault);
  sample.fault_number = row.fault;
  sample.outcome = row.cycle.status;
  sample.share = row.share;
  sample.q = joint_vector(row.position);
  sample.qd = joint_vector(row.velocity);
  sample.torque = joint_vector(row.torque);
  sample.H_WD = row.cycle.H_WD;
  sample.H_WS = row.cycle.H_WS;
  sample.wrench_R = row.cycle.wrench;
  sample.depth = row.cycle.depth;
  sample.contacts = row.cycle.contacts;
  sample.computed = row.compute;
  sample.late = row.late;
  sample.absorbed = row.absorbed;
  return sample;
}

}  // namespace godobject::live
