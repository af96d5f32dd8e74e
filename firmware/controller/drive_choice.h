#pragma once

#include <memory>

#include "firmware/drives/drive_family.h"

namespace godobject::firmware {

/// The drive family of a device file: the only place that names one. The family's `connect` picks the transport.
std::unique_ptr<DriveFamily> choose_drives(const Device& device);

}  // namespace godobject::firmware
