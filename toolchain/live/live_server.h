#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace godobject::live {

/// The number of a viewer, the connection of one page: from 1, never used again.
using ViewerNumber = std::uint64_t;

/// Serves one page, and a web socket to each page that is open. One thread; no call waits for a viewer: whoever is slow
/// misses states.
class LiveServer {
 public:
  static constexpr std::size_t kMostViewers = 8;

  struct Setup {
    std::string address = "127.0.0.1";     ///< of the interface; 0.0.0.0: all
    int port = 0;                          ///< 0: any free one
    std::string page;                      ///< the document; `@HOST@` in it becomes the host that the browser asked for
    std::string token;                     ///< that every request must give
    std::int64_t stalled_us = 20'000'000;  ///< a viewer that takes no message for this long is closed [us]
  };

  /// Calls to the owner. `received` returns an answer (JSON) for that viewer; empty: none.
  struct Handlers {
    std::function<std::string(ViewerNumber, std::string_view message)> received;
    std::function<void(ViewerNumber)> left;
  };

  /// Opens the port. Throws command::Failure (kUnavailable) naming the address and a cure if it cannot.
  LiveServer(Setup setup, Handlers handlers);
  ~LiveServer();
  LiveServer(const LiveServer&) = delete;
  LiveServer& operator=(const LiveServer&) = delete;

  int port() const noexcept;
  std::size_t viewers() const noexcept;

  /// Serves until `tick`, which is called every `interval_us`, returns false. `tick` and the handlers must not throw.
  void run(std::int64_t interval_us, const std::function<bool()>& tick);

  /// Sends a state to every viewer that has taken the one before, and else in its place. `text_of` returns the message
  /// for a viewer.
  void publish(const std::function<std::string(ViewerNumber)>& text_of);

 private:
  struct Connections;
  std::unique_ptr<Connections> connections_;
};

/// Returns 128 random bits of the system as text, for Setup::token.
std::string make_token();

}  // namespace godobject::live
