#pragma once

#include "godobject/pose.h"

namespace godobject {

/// Returns the low-pass filtered proxy pose. Step #5, eq (43), of `paper` only; the user feels its lag as drag, and as
/// a pull on retreat. `H_WS_previous` is S(k-1), `H_WS_target` the unfiltered S(k), H_WD the device, `period` T [s].
///
/// The cut-off frequency rises with the distance from target to device: fc = clamp(1 Hz + 19 Hz / 7 mm * Delta, 1, 60)
/// with Delta^2 = |x|^2 + 0.025 m^2 |r|^2. The paper gives only the range and one point. Real-time safe.
Pose filter_proxy(const Pose& H_WS_previous, const Pose& H_WS_target, const Pose& H_WD, double period) noexcept;

}  // namespace godobject
