#pragma once

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <span>

namespace godobject::files {

/// Bytes on the heap, aligned as a scene image and the memory of a god object must be.
class AlignedBytes {
 public:
  static constexpr std::size_t kAlignment = 64;

  /// All zero. Throws std::bad_alloc.
  explicit AlignedBytes(std::size_t size)
      : bytes_(static_cast<std::byte*>(std::aligned_alloc(kAlignment, (size / kAlignment + 1) * kAlignment))),
        size_(size) {
    if (!bytes_) throw std::bad_alloc();
    std::memset(bytes_.get(), 0, size);
  }

  std::span<std::byte> span() noexcept { return {bytes_.get(), size_}; }
  std::span<const std::byte> span() const noexcept { return {bytes_.get(), size_}; }

 private:
  struct Free {
    void operator()(std::byte* bytes) const noexcept { std::free(bytes); }
  };
  std::unique_ptr<std::byte, Free> bytes_;
  std::size_t size_;
};

}  // namespace godobject::files
