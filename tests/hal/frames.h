#pragma once

#include <algorithm>
#include <initializer_list>
#include <ostream>

#include "hal/can_frame.h"

namespace godobject::hal {

/// A frame as it stands in a manual: identifier and bytes.
inline CanFrame frame(std::uint16_t id, std::initializer_list<int> bytes) {
  CanFrame frame{id, static_cast<std::uint8_t>(bytes.size())};
  std::transform(bytes.begin(), bytes.end(), frame.data.begin(),
                 [](int byte) { return static_cast<std::uint8_t>(byte); });
  return frame;
}

inline bool operator==(const CanFrame& a, const CanFrame& b) {
  return a.id == b.id && a.length == b.length && a.fd == b.fd &&
         std::equal(a.data.begin(), a.data.begin() + a.length, b.data.begin());
}

inline std::ostream& operator<<(std::ostream& out, const CanFrame& frame) {
  const auto flags = out.flags();
  out << std::hex << std::uppercase << frame.id << '#';
  for (int i = 0; i < frame.length; ++i) {
    const int byte = frame.data[static_cast<std::size_t>(i)];
    out << (byte < 16 ? "0" : "") << byte;
  }
  out.flags(flags);
  return out;
}

}  // namespace godobject::hal
