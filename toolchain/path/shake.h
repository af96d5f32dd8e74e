#pragma once

#include <cstdint>

#include "toolchain/path/keyframes.h"

namespace godobject::path {

/// Adds the slow swing of an unsteady hand to a motion, over all of its time: along and about each axis of W three
/// sines of 0.1 to 1.5 Hz, each with an amplitude of up to 1 mm or 20 mrad. One seed gives one swing, on every machine.
void shake(std::uint64_t seed, Keyframes& motion);

}  // namespace godobject::path
