#include "toolchain/live/foxglove_viewers.h"

#include <algorithm>
#include <limits>

#include <nlohmann/json.hpp>

#include "toolchain/live/live_server.h"
#include "toolchain/live/state_message.h"
#include "toolchain/mcap/little_endian.h"

namespace godobject::live {
namespace {

using mcap::Topic;
using mcap::TopicInfo;
using nlohmann::json;

constexpr std::int64_t kNoNumber = -1;  // in place of a number from 0 to 2^32 - 1

ServerMessage json_message(const json& message) { return {message.dump()}; }

ServerMessages warning(const std::string& text) {
  return {json_message({{"op", "status"}, {"level", 1}, {"message", text}})};
}

ServerMessage time_message(std::uint64_t time_ns) {
  std::string bytes(1, '\2');
  mcap::append_little_endian(bytes, time_ns);
  return {.head = bytes, .binary = true};
}

/// The bytes of a data message before its payload.
std::string data_head(std::uint32_t subscription, std::uint64_t time_ns) {
  std::string bytes(1, '\1');
  mcap::append_little_endian(bytes, subscription);
  mcap::append_little_endian(bytes, time_ns);
  return bytes;
}

json channel_entry(std::size_t id, const TopicInfo& topic) {
  return {{"id", id},
          {"topic", topic.name},
          {"encoding", "cdr"},
          {"schemaName", topic.schema_name()},
          {"schema", topic.schema()},
          {"schemaEncoding", "ros2msg"}};
}

std::vector<TopicInfo> offered_topics(const viewer::SceneBodies& bodies) {
  std::vector<TopicInfo> topics = mcap::controller_topics();
  const std::size_t most = std::max(bodies.still.triangles.size(), bodies.moving.triangles.size());
  if (most > mcap::kMaxTriangles) {
    std::erase_if(topics, [](const TopicInfo& info) { return info.topic == Topic::kBodies; });
  }
  return topics;
}

std::int64_t number_of(const json& value) {
  if (!value.is_number_unsigned()) return kNoNumber;
  const auto number = value.get<std::uint64_t>();
  return number <= std::numeric_limits<std::uint32_t>::max() ? static_cast<std::int64_t>(number) : kNoNumber;
}

std::int64_t number_at(const json& object, const char* key) {
  return object.is_object() && object.contains(key) ? number_of(object[key]) : kNoNumber;
}

/// The elements of an array of a message; nullptr if there is none.
const json* array_at(const json& message, const char* key) {
  const auto found = message.find(key);
  return found != message.end() && found->is_array() ? &*found : nullptr;
}

figures::TelemetryRow row_of(const LiveSample& sample, const firmware::Placement* placement) {
  const int joint_count = placement != nullptr ? placement->device.model.joint_count : 0;
  const auto values = [&](const JointVector& joints) {
    return std::vector<double>(joints.data(), joints.data() + joint_count);
  };
  figures::TelemetryRow row;
  row.cycle.H_WS = sample.H_WS;
  row.cycle.wrench = wrench_in_scene(sample, placement);
  row.cycle.depth = sample.depth;
  row.cycle.contacts = sample.contacts;
  row.cycle.status = sample.outcome;
  row.mode = sample.mode;
  row.fault = sample.fault_number;
  row.share = sample.share;
  row.position = values(sample.q);
  row.velocity = values(sample.qd);
  row.torque = values(sample.torque);
  row.late = sample.late;
  row.compute = sample.computed;
  row.absorbed = sample.absorbed;
  return row;
}

}  // namespace

FoxgloveViewers::FoxgloveViewers(const viewer::SceneBodies& bodies, int up_axis, double force,
                                 const firmware::Placement* placement)
    : placement_(placement),
      messages_(bodies, up_axis, force),
      topics_(offered_topics(bodies)),
      session_(make_token()) {}

void FoxgloveViewers::show(const LiveSample& sample) {
  cycle_.clear();
  shift_ = std::max(shift_, 1e-9 * static_cast<double>(time_ns_) - sample.t);
  const double t = sample.t + shift_;
  const bool fits = t >= 0.0 && t < std::numeric_limits<std::int32_t>::max();
  if (!fits || !sample.H_WD.is_finite() || !sample.H_WS.is_finite()) return;
  time_ns_ = mcap::nanoseconds(t);
  const figures::TelemetryRow row = row_of(sample, placement_);
  const auto add = [&](std::vector<mcap::TopicMessage> messages) {
    for (auto& [topic, bytes] : messages) cycle_[topic] = std::make_shared<const std::string>(std::move(bytes));
  };
  add(messages_.cycle(time_ns_, row.cycle, sample.H_WD));
  add(mcap::CycleMessages::controller(time_ns_, row));
}

ServerMessages FoxgloveViewers::joined(ViewerNumber viewer) {
  viewers_[viewer] = {};
  json channels = json::array();
  for (const TopicInfo& topic : topics_) channels.push_back(channel_entry(channels.size() + 1, topic));
  return {json_message({{"op", "serverInfo"},
                        {"name", "godobject-live"},
                        {"capabilities", json::array({"time"})},
                        {"sessionId", session_}}),
          json_message({{"op", "advertise"}, {"channels", channels}})};
}

/// Adds a subscription. Returns why it does not; empty: done.
std::string FoxgloveViewers::subscribe(Subscriptions& subscriptions, std::int64_t id, std::int64_t channel) const {
  if (id == kNoNumber) return "the \"id\" of a subscription must be a number from 0 to 4294967295";
  if (channel < 1 || channel > static_cast<std::int64_t>(topics_.size())) return "there is no such channel";
  const TopicInfo* const topic = &topics_[static_cast<std::size_t>(channel - 1)];
  for (const auto& [other_id, other] : subscriptions) {
    if (other_id == id) return "another subscription has this \"id\"; unsubscribe that one first";
    if (other.topic == topic) return "there is a subscription to this channel; unsubscribe that one first";
  }
  subscriptions[static_cast<std::uint32_t>(id)] = {topic};
  return "";
}

std::optional<ServerMessages> FoxgloveViewers::received(ViewerNumber viewer, std::string_view message, bool binary) {
  if (binary) return warning("this server takes no data");
  const json parsed = json::parse(message, nullptr, false);
  if (!parsed.is_object()) return warning("a message must be a JSON object");
  Subscriptions& subscriptions = viewers_[viewer];
  const json op = parsed.value("op", json());
  std::string why_not;
  if (const json* list = op == "subscribe" ? array_at(parsed, "subscriptions") : nullptr) {
    for (const json& entry : *list) {
      const std::string refused = subscribe(subscriptions, number_at(entry, "id"), number_at(entry, "channelId"));
      if (!refused.empty()) why_not = refused;
    }
  } else if (const json* ids = op == "unsubscribe" ? array_at(parsed, "subscriptionIds") : nullptr) {
    for (const json& id : *ids) {
      const std::int64_t number = number_of(id);
      const bool known = number != kNoNumber && subscriptions.erase(static_cast<std::uint32_t>(number)) > 0;
      if (!known) why_not = "there is no subscription with this id";
    }
  } else {
    why_not = "a message must be \"subscribe\" with \"subscriptions\", or \"unsubscribe\" with \"subscriptionIds\"";
  }
  return why_not.empty() ? ServerMessages{} : warning(why_not);
}

FoxgloveViewers::Bytes FoxgloveViewers::make_latched(Topic topic) const {
  return std::make_shared<const std::string>(
      (topic == Topic::kBodies ? messages_.bodies(time_ns_) : messages_.upright(time_ns_)).bytes);
}

FoxgloveViewers::Bytes FoxgloveViewers::message_of(const TopicInfo& topic) {
  if (!topic.latched) return cycle_.at(topic.topic);
  Bytes& bytes = latched_[topic.topic];
  if (!bytes) bytes = make_latched(topic.topic);
  return bytes;
}

ServerMessages FoxgloveViewers::state(ViewerNumber viewer) {
  if (cycle_.empty()) return {};
  ServerMessages messages{time_message(time_ns_)};
  for (auto& [id, subscription] : viewers_[viewer]) {
    if (subscription.served && subscription.topic->latched) continue;
    messages.push_back({data_head(id, time_ns_), message_of(*subscription.topic), true});
    subscription.served = true;
  }
  return messages;
}

void FoxgloveViewers::left(ViewerNumber viewer) { viewers_.erase(viewer); }

}  // namespace godobject::live
