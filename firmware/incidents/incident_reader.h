#pragma once

#include <filesystem>

#include "firmware/incidents/incident.h"

namespace godobject::firmware {

/// Reads the record of a run or of an incident. Of a run with incidents it reads the last one, and of a folder of runs
/// the newest run. Throws command::Failure: kNoInput if the folder or its telemetry.csv is missing, kBadData naming the
/// line if telemetry.csv is not a telemetry. A last row that is cut off is left out, with a note.
Incident read_incident(const std::filesystem::path& folder);

}  // namespace godobject::firmware
