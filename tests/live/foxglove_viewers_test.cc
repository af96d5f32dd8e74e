#include "toolchain/live/foxglove_viewers.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <string>

#include <nlohmann/json.hpp>

#include "tests/mcap/bytes_reader.h"
#include "tests/viewer/boxes.h"

namespace godobject::live::foxglove_viewers_test {
namespace {

using nlohmann::json;

/// A data or time message.
struct Frame {
  int opcode = 0;
  std::uint32_t subscription = 0;
  std::uint64_t time_ns = 0;
  std::string payload;
};

Frame frame_of(const ServerMessage& message) {
  EXPECT_TRUE(message.binary);
  const std::string bytes = message.head + (message.body ? *message.body : "");
  mcap::BytesReader reader(bytes);
  Frame frame;
  frame.opcode = reader.number<std::uint8_t>();
  if (frame.opcode == 1) frame.subscription = reader.number<std::uint32_t>();
  frame.time_ns = reader.number<std::uint64_t>();
  frame.payload = bytes.substr(reader.at());
  return frame;
}

class FoxgloveViewersTest : public testing::Test {
 protected:
  FoxgloveViewersTest() {
    placement_.device.model.joint_count = 2;
    placement_.mapping.H_WR.rotation = exp_rotation(Vector3(0.0, 0.0, 0.5 * 3.14159265358979323846));
  }

  /// Returns the channel of a topic.
  std::uint64_t channel(const std::string& topic) {
    const json advertise = json::parse(viewers_.joined(99).at(1).head);
    for (const json& entry : advertise["channels"]) {
      if (entry["topic"] == topic) return entry["id"];
    }
    ADD_FAILURE() << topic;
    return 0;
  }

  void subscribe(ViewerNumber viewer, std::uint32_t id, const std::string& topic) {
    const json message{{"op", "subscribe"},
                       {"subscriptions", json::array({json{{"id", id}, {"channelId", channel(topic)}}})}};
    EXPECT_TRUE(viewers_.received(viewer, message.dump(), false)->empty()) << message;
  }

  /// Returns the warning that a message gets; empty: none.
  std::string warning(const std::string& message, bool binary = false) {
    const auto answers = viewers_.received(1, message, binary);
    EXPECT_TRUE(answers.has_value());
    if (answers->empty()) return "";
    const json status = json::parse(answers->at(0).head);
    EXPECT_EQ(answers->size(), 1u);
    EXPECT_FALSE(answers->at(0).binary);
    EXPECT_EQ(status["op"], "status");
    EXPECT_EQ(status["level"], 1);
    return status["message"];
  }

  /// Shows a cycle at a time [s] and returns the messages for a viewer.
  std::vector<Frame> frames(ViewerNumber viewer, double t) {
    sample_.t = t;
    viewers_.show(sample_);
    std::vector<Frame> frames;
    for (const ServerMessage& message : viewers_.state(viewer)) frames.push_back(frame_of(message));
    return frames;
  }

