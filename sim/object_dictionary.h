#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace godobject::sim {

/// Data types with their numbers of CiA 301, as in an EDS.
enum class ObjectType : std::uint8_t { kI8 = 2, kI16 = 3, kI32 = 4, kU8 = 5, kU16 = 6, kU32 = 7 };

enum class ObjectAccess : std::uint8_t { kConst, kReadOnly, kReadWrite, kWriteOnly };

/// Direction of the PDOs that may contain an object.
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

/// An object, or a sub-object, with its value.
struct ObjectEntry {
  std::uint16_t index = 0;
  std::uint8_t sub = 0;
  ObjectType type = ObjectType::kU32;
  ObjectAccess access = ObjectAccess::kReadOnly;
  Mapping mapping = Mapping::kNo;
  std::uint32_t initial = 0;  ///< value after a reset
  std::uint32_t value = 0;    ///< two's complement for signed types

  bool readable() const noexcept { return access != ObjectAccess::kWriteOnly; }
  bool writable() const noexcept { return access == ObjectAccess::kReadWrite || access == ObjectAccess::kWriteOnly; }
  std::int32_t as_signed() const noexcept;
};

/// The object dictionary of a node with objects of at most 4 bytes. Real-time safe.
class ObjectDictionary {
 public:
  static constexpr std::size_t kCapacity = 112;  ///< entries; asserted in `add`

  /// Adds an entry with its initial value. Entries are added in ascending order of index and sub-index.
  void add(const ObjectEntry& entry) noexcept;

  ObjectEntry* find(std::uint16_t index, std::uint8_t sub) noexcept;  ///< null: no such entry
  bool has(std::uint16_t index) const noexcept;
  std::span<const ObjectEntry> entries() const noexcept { return {entries_.data(), count_}; }

  /// Values of an existing entry.
  std::uint32_t value(std::uint16_t index, std::uint8_t sub = 0) const noexcept;
  std::int32_t signed_value(std::uint16_t index, std::uint8_t sub = 0) const noexcept;
  void set(std::uint16_t index, std::uint8_t sub, std::uint32_t value) noexcept;

  /// Sets the value, now and after each reset.
  void set_initial(std::uint16_t index, std::uint8_t sub, std::uint32_t value) noexcept;

  /// Restores the initial values of all entries with an index from `first` to `last`.
  void restore(std::uint16_t first, std::uint16_t last) noexcept;

 private:
  static constexpr std::size_t kSlots = 256;

  static std::size_t first_slot(std::uint16_t index, std::uint8_t sub) noexcept;
  const ObjectEntry* search(std::uint16_t index, std::uint8_t sub) const noexcept;

  std::array<ObjectEntry, kCapacity> entries_{};
  std::size_t count_ = 0;
  std::array<std::uint8_t, kSlots>
      slots_{};  ///< hash table: 1 + position of the entry; equal hashes use the next free slot; 0: empty
};

}  // namespace godobject::sim
