#pragma once

#include "firmware/machine/finding.h"
#include "hal/cia402/bus_layout.h"

namespace godobject::firmware {

/// Tells if the device file names the serial numbers of the drives. Not good if two or more joints have none: the start
/// would not find two of their drives that are swapped.
Finding check_serial_numbers(const hal::BusLayout& layout);

}  // namespace godobject::firmware
