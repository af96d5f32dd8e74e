#pragma once

#include <cstdint>
#include <optional>

#include "toolchain/report/extremes/draw.h"
#include "toolchain/report/extremes/setup.h"
#include "toolchain/watch/watch.h"

namespace godobject::report {

/// A device that looks for contact and stays in it: it presses, slides, spins, jumps, dashes through, rests and
/// seldom leaves. It looks for contact that it has lost. Each pose depends on the god object's last pose and nearest
/// point, so that a run can be repeated with the same solver only.
class Seeker {
 public:
  explicit Seeker(const Setup& setup);

  /// Returns the next device pose, frame B in W. `H_WS`: the god object; `nearest`: its nearest point, if one is near.
  Pose next(const Pose& H_WS, const watch::Nearest& nearest);

 private:
  enum class Mode : std::uint8_t { kSlide, kSpin, kPulse, kJump, kDash, kRest, kLeave };

  void choose_mode();
  Vector3 away_from_world(const Pose& H_WS);
  std::optional<Vector3> way_back(const Vector3& p_O) const;
  void press(const Pose& H_WS);

  Setup setup_;
  Draw draw_;
  Pose H_WD_;
  Pose H_WD_held_;                     // of kRest and kJump
  Vector3 normal_W_;                   // the last known way out of contact
  Vector3 drift_W_ = Vector3::Zero();  // [m per cycle]
  Vector3 spin_B_ = Vector3::Zero();   // [rad per cycle]
  double depth_ = 0.0;                 // [m]
  Mode mode_ = Mode::kSlide;
  int left_ = 0;             // cycles of this mode
  int total_ = 1;            // cycles of this mode at its begin
  int without_contact_ = 0;  // cycles
  bool is_first_ = true;
};

}  // namespace godobject::report