  const viewer::SceneBodies bodies_{viewer::box(Vector3(0.2, 0.2, 0.01)), viewer::box(Vector3(0.03, 0.03, 0.03))};
  firmware::Placement placement_;
  FoxgloveViewers viewers_{bodies_, 2, 20.0, &placement_};
  LiveSample sample_;
};

TEST_F(FoxgloveViewersTest, GreetsWithItsChannels) {
  const ServerMessages first = viewers_.joined(1);
  ASSERT_EQ(first.size(), 2u);
  const json info = json::parse(first[0].head);
  EXPECT_EQ(info["op"], "serverInfo");
  EXPECT_EQ(info["capabilities"], json::array({"time"}));
  const json advertise = json::parse(first[1].head);
  EXPECT_EQ(advertise["op"], "advertise");
  std::set<std::string> topics;
  std::set<int> ids;
  for (const json& channel : advertise["channels"]) {
    topics.insert(channel["topic"].get<std::string>());
    ids.insert(channel["id"].get<int>());
    EXPECT_EQ(channel["encoding"], "cdr");
    EXPECT_EQ(channel["schemaEncoding"], "ros2msg");
    EXPECT_FALSE(channel["schema"].get<std::string>().empty());
  }
  EXPECT_EQ(topics, (std::set<std::string>{"/bodies", "/controller", "/cycle", "/force_arrow", "/joint_states", "/tf",
                                           "/tf_static", "/wrench"}));
  EXPECT_EQ(ids.size(), 8u);
}

TEST_F(FoxgloveViewersTest, SendsTheTimeAndWhatAViewerHasSubscribedTo) {
  viewers_.joined(1);
  viewers_.joined(2);
  EXPECT_TRUE(viewers_.state(1).empty()) << "before the first cycle";
  subscribe(1, 7, "/joint_states");
  sample_.q[1] = 0.25;
  sample_.qd[1] = 0.5;
  sample_.torque[1] = 3.0;
  const auto one = frames(1, 1.5);
  ASSERT_EQ(one.size(), 2u);
  EXPECT_EQ(one[0].opcode, 2);
  EXPECT_EQ(one[0].time_ns, 1'500'000'000u);
  EXPECT_EQ(one[1].opcode, 1);
  EXPECT_EQ(one[1].subscription, 7u);
  EXPECT_EQ(one[1].time_ns, 1'500'000'000u);
  mcap::CdrReader joints(one[1].payload);
  EXPECT_EQ(joints.number<std::int32_t>(), 1);
  EXPECT_EQ(joints.number<std::uint32_t>(), 500'000'000u);
  EXPECT_EQ(joints.text(), "");
  ASSERT_EQ(joints.number<std::uint32_t>(), 2u);
  EXPECT_EQ(joints.text(), "joint1");
  EXPECT_EQ(joints.text(), "joint2");
  for (const double second : {0.25, 0.5, 3.0}) {
    ASSERT_EQ(joints.number<std::uint32_t>(), 2u);
    EXPECT_EQ(joints.real(), 0.0);
    EXPECT_EQ(joints.real(), second);
  }
  EXPECT_TRUE(joints.at_end());
  EXPECT_EQ(frames(2, 1.6).size(), 1u) << "the other viewer gets the time alone";
}

TEST_F(FoxgloveViewersTest, TurnsTheWrenchFromTheRoomIntoTheScene) {
  viewers_.joined(1);
  subscribe(1, 0, "/wrench");
  sample_.wrench_R = {Vector3(2.0, 0.0, 0.0), Vector3(0.0, 3.0, 0.0)};
  const auto all = frames(1, 1.0);
  ASSERT_EQ(all.size(), 2u);
  mcap::CdrReader wrench(all[1].payload);
  wrench.number<std::uint32_t>();
  wrench.number<std::uint32_t>();
  EXPECT_EQ(wrench.text(), "device_centre");
  for (const double component : {0.0, 2.0, 0.0, -3.0, 0.0, 0.0}) EXPECT_NEAR(wrench.real(), component, 1e-12);
}

TEST_F(FoxgloveViewersTest, SendsTheBodiesOnceForEachSubscription) {
  viewers_.joined(1);
  viewers_.joined(2);
  subscribe(1, 3, "/bodies");
  subscribe(1, 4, "/tf_static");
  EXPECT_EQ(frames(1, 1.0).size(), 3u);
  EXPECT_EQ(frames(1, 1.1).size(), 1u);
  subscribe(2, 3, "/bodies");
  const auto later = frames(2, 1.2);
  ASSERT_EQ(later.size(), 2u);
  EXPECT_EQ(later[1].time_ns, 1'200'000'000u);
  EXPECT_GT(later[1].payload.size(), 3u * 36u * 24u);
  EXPECT_EQ(warning(R"({"op":"unsubscribe","subscriptionIds":[3]})"), "");
  subscribe(1, 3, "/bodies");
  EXPECT_EQ(frames(1, 1.3).size(), 2u) << "a new subscription gets them again";
}

TEST_F(FoxgloveViewersTest, EndsASubscription) {
  viewers_.joined(1);
  subscribe(1, 3, "/tf");
  subscribe(1, 4, "/wrench");
  EXPECT_EQ(warning(R"({"op":"unsubscribe","subscriptionIds":[3]})"), "");
  const auto rest = frames(1, 1.0);
  ASSERT_EQ(rest.size(), 2u);
  EXPECT_EQ(rest[1].subscription, 4u);
  viewers_.left(1);
  viewers_.joined(1);
  EXPECT_EQ(frames(1, 1.1).size(), 1u);
}

TEST_F(FoxgloveViewersTest, WarnsOfMessagesThatItDoesNotTake) {
  viewers_.joined(1);
  for (const char* message :
       {"", "x", "{", "[]", "7", "null", "{}", R"({"op":7})", R"({"op":"subscribe"})",
        R"({"op":"subscribe","subscriptions":7})", R"({"op":"unsubscribe","subscriptionIds":{}})",
        R"({"op":"advertise","channels":[]})", R"({"op":"setParameters","parameters":[]})",
        R"({"type":"hand","pose":[0,0,0,1,0,0,0]})", R"({"type":"set","stiffness":1})", R"({"type":"reset"})"}) {
    EXPECT_NE(warning(message).find("must be"), std::string::npos) << message;
  }
  for (const char* entry :
       {"7", "{}", R"({"id":-1,"channelId":1})", R"({"id":4294967296,"channelId":1})", R"({"id":1.5,"channelId":1})",
        R"({"id":"1","channelId":1})", R"({"id":1})", R"({"id":1,"channelId":0})", R"({"id":1,"channelId":9})",
        R"({"id":1,"channelId":18446744073709551615})", R"({"id":1,"channelId":[1]})"}) {
    EXPECT_NE(warning(std::string(R"({"op":"subscribe","subscriptions":[)") + entry + "]}"), "") << entry;
  }
  EXPECT_NE(warning(R"({"op":"unsubscribe","subscriptionIds":[5]})"), "");
  EXPECT_NE(warning(R"({"op":"unsubscribe","subscriptionIds":["a"]})"), "");
  EXPECT_NE(warning("\1\0\0\0\0", true), "");
  EXPECT_NE(warning(std::string(4096, '[')), "");
  EXPECT_EQ(frames(1, 1.0).size(), 1u);
}

TEST_F(FoxgloveViewersTest, TakesEachNumberAndEachChannelOnce) {
  viewers_.joined(1);
  const std::string same_id =
      R"({"op":"subscribe","subscriptions":[{"id":4294967295,"channelId":1},{"id":4294967295,"channelId":2}]})";
  EXPECT_NE(warning(same_id).find("this \"id\""), std::string::npos);
  const std::string same_channel =
      R"({"op":"subscribe","subscriptions":[{"id":2,"channelId":1},{"id":3,"channelId":4}]})";
  EXPECT_NE(warning(same_channel).find("this channel"), std::string::npos);
  EXPECT_EQ(frames(1, 1.0).size(), 3u) << "those that are right hold";
}

TEST_F(FoxgloveViewersTest, KeepsTheTimeWhenARunBeginsAgain) {
  viewers_.joined(1);
  EXPECT_EQ(frames(1, 5.0)[0].time_ns, 5'000'000'000u);
  EXPECT_EQ(frames(1, 1.0)[0].time_ns, 5'000'000'000u);
  EXPECT_EQ(frames(1, 1.25)[0].time_ns, 5'250'000'000u);
  EXPECT_EQ(frames(1, 0.0)[0].time_ns, 5'250'000'000u);
}

TEST_F(FoxgloveViewersTest, ShowsNoCycleThatAMessageCannotHold) {
  viewers_.joined(1);
  EXPECT_TRUE(frames(1, 2147483648.0).empty());
  EXPECT_TRUE(frames(1, std::numeric_limits<double>::quiet_NaN()).empty());
  sample_.H_WD.translation.x() = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(frames(1, 1.0).empty());
  sample_.H_WD.translation.x() = 0.0;
  EXPECT_EQ(frames(1, 1.0).size(), 1u);
}

TEST_F(FoxgloveViewersTest, LeavesOutBodiesThatAreTooLarge) {
  viewer::SceneBodies large = bodies_;
  large.still.triangles.resize(mcap::kMaxTriangles + 1, {0, 1, 2});
  FoxgloveViewers viewers(large, 2, 20.0, &placement_);
  const json advertise = json::parse(viewers.joined(1).at(1).head);
  EXPECT_EQ(advertise["channels"].size(), 7u);
  EXPECT_EQ(advertise.dump().find("/bodies"), std::string::npos);
}

}  // namespace
}  // namespace godobject::live::foxglove_viewers_test
