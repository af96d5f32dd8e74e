#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "toolchain/session/owned_god_object.h"
#include "toolchain/report/extremes/setup.h"
#include "toolchain/report/extremes/way_out.h"

namespace godobject::report {

/// A solver in a world, started anew: analytic, or compiled in `work`.
class Rig {
 public:
  virtual ~Rig() = default;

  /// Frame B of the body as the device holds it.
  virtual Status update(const Pose& H_WD, const Motion& velocity_W, CycleReport& report) = 0;
  virtual double smallest_gap(const Pose& H_WS) const = 0;  ///< of all sample points, in the distance that it sees [m]
  virtual std::vector<Touch> touches(const Pose& H_WS) const = 0;  ///< what is near there, of both directions
  virtual const Parameters& parameters() const = 0;
};

std::unique_ptr<Rig> make_rig(const Setup& setup, const std::filesystem::path& work);

/// True for worlds that the scene compiler makes: they take seconds, and refuse bad input themselves.
bool is_compiled(const Setup& setup);

/// The device's poses, frame B in W, a millisecond apart.
std::vector<Pose> device_path(const Setup& setup);

/// What a run did that it must not do; the counts are of cycles.
struct Violations {
  std::int64_t cycles = 0;
  std::int64_t bad_status = 0;   ///< a pose refused, or what is none taken
  std::int64_t not_finite = 0;   ///< in pose or force
  std::int64_t not_unit = 0;     ///< a rotation off by more than 1e-9
  std::int64_t crossings = 0;    ///< contact: a sample point inside that did not start there
  std::int64_t unbounded = 0;    ///< a force beyond spring times stretch and damper times velocity
  std::int64_t pulled_away = 0;  ///< contact: further from the device than if it had stayed or gone the way out
  std::string first = {};        ///< in words

  std::int64_t all() const { return bad_status + not_finite + not_unit + crossings + unbounded + pulled_away; }
  void add(const Violations& other);
};

Violations run_setup(const Setup& setup, Rig& rig);

}  // namespace godobject::report
