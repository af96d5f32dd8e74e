#include "toolchain/mcap/mcap_writer.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "tests/mcap/mcap_reader.h"
#include "tests/mcap/written_file.h"

namespace godobject::mcap {
namespace {

using Message = McapReader::Message;

/// Returns a file with some messages on two of three topics.
std::string small_file() {
  return written_file([](McapWriter& writer) {
    const auto schema = writer.add_schema("a_msgs/msg/A", "int32 a\n");
    const auto first = writer.add_channel("/first", schema, false);
    writer.add_channel("/unused", schema, true);
    const auto third = writer.add_channel("/third", writer.add_schema("b_msgs/msg/B", "int32 b\n"), false);
    writer.write(first, 5, "one");
    writer.write(third, 5, "two");
    writer.write(first, 6, "");
    writer.finish();
  });
}

TEST(McapWriter, WritesWhatTheSpecificationDemands) {
  const McapReader file(small_file());
  EXPECT_EQ(file.profile, "ros2");
  EXPECT_EQ(file.library.substr(0, 15), "godobject-mcap ");
  ASSERT_EQ(file.schemas.size(), 2u);
  EXPECT_EQ(file.schemas.at(2).name, "b_msgs/msg/B");
  EXPECT_EQ(file.schemas.at(2).encoding, "ros2msg");
  EXPECT_EQ(file.schemas.at(2).definition, "int32 b\n");
  ASSERT_EQ(file.channels.size(), 3u);
  EXPECT_EQ(file.channels.at(3).topic, "/third");
  EXPECT_EQ(file.channels.at(3).schema, 2);
  EXPECT_EQ(file.channels.at(3).encoding, "cdr");
  EXPECT_NE(file.channels.at(1).metadata.at("offered_qos_profiles").find("durability: 2"), std::string::npos);
  EXPECT_NE(file.channels.at(2).metadata.at("offered_qos_profiles").find("durability: 1"), std::string::npos);
}

TEST(McapWriter, KeepsTheMessagesInTheirOrder) {
  const McapReader file(small_file());
  ASSERT_EQ(file.messages.size(), 3u);
  const std::vector<Message> expected{{1, 0, 5, 5, "one"}, {3, 0, 5, 5, "two"}, {1, 1, 6, 6, ""}};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(file.messages[i].channel, expected[i].channel);
    EXPECT_EQ(file.messages[i].sequence, expected[i].sequence);
    EXPECT_EQ(file.messages[i].log_ns, expected[i].log_ns);
    EXPECT_EQ(file.messages[i].publish_ns, expected[i].publish_ns);
    EXPECT_EQ(file.messages[i].data, expected[i].data);
  }
}

TEST(McapWriter, CountsItsBytesAndMessages) {
  std::uint64_t size = 0, messages = 0;
  const std::string bytes = written_file([&](McapWriter& writer) {
    const auto channel = writer.add_channel("/a", writer.add_schema("a/msg/A", "int32 a\n"), false);
    for (std::uint64_t i = 0; i < 10; ++i) writer.write(channel, i, "data");
    writer.finish();
    size = writer.size();
    messages = writer.messages();
  });
  EXPECT_EQ(size, bytes.size());
  EXPECT_EQ(messages, 10u);
}

TEST(McapWriter, WritesAFileWithoutMessages) {
  const McapReader empty(written_file([](McapWriter& writer) { writer.finish(); }));
  EXPECT_TRUE(empty.messages.empty());
  const McapReader topics(written_file([](McapWriter& writer) {
    writer.add_channel("/a", writer.add_schema("a/msg/A", "int32 a\n"), false);
    writer.finish();
  }));
  EXPECT_EQ(topics.channels.size(), 1u);
  EXPECT_EQ(topics.chunks, 1u);
}

TEST(McapWriter, BoundsItsChunks) {
  std::mt19937 random(4);
  std::vector<Message> expected;
  const std::string bytes = written_file([&](McapWriter& writer) {
    const auto schema = writer.add_schema("a/msg/A", "int32 a\n");
    for (int i = 0; i < 5; ++i) writer.add_channel("/topic" + std::to_string(i), schema, false);
    std::vector<std::uint32_t> sequence(5);
    for (std::uint64_t time_ns = 0; time_ns < 6000; time_ns += random() % 3) {
      const std::size_t topic = random() % 5;
      const std::string data(random() % 1200, static_cast<char>(random()));
      writer.write(static_cast<std::uint16_t>(topic + 1), time_ns, data);
      expected.push_back({static_cast<std::uint16_t>(topic + 1), sequence[topic]++, time_ns, time_ns, data});
    }
    writer.write(1, 6000, std::string(3 * McapWriter::kChunkSize, 'x'));  // more than a chunk
    expected.push_back({1, sequence[0]++, 6000, 6000, std::string(3 * McapWriter::kChunkSize, 'x')});
    writer.finish();
  });
  const McapReader file(bytes);
  EXPECT_GE(file.chunks, 4u);
  ASSERT_EQ(file.messages.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    ASSERT_EQ(file.messages[i].channel, expected[i].channel);
    ASSERT_EQ(file.messages[i].sequence, expected[i].sequence);
    ASSERT_EQ(file.messages[i].log_ns, expected[i].log_ns);
    ASSERT_TRUE(file.messages[i].data == expected[i].data) << i;
  }
}

TEST(McapReader, FindsAnyDamagedByte) {
  // the test's own reader, which stands for all others, must see every damage: no byte is left unchecked
  const std::string good = small_file();
  std::size_t unseen = 0;
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 0x10);
    try {
      const McapReader file(bad);
      ++unseen;
    } catch (const std::exception&) {
    }
  }
  EXPECT_EQ(unseen, 0u);
}

}  // namespace
}  // namespace godobject::mcap
