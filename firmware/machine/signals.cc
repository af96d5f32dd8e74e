#include "firmware/machine/signals.h"

#include <csignal>
#include <initializer_list>

namespace godobject::firmware {
namespace {

void handle(std::initializer_list<int> signals, void (*handler)(int)) noexcept {
  struct sigaction action {};
  action.sa_handler = handler;
  sigemptyset(&action.sa_mask);
  for (const int signal : signals) ::sigaction(signal, &action, nullptr);
}

}  // namespace

RunRequests& signal_requests() noexcept {
  static constinit RunRequests requests;
  return requests;
}

void catch_end_signals() noexcept {
  handle({SIGTERM, SIGINT, SIGHUP}, [](int) { signal_requests().end.store(true, std::memory_order_relaxed); });
}

void catch_reset_signal() noexcept {
  handle({SIGUSR1}, [](int) { signal_requests().reset.store(true, std::memory_order_relaxed); });
}

void ignore_write_signals() noexcept { handle({SIGPIPE, SIGXFSZ}, SIG_IGN); }

}  // namespace godobject::firmware
