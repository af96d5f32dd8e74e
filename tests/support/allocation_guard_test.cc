#include "tests/support/allocation_guard.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <memory>
#include <new>
#include <thread>
#include <vector>

namespace godobject::test {
namespace {

/// The optimiser may leave out a new and its delete; not when the pointer has been seen by others.
void* volatile seen = nullptr;

class AllocationGuardTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!AllocationGuard::works()) GTEST_SKIP() << "not run: a sanitizer holds the allocation functions";
  }
};

TEST_F(AllocationGuardTest, CountsNothingWhereNothingIsAllocated) {
  double sum = 0.0;
  const AllocationGuard guard;
  for (int i = 0; i < 1000; ++i) sum += i;
  EXPECT_EQ(guard.allocations(), 0) << sum;
  EXPECT_EQ(guard.releases(), 0);
}

template <class Allocate, class Release>
void expect_counted(Allocate allocate, Release release) {
  const AllocationGuard guard;
  seen = allocate();
  const std::int64_t allocations = guard.allocations();
  release(seen);
  const std::int64_t releases = guard.releases();
  EXPECT_EQ(allocations, 1);
  EXPECT_EQ(releases, 1);
}

TEST_F(AllocationGuardTest, CountsEveryWayToAllocate) {
  const auto free_block = [](void* block) { std::free(block); };
  expect_counted([] { return std::malloc(32); }, free_block);
  expect_counted([] { return std::calloc(4, 8); }, free_block);
  expect_counted([] { return std::realloc(nullptr, 32); }, free_block);
  expect_counted([] { return std::aligned_alloc(64, 64); }, free_block);
  expect_counted(
      [] {
        void* block = nullptr;
        return posix_memalign(&block, 64, 64) == 0 ? block : nullptr;
      },
      free_block);
  expect_counted([] { return ::operator new(32); }, [](void* block) { ::operator delete(block); });
  expect_counted([] { return ::operator new(32, std::nothrow); }, [](void* block) { ::operator delete(block); });
  expect_counted([] { return ::operator new[](32); }, [](void* block) { ::operator delete[](block); });
  expect_counted([] { return ::operator new (64, std::align_val_t{64}); },
                 [](void* block) { ::operator delete (block, std::align_val_t{64}); });
}

TEST_F(AllocationGuardTest, CountsWhatContainersTake) {
  const AllocationGuard guard;
  {
    std::vector<double> values(100);
    seen = values.data();
  }
  EXPECT_EQ(guard.allocations(), 1);
  EXPECT_EQ(guard.releases(), 1);
}

TEST_F(AllocationGuardTest, CountsOnlyWhileItLives) {
  std::int64_t allocations = 0;
  {
    const AllocationGuard guard;
    allocations = guard.allocations();
  }
  auto kept = std::make_unique<int>(1);
  seen = kept.get();
  const AllocationGuard guard;
  EXPECT_EQ(allocations, 0);
  EXPECT_EQ(guard.allocations(), 0);
}

TEST_F(AllocationGuardTest, LeavesOtherThreadsOut) {
  std::atomic<bool> guarded = false;
  std::int64_t in_thread = 0;
  std::thread other([&] {
    guarded.wait(false);
    const AllocationGuard guard;
    seen = std::malloc(8);
    std::free(seen);
    in_thread = guard.allocations();
  });
  const AllocationGuard guard;
  guarded = true;
  guarded.notify_one();
  other.join();
  EXPECT_EQ(in_thread, 1);
  EXPECT_EQ(guard.allocations(), 0);
}

TEST_F(AllocationGuardTest, Nests) {
  const AllocationGuard outer;
  seen = std::malloc(8);
  std::free(seen);
  {
    const AllocationGuard inner;
    seen = std::malloc(8);
    std::free(seen);
    EXPECT_EQ(inner.allocations(), 1);
  }
  EXPECT_EQ(outer.allocations(), 2);
}

}  // namespace
}  // namespace godobject::test
