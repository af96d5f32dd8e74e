#pragma once

#include "firmware/configuration/controller_file.h"

namespace godobject::firmware {

/// Makes the calling thread the loop's real-time thread (firmware/machine/rt_setup.h). A missing right is a warning if
/// the arm is simulated; for a real arm it throws command::Failure (kNoPermission).
void set_up_loop_thread(const ControllerConfig::Loop& loop, bool simulated);

}  // namespace godobject::firmware
