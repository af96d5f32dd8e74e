#pragma once

#include <string>
#include <vector>

#include "firmware/configuration/controller_file.h"
#include "firmware/configuration/scene_file.h"
#include "firmware/records/record_folder.h"

namespace godobject::firmware {

/// The files that tell a reader of a record what ran: run.toml with versions, image and limits; controller file and
/// device file as they were read; the provenance of the image. `began`: start of the run in UTC; `buses`: their names,
/// bus 0 first.
std::vector<RecordFile> run_facts(const ControllerConfig& config, const SceneFile& image, const std::string& began,
                                  const std::vector<std::string>& buses);

}  // namespace godobject::firmware
