#include "firmware/controller/real_time_thread.h"

#include "firmware/controller/warning.h"
#include "firmware/machine/rt_setup.h"
#include "toolchain/command_line/failure.h"

namespace godobject::firmware {

void set_up_loop_thread(const ControllerConfig::Loop& loop, bool simulated) {
  for (const std::string& missing : set_up_real_time({.cpu = loop.cpu, .priority = loop.priority})) {
    if (!simulated) throw command::Failure(command::ExitCode::kNoPermission, missing);
    warn(missing + "; going on, since the bus is simulated");
  }
}

}  // namespace godobject::firmware
