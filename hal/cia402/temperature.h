#pragma once

#include <cstdint>

namespace godobject::hal {

/// Temperature of a joint's drive or motor: an object of the drive's maker.
struct TemperatureConfig {
  std::uint16_t index = 0;    ///< 0x2001 to 0x5FFF; 0: the drive tells no temperature
  std::uint8_t subindex = 0;  ///< of the object
  int size = 2;               ///< 1, 2 or 4 bytes
  bool is_signed = true;      ///< two's complement
  double scale = 1.0;         ///< of a count [degC]
  double warn = 0.0;          ///< a warning from here on [degC]
  double stop = 0.0;          ///< the arm stops from here on [degC]

  bool exists() const noexcept { return index != 0; }
};

/// Returns the temperature of the object's value [degC]; bytes beyond `size` do not count.
constexpr double celsius(const TemperatureConfig& config, std::uint32_t value) noexcept {
  const int unused = 32 - 8 * config.size;
  const std::uint32_t high = value << unused;
  const double counts = config.is_signed ? static_cast<double>(static_cast<std::int32_t>(high) >> unused)
                                         : static_cast<double>(high >> unused);
  return config.scale * counts;
}

}  // namespace godobject::hal
