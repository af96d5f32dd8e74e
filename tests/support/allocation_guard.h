#pragma once

#include <cstdint>

namespace godobject::test {

/// Counts the heap calls of this thread while it lives: malloc, calloc, realloc, aligned_alloc, posix_memalign,
/// memalign, free, and operator new and delete, which end in them. Other threads are not counted. Guards nest; each
/// counts for itself.
///
/// Works in every build type, because it stands in for the C library's functions: link the library `allocation_guard`.
/// Under a sanitizer, which needs those functions for itself, nothing is counted and `works()` is false: skip the test.
class AllocationGuard {
 public:
  AllocationGuard() noexcept;
  ~AllocationGuard();
  AllocationGuard(const AllocationGuard&) = delete;
  AllocationGuard& operator=(const AllocationGuard&) = delete;

  /// Blocks taken, and given back, since the guard was made.
  std::int64_t allocations() const noexcept;
  std::int64_t releases() const noexcept;

  static bool works() noexcept;

 private:
  std::int64_t allocations_before_;
  std::int64_t releases_before_;
};

}  // namespace godobject::test
