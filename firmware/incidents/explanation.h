#pragma once

#include <string>

#include "firmware/incidents/incident.h"

namespace godobject::firmware {

/// Returns what happened, in plain words. Each line ends with a line feed.
std::string explain(const Incident& incident);

}  // namespace godobject::firmware
