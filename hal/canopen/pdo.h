#pragma once

#include <cstdint>

/// PDO parameters of CiA 301.
namespace godobject::hal::canopen {

inline constexpr std::uint32_t kPdoInvalid = 1u << 31;    ///< in the COB-ID: the PDO does not exist
inline constexpr std::uint32_t kPdoCobMask = 0x800007FF;  ///< bits of the COB-ID that a node must keep as written
inline constexpr std::uint8_t kPdoEverySync = 1;          ///< transmission type
inline constexpr std::uint8_t kPdoAtOnce = 255;  ///< transmission type: an RPDO acts at once, a TPDO is sent on change

/// A mapping entry of 1600 or 1A00.
constexpr std::uint32_t pdo_entry(std::uint16_t index, std::uint8_t subindex, std::uint8_t bits) noexcept {
  return static_cast<std::uint32_t>(index) << 16 | static_cast<std::uint32_t>(subindex) << 8 | bits;
}

}  // namespace godobject::hal::canopen
