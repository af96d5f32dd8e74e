#pragma once

#include <cstddef>

#include "firmware/incidents/incident.h"

namespace godobject::firmware {

/// Speed of the hand at a row, over the time of the controller's estimate: [m/s] in the room.
double hand_speed(const Incident& incident, std::size_t row);

/// The same for rotations [rad/s].
double hand_turn(const Incident& incident, std::size_t row);

}  // namespace godobject::firmware
