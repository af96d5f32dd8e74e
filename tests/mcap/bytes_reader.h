#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace godobject::mcap {

/// Reads little-endian numbers one after the other. Throws std::runtime_error at the end of the bytes.
class BytesReader {
 public:
  explicit BytesReader(std::string_view bytes) : bytes_(bytes) {}

  template <class Number>
  Number number() {
    const std::string_view taken = take(sizeof(Number));
    std::uint64_t value = 0;
    for (std::size_t i = taken.size(); i-- > 0;) value = value << 8 | static_cast<std::uint8_t>(taken[i]);
    return static_cast<Number>(value);
  }

  std::string_view take(std::uint64_t size) {
    if (size > bytes_.size() - at_) throw std::runtime_error("ends too early");
    at_ += size;
    return bytes_.substr(at_ - size, size);
  }

  std::string_view counted() { return take(number<std::uint32_t>()); }
  bool at_end() const { return at_ == bytes_.size(); }
  std::size_t at() const { return at_; }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

/// Reads a message in the encoding CDR, little-endian, without the code that wrote it.
class CdrReader {
 public:
  explicit CdrReader(std::string message) : message_(std::move(message)), reader_(message_) {
    if (reader_.take(4) != std::string_view("\0\1\0\0", 4)) throw std::runtime_error("not little-endian CDR");
  }

  template <class Number>
  Number number() {
    while ((reader_.at() - 4) % sizeof(Number) != 0) {
      if (reader_.take(1) != std::string_view("\0", 1)) throw std::runtime_error("padding is not zero");
    }
    return reader_.number<Number>();
  }

  double real() {
    const auto bits = number<std::uint64_t>();
    double value = 0.0;
    std::memcpy(&value, &bits, sizeof(value));
    return value;
  }

  float single() {
    const auto bits = number<std::uint32_t>();
    float value = 0.0f;
    std::memcpy(&value, &bits, sizeof(value));
    return value;
  }

  std::string text() {
    const std::string_view bytes = reader_.take(number<std::uint32_t>());
    if (bytes.empty() || bytes.back() != '\0') throw std::runtime_error("a string does not end with NUL");
    return std::string(bytes.substr(0, bytes.size() - 1));
  }

  bool at_end() const { return reader_.at_end(); }

 private:
  const std::string message_;
  BytesReader reader_;
};

}  // namespace godobject::mcap
