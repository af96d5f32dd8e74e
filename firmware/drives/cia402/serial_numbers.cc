#include "firmware/drives/cia402/serial_numbers.h"

#include <cstddef>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace godobject::firmware {

Finding check_serial_numbers(const hal::BusLayout& layout) {
  std::vector<int> unnamed;
  for (int i = 0; i < layout.joint_count; ++i) {
    if (!layout.drives[static_cast<std::size_t>(i)].identity.serial) unnamed.push_back(i + 1);
  }
  // a single unnamed drive that is swapped shows at the other joint
  if (unnamed.size() < 2) return {.good = true, .what = "serial numbers of the drives in the device file", .cure = ""};
  return {.what = fmt::format("the device file does not name the drives' serial numbers; two swapped drives would not "
                              "be found (joints {})",
                              fmt::join(unnamed, ", ")),
          .cure = "paste the lines that godobject-controller commission prints"};
}

}  // namespace godobject::firmware
