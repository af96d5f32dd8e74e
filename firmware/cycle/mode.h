#pragma once

#include <cstddef>
#include <cstdint>

namespace godobject::firmware {

/// The supervisor's modes. The drives have power from kEnabling to kFade and in kEnding.
enum class Mode : std::uint8_t {
  kBoot,       ///< waits until all drives answer
  kZeroCheck,  ///< checks that positions are possible and at rest, with the brakes closed
  kIdle,       ///< waits for the enable switch: first released, then held
  kEnabling,   ///< holds the arm; waits until all drives are enabled
  kSignTest,   ///< checks that each joint moves in the direction of its torque
  kArmed,      ///< holds the arm; waits until the contact force is small
  kEngaging,   ///< the rendered share rises from zero
  kRunning,    ///< renders
  kFade,       ///< the last rendered torques fade to zero within kFade_ms; then kStopping
  kStopping,   ///< renders nothing, holds the arm; the drives come to rest and close the brakes
  kStopped,    ///< no power once the drives rest; a fault is latched until the operator resets it
  kResetting,  ///< resets the drives' faults once they rest; then kBoot
  kEnding,     ///< the run was asked to end: the rendered share falls to zero; then kStopping
  kEnded,      ///< no power once the drives rest; the loop may end
};
inline constexpr std::size_t kModeCount = static_cast<std::size_t>(Mode::kEnded) + 1;

/// The mode as one word, as in the telemetry. Never null.
const char* name(Mode mode) noexcept;

}  // namespace godobject::firmware
