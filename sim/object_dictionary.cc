#include "sim/object_dictionary.h"

#include <algorithm>
#include <cassert>

namespace godobject::sim {
namespace {

constexpr std::uint32_t key(std::uint16_t index, std::uint8_t sub) noexcept {
  return (static_cast<std::uint32_t>(index) << 8) | sub;
}

constexpr std::uint32_t within(std::uint32_t value, ObjectType type) noexcept {
  const int bits = 8 * size_of(type);
  return bits == 32 ? value : value & ((1u << bits) - 1u);
}

}  // namespace

std::int32_t ObjectEntry::as_signed() const noexcept {
  switch (type) {
    case ObjectType::kI8: return static_cast<std::int8_t>(value);
    case ObjectType::kI16: return static_cast<std::int16_t>(value);
    default: return static_cast<std::int32_t>(value);
  }
}

void ObjectDictionary::add(const ObjectEntry& entry) noexcept {
  assert(count_ < kCapacity);
  assert(count_ == 0 || key(entry.index, entry.sub) > key(entries_[count_ - 1].index, entries_[count_ - 1].sub));
  entries_[count_] = entry;
  entries_[count_].initial = within(entry.initial, entry.type);
  entries_[count_].value = entries_[count_].initial;
  ++count_;
  std::size_t slot = first_slot(entry.index, entry.sub);
  while (slots_[slot] != 0) slot = (slot + 1) % kSlots;
  slots_[slot] = static_cast<std::uint8_t>(count_);
}

/// Knuth's multiplicative hash.
std::size_t ObjectDictionary::first_slot(std::uint16_t index, std::uint8_t sub) noexcept {
  static_assert(kSlots == 1u << 8 && kCapacity < kSlots);
  return (key(index, sub) * 2654435769u) >> 24;
}

const ObjectEntry* ObjectDictionary::search(std::uint16_t index, std::uint8_t sub) const noexcept {
  for (std::size_t slot = first_slot(index, sub); slots_[slot] != 0; slot = (slot + 1) % kSlots) {
    const ObjectEntry& entry = entries_[slots_[slot] - 1u];
    if (entry.index == index && entry.sub == sub) return &entry;
  }
  return nullptr;
}

ObjectEntry* ObjectDictionary::find(std::uint16_t index, std::uint8_t sub) noexcept {
  const ObjectEntry* found = search(index, sub);
  return found == nullptr ? nullptr : &entries_[static_cast<std::size_t>(found - entries_.data())];
}

bool ObjectDictionary::has(std::uint16_t index) const noexcept {
  const auto all = entries();
  return std::any_of(all.begin(), all.end(), [index](const ObjectEntry& entry) { return entry.index == index; });
}

std::uint32_t ObjectDictionary::value(std::uint16_t index, std::uint8_t sub) const noexcept {
  const ObjectEntry* entry = search(index, sub);
  assert(entry != nullptr);
  return entry == nullptr ? 0 : entry->value;
}

std::int32_t ObjectDictionary::signed_value(std::uint16_t index, std::uint8_t sub) const noexcept {
  const ObjectEntry* entry = search(index, sub);
  assert(entry != nullptr);
  return entry == nullptr ? 0 : entry->as_signed();
}

void ObjectDictionary::set(std::uint16_t index, std::uint8_t sub, std::uint32_t value) noexcept {
  ObjectEntry* entry = find(index, sub);
  assert(entry != nullptr);
  if (entry != nullptr) entry->value = within(value, entry->type);
}

void ObjectDictionary::set_initial(std::uint16_t index, std::uint8_t sub, std::uint32_t value) noexcept {
  set(index, sub, value);
  if (ObjectEntry* entry = find(index, sub)) entry->initial = entry->value;
}

void ObjectDictionary::restore(std::uint16_t first, std::uint16_t last) noexcept {
  for (std::size_t i = 0; i < count_; ++i) {
    ObjectEntry& entry = entries_[i];
    if (entry.index >= first && entry.index <= last) entry.value = entry.initial;
  }
}

}  // namespace godobject::sim
