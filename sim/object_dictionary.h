#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace godobject::sim {

/// Numbers of CiA 301, which an EDS writes too.
enum class ObjectType : std::uint8_t { kI8 = 2, kI16 = 3, kI32 = 4, kU8 = 5, kU16 = 6, kU32 = 7 };

enum class ObjectAccess : std::uint8_t { kConst, kReadOnly, kReadWrite, kWriteOnly };

/// Whether an object may be in a PDO.
enum class Mapping : std::uint8_t { kNo, kToNetwork, kFromNetwork };

constexpr int size_of(ObjectType type) noexcept {
  switch (type) {
    case ObjectType::kI8:
    case ObjectType::kU8: return 1;
    case ObjectType::kI16:
    case ObjectType::kU16: return 2;
    case ObjectType::kI32:
    case ObjectType::kU32: break;
  }
  return 4;
}

struct ObjectEntry {
  std::uint16_t index = 0;
  std::uint8_t sub = 0;
  ObjectType type = ObjectType::kU32;
  ObjectAccess access = ObjectAccess::kReadOnly;
  Mapping mapping = Mapping::kNo;
  std::uint32_t initial = 0;  ///< after a reset
  std::uint32_t value = 0;    ///< of signed types their two's complement

  bool readable() const noexcept { return access != ObjectAccess::kWriteOnly; }
  bool writable() const noexcept { return access == ObjectAccess::kReadWrite || access == ObjectAccess::kWriteOnly; }
  std::int32_t as_signed() const noexcept;
};

/// The objects of a node, at most 4 bytes each. Real-time safe.
class ObjectDictionary {
 public:
  static constexpr std::size_t kCapacity = 112;

  /// Ascending by index and sub-index; its value is its initial one.
  void add(const ObjectEntry& entry) noexcept;

  ObjectEntry* find(std::uint16_t index, std::uint8_t sub) noexcept;  ///< null: there is none
  bool has(std::uint16_t index) const noexcept;
  std::span<const ObjectEntry> entries() const noexcept { return {entries_.data(), count_}; }

  /// Of an entry that there is.
  std::uint32_t value(std::uint16_t index, std::uint8_t sub = 0) const noexcept;
  std::int32_t signed_value(std::uint16_t index, std::uint8_t sub = 0) const noexcept;
  void set(std::uint16_t index, std::uint8_t sub, std::uint32_t value) noexcept;

  /// What it has from now on and after each reset.
  void set_initial(std::uint16_t index, std::uint8_t sub, std::uint32_t value) noexcept;

  /// Initial values from one index to another, both included.
  void restore(std::uint16_t first, std::uint16_t last) noexcept;

 private:
  static constexpr std::size_t kSlots = 256;

  static std::size_t first_slot(std::uint16_t index, std::uint8_t sub) noexcept;
  const ObjectEntry* search(std::uint16_t index, std::uint8_t sub) const noexcept;

  std::array<ObjectEntry, kCapacity> entries_{};
  std::size_t count_ = 0;
  std::array<std::uint8_t, kSlots> slots_{};  ///< 1 + place of the entry; of equal hashes the next free ones; 0: none
};

}  // namespace godobject::sim
