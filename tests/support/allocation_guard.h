#pragma once

#include <cstdint>

namespace godobject::test {

/// Counts the heap calls of its thread during its lifetime: malloc, calloc, realloc, aligned_alloc, posix_memalign,
/// memalign, free, and operator new and delete, which call them. The calls of other threads do not count. Guards can be
/// nested; each one counts for itself.
///
/// Link the library `allocation_guard`, which replaces the functions of the C library in every build type. A sanitizer
/// replaces the same functions: then the guard counts nothing and `works()` returns false, so skip the test.
class AllocationGuard {
 public:
  AllocationGuard() noexcept;
  ~AllocationGuard();
  AllocationGuard(const AllocationGuard&) = delete;
  AllocationGuard& operator=(const AllocationGuard&) = delete;

  /// Returns the number of allocated blocks, or of freed blocks, since the guard was constructed.
  std::int64_t allocations() const noexcept;
  std::int64_t releases() const noexcept;

  static bool works() noexcept;

 private:
  std::int64_t allocations_before_;
  std::int64_t releases_before_;
};

}  // namespace godobject::test
