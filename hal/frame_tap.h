#pragma once

#include "hal/can_frame.h"

namespace godobject::hal {

/// Observer, called for every received frame, own ones included, in the order of each bus: for logs. `on_frame` runs in
/// the cycle: it never blocks, allocates or throws.
class FrameTap {
 public:
  virtual ~FrameTap() = default;

  virtual void on_frame(int bus, const ReceivedFrame& received) noexcept = 0;

 protected:
  FrameTap() = default;
  FrameTap(const FrameTap&) = default;
  FrameTap& operator=(const FrameTap&) = default;
};

}  // namespace godobject::hal
