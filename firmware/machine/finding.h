#pragma once

#include <string>

namespace godobject::firmware {

/// The result of one check of this machine.
struct Finding {
  bool good = false;
  std::string what;     ///< the state that the check found
  std::string cure;     ///< the command or setting that mends it; empty if `good`
  bool needed = false;  ///< real-time work is impossible without it
};

}  // namespace godobject::firmware
