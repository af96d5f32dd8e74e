#pragma once

#include <atomic>

namespace godobject::firmware {

/// The operator's requests to a running loop. Signal handlers and other threads set it.
struct RunRequests {
  std::atomic<bool> end{false};    ///< end the run in order
  std::atomic<bool> reset{false};  ///< reset a latched fault; the loop clears it
};
static_assert(std::atomic<bool>::is_always_lock_free);

}  // namespace godobject::firmware
