#pragma once

#include <cstdint>
#include <vector>

#include "toolchain/report/contact_quality/device_path.h"
#include "toolchain/report/contact_quality/world.h"

namespace godobject::report {

/// Results of one cycle of a god object.
struct RecordedCycle {
  Pose H_WD;
  Pose H_WS;
  Vector3 force_W = Vector3::Zero();  ///< spring part, on the device [N]
  double depth = 0.0;                 ///< by the distance field of the solver [m], positive inside
  double true_depth = 0.0;            ///< [m]; only if requested
  std::uint32_t contacts = 0;
  std::uint32_t substeps = 0;
  std::int64_t step1_ns = 0;
  std::int64_t solve_ns = 0;
  bool good = true;  ///< status kOk
};

/// Runs a solver along a path and returns its cycles. The true depth is measured every `true_depth_every` cycles; 0:
/// never.
std::vector<RecordedCycle> record(const World& world, Cycle cycle, const std::vector<Pose>& H_WD,
                                  std::size_t true_depth_every);

/// Returns the poses of body frame B in W for poses of frame C in the still body's frame O.
std::vector<Pose> device_poses(const World& world, const Pose& H_WO, const std::vector<Pose>& H_OC);

/// Returns the sample points in frame C: at the centre of mass, with the mesh's axes.
std::vector<Vector3> points_C(const World& world);

}  // namespace godobject::report
