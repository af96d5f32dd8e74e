#pragma once

#include <cstdint>

namespace godobject {

/// Bounds of the loops of `contact`, shared by `contact_cycle` and `ball_cycle`.

/// Times in a sub-step that the surface at an obstacle becomes one more row, before the motion is halved instead.
inline constexpr int kMostSecondLooks = 6;
/// Attempts at a motion in a sub-step; after the last one the god object stays.
inline constexpr int kMostAttempts = 14;
/// Sub-steps without a near point in one cycle.
inline constexpr std::uint32_t kMostFreeSubsteps = 64;
/// Free balls along one chord.
inline constexpr int kMostBallsOfChord = 64;
/// Look-ups for free balls in one cycle. The remaining motion is dropped when they are used up. Without vectors a flat face
/// of a thousand points that slides by a millimetre a cycle takes 50000; with fewer the god object would fall behind for
/// good.
inline constexpr int kMostBallsOfCycle = 1 << 17;
/// A motion that would raise the coupling's energy again beyond this share of its first decrease stops earlier
/// (`Arrival`). At 1 the god object would swing in a valley of the field for ever; 0.5 halves the swing each cycle.
inline constexpr double kMostOvershoot = 0.5;
}  // namespace godobject
