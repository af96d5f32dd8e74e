#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace godobject::hal {

/// Lock-free queue from the loop to one slower thread: neither side waits. If the reader is too slow, the newest
/// records are lost and counted. One thread pushes, one pops. Large: static storage, or the heap before the loop.
template <class Record, std::size_t kRecords>
class RecordRing {
 public:
  static constexpr std::size_t kCapacity = kRecords;

  /// The loop's side: adds a record, or counts it as lost. Cost: a copy, 100 ns. Real-time safe.
  void push(const Record& record) noexcept {
    const std::size_t end = end_.load(std::memory_order_relaxed);
    if (end - begin_.load(std::memory_order_acquire) == kCapacity) {
      lost_.fetch_add(1, std::memory_order_relaxed);
      return;
    }
    records_[end % kCapacity] = record;
    end_.store(end + 1, std::memory_order_release);
  }

  /// The reader's side: takes the oldest record. False: there is none.
  bool pop(Record& record) noexcept {
    const std::size_t begin = begin_.load(std::memory_order_relaxed);
    if (begin == end_.load(std::memory_order_acquire)) return false;
    record = records_[begin % kCapacity];
    begin_.store(begin + 1, std::memory_order_release);
    return true;
  }

  std::uint64_t lost() const noexcept { return lost_.load(std::memory_order_relaxed); }

 private:
  static_assert(std::atomic<std::size_t>::is_always_lock_free && std::atomic<std::uint64_t>::is_always_lock_free);
  static_assert((kRecords & (kRecords - 1)) == 0, "a power of two: the index stays continuous where the counters wrap");

  std::array<Record, kCapacity> records_;
  alignas(64) std::atomic<std::size_t> begin_{0};
  alignas(64) std::atomic<std::size_t> end_{0};
  std::atomic<std::uint64_t> lost_{0};
};

}  // namespace godobject::hal
