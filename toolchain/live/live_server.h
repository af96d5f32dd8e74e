#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "toolchain/live/viewer_protocol.h"

namespace godobject::live {

/// Serves one page, and web sockets to pages that are open and to programs that speak Foxglove's protocol. One thread;
/// no call waits for a viewer: whoever is slow misses states.
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

  /// The protocols, which outlive the server: `page` is `godobject-live`, `foxglove` is `foxglove.websocket.v1` or
  /// `foxglove.sdk.v1`, as the client asks for.
  struct Protocols {
    ViewerProtocol& page;
    ViewerProtocol& foxglove;
  };

  /// Opens the port. Throws command::Failure (kUnavailable) naming the address and a cure if it cannot.
  LiveServer(Setup setup, Protocols protocols);
  ~LiveServer();
  LiveServer(const LiveServer&) = delete;
  LiveServer& operator=(const LiveServer&) = delete;

  int port() const noexcept;
  std::size_t viewers() const noexcept;

  /// Serves until `tick`, which is called every `interval_us`, returns false. `tick` must not throw.
  void run(std::int64_t interval_us, const std::function<bool()>& tick);

  /// Sends the state of its protocol to every viewer that has taken all messages before. Others miss it.
  void publish();

 private:
  struct Connections;
  std::unique_ptr<Connections> connections_;
};

/// Returns 128 random bits of the system as text, for Setup::token.
std::string make_token();

}  // namespace godobject::live
