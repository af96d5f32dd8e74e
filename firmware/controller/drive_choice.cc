#include "firmware/controller/drive_choice.h"

#include "firmware/drives/cia402/cia402_family.h"

namespace godobject::firmware {

std::unique_ptr<DriveFamily> choose_drives(const Device& device) { return std::make_unique<Cia402Family>(device.bus); }

}  // namespace godobject::firmware
