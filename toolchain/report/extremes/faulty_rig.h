#pragma once

#include <vector>

#include "toolchain/report/extremes/extremes_fault.h"
#include "toolchain/report/extremes/run.h"

namespace godobject::report {

/// A rig whose solver has a planted fault. The rig must outlive it.
class FaultyRig final : public Rig {
 public:
  FaultyRig(Rig& rig, const ExtremesFault& fault) : rig_(rig), fault_(fault), reports_(fault.cycle) {}

  Status update(const Pose& H_WD, const Motion& velocity_W, CycleReport& report) override {
    const Status status = rig_.update(H_WD, velocity_W, report);
    if (status != Status::kOk) return status;
    reports_.spoil(report);
    return fault_.refuses_poses && ++cycle_ % 10 == 0 ? Status::kOutOfRange : status;
  }
  double smallest_gap(const Pose& H_WS) const override { return fault_.distance_gain * rig_.smallest_gap(H_WS); }
  std::vector<Touch> touches(const Pose& H_WS) const override { return rig_.touches(H_WS); }
  const Parameters& parameters() const override { return rig_.parameters(); }

 private:
  Rig& rig_;
  ExtremesFault fault_;
  FaultyReports reports_;
  int cycle_ = 0;
};

}  // namespace godobject::report
