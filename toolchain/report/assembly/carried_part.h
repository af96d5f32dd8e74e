#pragma once

#include <cstdint>

#include "godobject/report.h"
#include "toolchain/report/assembly/assembly_fault.h"
#include "toolchain/report/assembly/pair.h"
#include "toolchain/session/owned_god_object.h"

namespace godobject::report {

/// Counts of the cycles of a pair.
struct Carried {
  std::int64_t cycles = 0;
  std::int64_t touching = 0;
  std::int64_t overflow = 0;
  std::int64_t started_inside = 0;  ///< the god object had not come out of the still part yet
  std::int64_t cut = 0;
  std::int64_t infeasible = 0;
  std::int64_t friction_not_found = 0;
  std::int64_t overlaps = 0;  ///< cycles whose overlap was measured on the exact meshes
  double overlap = 0.0;       ///< the largest depth among them [m]
};

/// The moving part of a pair in the hand: solver `contact`, with or without friction.
class CarriedPart {
 public:
  /// `friction`: coefficient of static and kinetic friction; 0: none. `pair` must outlive this object.
  CarriedPart(const Pair& pair, double friction, const AssemblyFault& fault);

  /// Starts again, at this pose of the mesh. Returns the report of the first cycle.
  const CycleReport& start(const Pose& H_WM);

  /// Runs a cycle with the device at this pose of the mesh.
  const CycleReport& follow(const Pose& H_WM);

  /// Runs a cycle in which the coupling loads the part in the plane y = 0 with a wrench about its centre of mass: the
  /// device is away from the part by the wrench over the stiffness. It holds the part in that plane, upright about x
  /// and z, as a guide would: the theory is plane, and a part that is free to roll does not stay so. [N, Nm]
  const CycleReport& load(const Wrench& load_W);

  /// Measures the overlap of the exact meshes in the next cycle, and after each later one in which it may have become
  /// larger than the accuracy: a motion changes it by no more than the displacement. `every`: only in every n-th of
  /// these, so that the overlap of the others stays unknown.
  void watch_overlap(int every = 1) { watch_every_ = every; }

  const Pose& pose() const { return H_WM_; }  ///< of the mesh
  Vector3 center_W() const { return H_WM_ * pair_.image.scene.H_MB.translation; }
  double stiffness() const { return stiffness_; }        ///< [N/m]
  double turning_stiffness() const { return turning_; }  ///< [Nm/rad]
  const Carried& carried() const { return carried_; }

 private:
  const CycleReport& run(const Pose& H_WM);
  void count();
  void watch();

  const Pair& pair_;
  AssemblyFault fault_;
  FaultyReports faulty_;
  OwnedGodObject god_object_;
  CycleReport report_;
  Pose H_WM_;
  double stiffness_ = 0.0;
  double turning_ = 0.0;
  Carried carried_;
  int watch_every_ = 0;
  int waited_ = 0;
  bool measured_ = false;
  Pose measured_at_;
  double measured_depth_ = 0.0;
};

}  // namespace godobject::report
