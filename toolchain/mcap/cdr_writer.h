#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "toolchain/mcap/little_endian.h"

namespace godobject::mcap {

/// Serialises a message of ROS 2: CDR, little-endian, after the four bytes that say so. Each number begins at a
/// multiple of its size, counted from the end of these four bytes. The order of the calls is that of the message's
/// fields.
class CdrWriter {
 public:
  void boolean(bool value) { bytes_ += value ? '\1' : '\0'; }
  void uint32(std::uint32_t value) { number(value); }
  void int32(std::int32_t value) { number(static_cast<std::uint32_t>(value)); }
  void float32(float value) { number(std::bit_cast<std::uint32_t>(value)); }
  void float64(double value) { number(std::bit_cast<std::uint64_t>(value)); }

  /// A NUL ends the string.
  void string(std::string_view text) {
    text = text.substr(0, text.find('\0'));
    count(text.size() + 1);
    bytes_ += text;
    bytes_ += '\0';
  }

  /// The number of elements of a sequence; the elements follow.
  void count(std::size_t elements) { number(static_cast<std::uint32_t>(elements)); }

  const std::string& bytes() const { return bytes_; }

 private:
  static constexpr std::size_t kHeader = 4;

  template <class Number>
  void number(Number value) {
    const std::size_t over = (bytes_.size() - kHeader) % sizeof(Number);
    if (over != 0) bytes_.append(sizeof(Number) - over, '\0');
    append_little_endian(bytes_, value);
  }

  std::string bytes_{'\0', '\1', '\0', '\0'};
};

}  // namespace godobject::mcap
