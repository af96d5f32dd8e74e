#include "firmware/cycle/mode.h"

namespace godobject::firmware {

const char* name(Mode mode) noexcept {
  switch (mode) {
    case Mode::kBoot: return "boot";
    case Mode::kZeroCheck: return "zero_check";
    case Mode::kIdle: return "idle";
    case Mode::kEnabling: return "enabling";
    case Mode::kSignTest: return "sign_test";
    case Mode::kArmed: return "armed";
    case Mode::kEngaging: return "engaging";
    case Mode::kRunning: return "running";
    case Mode::kFade: return "fade";
    case Mode::kStopping: return "stopping";
    case Mode::kStopped: return "stopped";
    case Mode::kResetting: return "resetting";
    case Mode::kEnding: return "ending";
    case Mode::kEnded: return "ended";
  }
  return "unknown";
}

}  // namespace godobject::firmware
