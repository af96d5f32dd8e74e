#pragma once

#include "godobject/pose.h"

namespace godobject {

/// Step #5, eq (43): the low-pass of the proxy pose, of `paper` only; its lag is felt as drag and as a pull on retreat.
/// `H_WS_previous` is S(k-1), `H_WS_target` the unfiltered S(k), H_WD the device. The cut-off rises with the distance
/// from target to device, fc = clamp(1 Hz + 19 Hz / 7 mm * Delta, 1, 60) with Delta^2 = |x|^2 + 0.025 |r|^2: the paper
/// gives its range and one point of it only.
Pose filter_proxy(const Pose& H_WS_previous, const Pose& H_WS_target, const Pose& H_WD, double period) noexcept;

}  // namespace godobject
