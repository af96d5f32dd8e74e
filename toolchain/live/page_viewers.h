#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "toolchain/live/live_source.h"
#include "toolchain/live/request.h"
#include "toolchain/live/state_message.h"
#include "toolchain/live/viewer_protocol.h"

namespace godobject::live {

/// The pages that show a controller. One of them at a time has the hand.
class PageViewers final : public ViewerProtocol {
 public:
  /// `source` outlives this object.
  explicit PageViewers(LiveSource& source);

  void add(const LiveSample& sample) { message_.add(sample); }

  /// Makes the state for all pages, from the cycles since the last one. `viewers`: their number.
  void make_state(std::size_t viewers);

  ServerMessages joined(ViewerNumber) override { return {}; }
  std::optional<ServerMessages> received(ViewerNumber viewer, std::string_view message, bool binary) override;
  ServerMessages state(ViewerNumber viewer) override;
  void left(ViewerNumber viewer) override;

 private:
  ServerMessages carry_out(ViewerNumber viewer, const Request& request);

  LiveSource& source_;
  StateMessage message_;
  std::string text_;  // of the state, without the keys of each viewer
  std::size_t viewers_ = 0;
  ViewerNumber holder_ = 0;  // of the hand; 0: nobody
};

}  // namespace godobject::live
