#include "toolchain/parallel/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace godobject::parallel {
namespace {

std::size_t thread_count() { return std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, 64); }

}  // namespace

void for_each_chunk(std::size_t count, std::size_t chunk, const std::function<void(std::size_t, std::size_t)>& work,
                    const Progress& progress) {
  std::atomic<std::size_t> next{0};
  std::atomic<bool> failed{false};
  std::exception_ptr failure;
  std::mutex failure_guard;
  const auto take = [&](const Progress& report) {
    while (!failed) {
      const std::size_t begin = next.fetch_add(chunk);
      if (begin >= count) return;
      try {
        work(begin, std::min(begin + chunk, count));
        if (report) report(static_cast<double>(begin) / static_cast<double>(count));
      } catch (...) {
        const std::scoped_lock lock(failure_guard);
        if (!failed.exchange(true)) failure = std::current_exception();
      }
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (std::size_t i = 1; i < thread_count() && i * chunk < count; ++i) helpers.emplace_back([&take] { take({}); });
    take(progress);
  }
  if (failure) std::rethrow_exception(failure);
}

void for_each_index(std::size_t count, const std::function<void(std::size_t)>& work, const Progress& progress) {
  const std::size_t chunk = std::clamp<std::size_t>(count / (thread_count() * 64), 1, 256);
  for_each_chunk(
      count, chunk,
      [&work](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) work(i);
      },
      progress);
}

Progress part_of(Progress progress, double begin, double end) {
  if (!progress) return {};
  return [progress = std::move(progress), begin, end](double done) { progress(begin + done * (end - begin)); };
}

}  // namespace godobject::parallel
