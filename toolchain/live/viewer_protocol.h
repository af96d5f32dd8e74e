#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace godobject::live {

/// The number of a viewer, the connection of one page or program: from 1, never used again.
using ViewerNumber = std::uint64_t;

/// A message to a viewer: `head`, then `body`, which messages to other viewers may share.
struct ServerMessage {
  std::string head;
  std::shared_ptr<const std::string> body = nullptr;  ///< null: empty
  bool binary = false;                                ///< else it is text
};

using ServerMessages = std::vector<ServerMessage>;

/// The messages of a web socket's protocol. LiveServer calls the functions on its thread; they must not throw.
class ViewerProtocol {
 public:
  virtual ~ViewerProtocol() = default;
  ViewerProtocol(const ViewerProtocol&) = delete;
  ViewerProtocol& operator=(const ViewerProtocol&) = delete;

  /// Returns the first messages to a viewer.
  virtual ServerMessages joined(ViewerNumber viewer) = 0;
  /// Returns the answers to a message; nullopt: the viewer is closed.
  virtual std::optional<ServerMessages> received(ViewerNumber viewer, std::string_view message, bool binary) = 0;
  /// Returns the present state for a viewer that has taken everything before.
  virtual ServerMessages state(ViewerNumber viewer) = 0;
  virtual void left(ViewerNumber viewer) = 0;

 protected:
  ViewerProtocol() = default;
};

}  // namespace godobject::live
