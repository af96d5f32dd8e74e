#include "tests/support/allocation_guard.h"

#include <cerrno>
#include <cstddef>

namespace {

// Plain integers: reading them needs no constructor, so a call before main or late at exit is safe.
thread_local std::int64_t live_guards = 0;
thread_local std::int64_t allocation_count = 0;
thread_local std::int64_t release_count = 0;

}  // namespace

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define GODOBJECT_INTERPOSES_MALLOC 0
#else
#define GODOBJECT_INTERPOSES_MALLOC 1

extern "C" {
// glibc's own entry points, behind the public names that are replaced here.
// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming)
void* __libc_malloc(std::size_t bytes) noexcept;
void* __libc_calloc(std::size_t count, std::size_t bytes) noexcept;
void* __libc_realloc(void* block, std::size_t bytes) noexcept;
void* __libc_memalign(std::size_t alignment, std::size_t bytes) noexcept;
void __libc_free(void* block) noexcept;
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)

void* malloc(std::size_t bytes) noexcept {
  if (live_guards > 0) ++allocation_count;
  return __libc_malloc(bytes);
}

void* calloc(std::size_t count, std::size_t bytes) noexcept {
  if (live_guards > 0) ++allocation_count;
  return __libc_calloc(count, bytes);
}

void* realloc(void* block, std::size_t bytes) noexcept {
  if (live_guards > 0) ++allocation_count;
  return __libc_realloc(block, bytes);
}

void* memalign(std::size_t alignment, std::size_t bytes) noexcept {
  if (live_guards > 0) ++allocation_count;
  return __libc_memalign(alignment, bytes);
}

void* aligned_alloc(std::size_t alignment, std::size_t bytes) noexcept { return memalign(alignment, bytes); }

int posix_memalign(void** block, std::size_t alignment, std::size_t bytes) noexcept {
  *block = memalign(alignment, bytes);
  return *block == nullptr ? ENOMEM : 0;
}

void free(void* block) noexcept {
  if (live_guards > 0 && block != nullptr) ++release_count;
  __libc_free(block);
}
}
#endif

namespace godobject::test {

AllocationGuard::AllocationGuard() noexcept : allocations_before_(allocation_count), releases_before_(release_count) {
  ++live_guards;
}

AllocationGuard::~AllocationGuard() { --live_guards; }

std::int64_t AllocationGuard::allocations() const noexcept { return allocation_count - allocations_before_; }

std::int64_t AllocationGuard::releases() const noexcept { return release_count - releases_before_; }

bool AllocationGuard::works() noexcept { return GODOBJECT_INTERPOSES_MALLOC != 0; }

}  // namespace godobject::test
