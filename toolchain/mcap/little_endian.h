#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <string>

namespace godobject::mcap {

/// Appends a number with its lowest byte first, whatever the order of the processor.
template <std::unsigned_integral Number>
void append_little_endian(std::string& bytes, Number number) {
  std::array<char, sizeof(Number)> ordered;
  for (std::size_t i = 0; i < ordered.size(); ++i) ordered[i] = static_cast<char>((number >> (8 * i)) & 0xffu);
  bytes.append(ordered.data(), ordered.size());
}

}  // namespace godobject::mcap
