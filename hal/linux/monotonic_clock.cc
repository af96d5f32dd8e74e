#include "hal/linux/monotonic_clock.h"

#include <time.h>

#include <cerrno>

namespace godobject::hal {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

}  // namespace

std::int64_t MonotonicClock::now_ns() noexcept {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * kSecond_ns + now.tv_nsec;
}

void MonotonicClock::sleep_until(std::int64_t ns) noexcept {
  timespec until{};
  until.tv_sec = ns / kSecond_ns;
  until.tv_nsec = ns % kSecond_ns;
  while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
}

}  // namespace godobject::hal
