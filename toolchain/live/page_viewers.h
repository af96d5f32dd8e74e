#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "hal/clock.h"
#include "toolchain/live/live_source.h"
#include "toolchain/live/request.h"
#include "toolchain/live/state_message.h"
#include "toolchain/live/viewer_protocol.h"

namespace godobject::live {

/// The pages that show a controller. One of them at a time has the hand.
class PageViewers final : public ViewerProtocol {
 public:
  /// Time after which the hand is free if the page that has it says nothing [ns]. A page repeats its request four times
  /// a second.
  static constexpr std::int64_t kPatience_ns = 2'000'000'000;

  /// `source` and `clock` outlive this object.
  PageViewers(LiveSource& source, hal::Clock& clock);

  void add(const LiveSample& sample) { message_.add(sample); }
  /// Forgets extremes that nobody has seen.
  void skip() { message_.skip(); }

  /// Makes the state for all pages, from the cycles since the last one. `viewers`: their number.
  void make_state(std::size_t viewers);

  /// The last state, so that a page is not empty while no cycles come.
  ServerMessages joined(ViewerNumber viewer) override;
  std::optional<ServerMessages> received(ViewerNumber viewer, std::string_view message, bool binary) override;
  ServerMessages state(ViewerNumber viewer) override;
  void left(ViewerNumber viewer) override;

 private:
  ServerMessages carry_out(ViewerNumber viewer, const Request& request);

  LiveSource& source_;
  hal::Clock& clock_;
  StateMessage message_;
  std::string text_;  // of the state, without the keys of each viewer
  std::size_t viewers_ = 0;
  ViewerNumber holder_ = 0;   // of the hand; 0: nobody
  std::int64_t held_ns_ = 0;  // the last request of the holder
};

}  // namespace godobject::live
