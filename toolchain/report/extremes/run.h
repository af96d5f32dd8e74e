#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "toolchain/report/extremes/setup.h"
#include "toolchain/report/extremes/way_out.h"
#include "toolchain/session/owned_god_object.h"

namespace godobject::report {

/// A solver at its start in a world: analytic, or compiled in `work`.
class Rig {
 public:
  virtual ~Rig() = default;

  /// Runs a cycle with the body frame at the device pose H_WD.
  virtual Status update(const Pose& H_WD, const Motion& velocity_W, CycleReport& report) = 0;
  virtual double smallest_gap(const Pose& H_WS) const = 0;  ///< of all sample points, by the solver's distance [m]
  virtual std::vector<Touch> touches(const Pose& H_WS) const = 0;  ///< near points, of both directions
  virtual const Parameters& parameters() const = 0;
};

std::unique_ptr<Rig> make_rig(const Setup& setup, const std::filesystem::path& work);

/// Tells if the scene compiler makes the world. Such worlds take seconds, and refuse bad input themselves.
bool is_compiled(const Setup& setup);

/// Returns the device poses, frame B in W, one per millisecond.
std::vector<Pose> device_path(const Setup& setup);

/// Violations of a run; the counts are of cycles.
struct Violations {
  std::int64_t cycles = 0;
  std::int64_t bad_status = 0;   ///< a valid pose refused, or an invalid one accepted
  std::int64_t not_finite = 0;   ///< in pose or force
  std::int64_t not_unit = 0;     ///< a rotation off by more than 1e-9
  std::int64_t crossings = 0;    ///< contact: a sample point inside that did not start inside
  std::int64_t unbounded = 0;    ///< a force above spring times stretch plus damper times velocity
  std::int64_t pulled_away = 0;  ///< contact: farther from the device than without motion or by the way out
  std::string first = {};        ///< the first violation in words

  std::int64_t all() const { return bad_status + not_finite + not_unit + crossings + unbounded + pulled_away; }
  void add(const Violations& other);
};

Violations run_setup(const Setup& setup, Rig& rig);

}  // namespace godobject::report
