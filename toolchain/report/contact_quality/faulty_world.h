#pragma once

#include <vector>

#include "toolchain/report/contact_quality/cycle_fault.h"
#include "toolchain/report/contact_quality/world.h"

namespace godobject::report {

/// A world whose solvers have a planted fault. The world must outlive it.
class FaultyWorld final : public World {
 public:
  FaultyWorld(const World& world, const CycleFault& fault) : world_(world), fault_(fault) {}

  Cycle start(Solver solver, bool friction) const override {
    Cycle sound = world_.start(solver, friction);
    if (!sound) return {};
    auto reports = std::make_shared<FaultyReports>(fault_);
    return [sound, reports, slower_ns = fault_.slower_ns](const Pose& H_WD, CycleReport& report, StepTimes& times) {
      const Status status = sound(H_WD, report, times);
      reports->spoil(report);
      times.solve_ns += slower_ns;
      return status;
    };
  }

  double distance(const Vector3& p_W) const override { return world_.distance(p_W); }
  void pieces(const Vector3& p_W, std::vector<analytic::Piece>& out) const override { world_.pieces(p_W, out); }
  double depth(const Pose& H_WS) const override { return world_.depth(H_WS); }
  double true_depth(const Pose& H_WS) const override { return world_.true_depth(H_WS); }
  const Pose& H_MB() const override { return world_.H_MB(); }
  const std::vector<Vector3>& points_B() const override { return world_.points_B(); }
  std::vector<watch::WatchedEdge> edges_B() const override { return world_.edges_B(); }
  std::vector<watch::WatchedEdge> edges_W() const override { return world_.edges_W(); }

 private:
  const World& world_;
  CycleFault fault_;
};

}  // namespace godobject::report
