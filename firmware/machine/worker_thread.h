#pragma once

#include <cstdio>
#include <exception>
#include <stop_token>
#include <thread>
#include <utility>

namespace godobject::firmware {

/// Runs `work(stop)` on a thread beside the loop. An exception of `work` ends this thread only, with a line on stderr
/// that contains `name`: a lost log must not end a process whose drives have power. `name` outlives the thread.
template <class Work>
std::jthread start_worker(const char* name, Work work) {
  return std::jthread([name, work = std::move(work)](const std::stop_token& stop) noexcept {
    // not fmt::print, which throws if stderr cannot be written
    const auto say = [name](const char* what) { std::fprintf(stderr, "%s has ended: %s\n", name, what); };
    try {
      work(stop);
    } catch (const std::exception& exception) {
      say(exception.what());
    } catch (...) {
      say("unknown exception");
    }
  });
}

}  // namespace godobject::firmware
