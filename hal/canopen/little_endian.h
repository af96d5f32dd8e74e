#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

/// Numbers in CANopen's byte order, least significant byte first. The caller checks the length.
namespace godobject::hal::canopen {

constexpr std::uint32_t load(std::span<const std::uint8_t> bytes, std::size_t at, std::size_t size) noexcept {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < size; ++i) value |= static_cast<std::uint32_t>(bytes[at + i]) << (8 * i);
  return value;
}

constexpr void store(std::span<std::uint8_t> bytes, std::size_t at, std::size_t size, std::uint32_t value) noexcept {
  for (std::size_t i = 0; i < size; ++i) bytes[at + i] = static_cast<std::uint8_t>(value >> (8 * i));
}

}  // namespace godobject::hal::canopen
