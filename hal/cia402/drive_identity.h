#pragma once

#include <array>
#include <cstdint>
#include <optional>

namespace godobject::hal {

/// Identity object 1018 of a drive: what a device file names, or what a drive tells. CiA 301 requires `vendor` of each
/// node; a node may lack the others.
struct DriveIdentity {
  std::optional<std::uint32_t> vendor{};    ///< 1018:1, as registered with CiA
  std::optional<std::uint32_t> product{};   ///< 1018:2
  std::optional<std::uint32_t> revision{};  ///< 1018:3; upper half: communication, lower half: device
  std::optional<std::uint32_t> serial{};    ///< 1018:4
};

/// A field of an identity with its sub-index and its key in a device file.
struct IdentityField {
  std::uint8_t subindex;
  const char* name;
  std::optional<std::uint32_t> DriveIdentity::*value;
};

inline constexpr std::array<IdentityField, 4> kIdentityFields = {{{1, "vendor", &DriveIdentity::vendor},
                                                                  {2, "product", &DriveIdentity::product},
                                                                  {3, "revision", &DriveIdentity::revision},
                                                                  {4, "serial", &DriveIdentity::serial}}};

/// Returns true unless a field that both identities have differs.
constexpr bool may_be_same(const DriveIdentity& a, const DriveIdentity& b) noexcept {
  for (const IdentityField& field : kIdentityFields) {
    const std::optional<std::uint32_t>& of_a = a.*field.value;
    const std::optional<std::uint32_t>& of_b = b.*field.value;
    if (of_a && of_b && *of_a != *of_b) return false;
  }
  return true;
}

}  // namespace godobject::hal
