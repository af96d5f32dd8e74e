#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/configuration/controller_file.h"
#include "toolchain/live/live_sample.h"
#include "toolchain/live/viewer_protocol.h"
#include "toolchain/mcap/cycle_messages.h"

namespace godobject::live {

/// Viewers that speak Foxglove's protocol (https://github.com/foxglove/ws-protocol): their subscriptions to the topics
/// of godobject-mcap. They only look.
class FoxgloveViewers final : public ViewerProtocol {
 public:
  /// `bodies` and `placement` outlive this object. `placement`: as LiveSource::placement. `up_axis` and `force` as in
  /// mcap::CycleMessages. Bodies with more than mcap::kMaxTriangles triangles are not offered.
  FoxgloveViewers(const viewer::SceneBodies& bodies, int up_axis, double force, const firmware::Placement* placement);

  /// Takes the cycle that `state` shows. One whose poses are not finite, or whose time is not in 0 .. 2^31 s, is shown
  /// to nobody. The time of the messages never goes back: a run that begins again continues it.
  void show(const LiveSample& sample);

  ServerMessages joined(ViewerNumber viewer) override;
  std::optional<ServerMessages> received(ViewerNumber viewer, std::string_view message, bool binary) override;
  ServerMessages state(ViewerNumber viewer) override;
  void left(ViewerNumber viewer) override;

 private:
  using Bytes = std::shared_ptr<const std::string>;

  struct Subscription {
    const mcap::TopicInfo* topic = nullptr;
    bool served = false;  ///< has got a message
  };
  using Subscriptions = std::map<std::uint32_t, Subscription>;  // by the number that the viewer has chosen

  Bytes message_of(const mcap::TopicInfo& topic);
  Bytes make_latched(mcap::Topic topic) const;
  std::string subscribe(Subscriptions& subscriptions, std::int64_t id, std::int64_t channel) const;

  const firmware::Placement* placement_;
  const mcap::CycleMessages messages_;
  std::vector<mcap::TopicInfo> topics_;  ///< channel 1, 2, ...
  const std::string session_;
  std::map<mcap::Topic, Bytes> cycle_;    ///< the messages of the last cycle; empty: there is none
  std::map<mcap::Topic, Bytes> latched_;  ///< those that somebody has asked for
  double shift_ = 0.0;                    ///< of the messages' time from that of the controller [s]
  std::uint64_t time_ns_ = 0;             ///< of the last cycle
  std::map<ViewerNumber, Subscriptions> viewers_;
};

}  // namespace godobject::live
