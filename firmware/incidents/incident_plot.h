#pragma once

#include <string>

#include "firmware/incidents/incident.h"

namespace godobject::firmware {

/// Returns the last 2 s before the stop and half a second after it as an SVG: force at the hand, torques of the joints,
/// speed of the hand, lateness of waking. The incident has a stop.
std::string draw(const Incident& incident);

}  // namespace godobject::firmware
