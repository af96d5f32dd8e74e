#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "tests/mcap/bytes_reader.h"

namespace godobject::mcap {

/// Returns the CRC32 of bytes: a table made bit by bit, then byte by byte.
inline std::uint32_t crc32_of(std::string_view bytes) {
  static const std::array<std::uint32_t, 256> table = [] {
    std::array<std::uint32_t, 256> remainders{};
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
      std::uint32_t crc = byte;
      for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc % 2 == 1 ? 0xedb88320u : 0u);
      remainders[byte] = crc;
    }
    return remainders;
  }();
  std::uint32_t crc = ~0u;
  for (const char byte : bytes) crc = crc >> 8 ^ table[(crc ^ static_cast<std::uint8_t>(byte)) & 0xffu];
  return ~crc;
}

/// Reads an MCAP file from begin to end, and checks what https://mcap.dev/spec demands of it: the order of the records,
/// their lengths, the checksums, and that each index leads to what it indexes. Throws std::runtime_error naming the
/// first violation. Written from the specification, without the code under test.
class McapReader {
 public:
  struct Message {
    std::uint16_t channel;
    std::uint32_t sequence;
    std::uint64_t log_ns, publish_ns;
    std::string data;
  };
  struct Schema {
    std::string name, encoding, definition;
    bool operator==(const Schema&) const = default;
  };
  struct Channel {
    std::uint16_t schema;
    std::string topic, encoding;
    std::map<std::string, std::string> metadata;
    bool operator==(const Channel&) const = default;
  };

  explicit McapReader(std::string_view file) : file_(file) {
    require(file.starts_with(kMagic) && file.ends_with(kMagic) && file.size() > 2 * kMagic.size(), "magic");
    std::size_t at = kMagic.size();
    Record record = record_at(file_, at);
    require(record.opcode == 0x01, "begins without a header");
    BytesReader header(record.content);
    profile = header.counted();
    library = header.counted();
    at = record.end;
    read_data(at);
    read_summary(at);
  }

  std::vector<const Message*> on(const std::string& topic) const {
    std::vector<const Message*> found;
    for (const Message& message : messages) {
      if (channels.at(message.channel).topic == topic) found.push_back(&message);
    }
    return found;
  }

  std::string profile, library;
  std::map<std::uint16_t, Schema> schemas;
  std::map<std::uint16_t, Channel> channels;
  std::vector<Message> messages;
  std::size_t chunks = 0;

 private:
  static constexpr std::string_view kMagic = "\x89MCAP0\r\n";

  struct Record {
    std::uint8_t opcode;
    std::string_view content;
    std::size_t begin, end;
  };
  struct Chunk {
    std::uint64_t first_ns, last_ns;
    std::size_t begin, length, records_size;
    std::map<std::uint16_t, std::uint64_t> indexes;  // their offsets in the file
    std::size_t indexes_length = 0;
  };

  static void require(bool holds, const std::string& what) {
    if (!holds) throw std::runtime_error("not a valid record: " + what);
  }

  static Record record_at(std::string_view bytes, std::size_t at) {
    BytesReader reader(bytes.substr(at));
    const auto opcode = reader.number<std::uint8_t>();
    const std::string_view content = reader.take(reader.number<std::uint64_t>());
    return {opcode, content, at, at + reader.at()};
  }

  void read_schema(std::string_view content) {
    BytesReader reader(content);
    const auto id = reader.number<std::uint16_t>();
    Schema schema{std::string(reader.counted()), std::string(reader.counted()), std::string(reader.counted())};
    require(id != 0 && reader.at_end(), "schema");
    require(schemas.emplace(id, schema).first->second == schema, "two schemas of one id");
  }

  void read_channel(std::string_view content) {
    BytesReader reader(content);
    const auto id = reader.number<std::uint16_t>();
    Channel channel{};
    channel.schema = reader.number<std::uint16_t>();
    channel.topic = reader.counted();
    channel.encoding = reader.counted();
    BytesReader metadata(reader.counted());
    while (!metadata.at_end()) {
      const std::string key(metadata.counted());
      channel.metadata[key] = metadata.counted();
    }
    require(reader.at_end() && schemas.contains(channel.schema), "channel");
    require(channels.emplace(id, channel).first->second == channel, "two channels of one id");
  }

  void read_message(std::string_view content) {
    BytesReader reader(content);
    Message message{};
    message.channel = reader.number<std::uint16_t>();
    message.sequence = reader.number<std::uint32_t>();
    message.log_ns = reader.number<std::uint64_t>();
    message.publish_ns = reader.number<std::uint64_t>();
    message.data = reader.take(content.size() - reader.at());
    require(channels.contains(message.channel), "message before its channel");
    messages.push_back(message);
  }

  void read_data(std::size_t& at) {
    for (;;) {
      const Record record = record_at(file_, at);
      at = record.end;
      if (record.opcode == 0x0f) {
        require(BytesReader(record.content).number<std::uint32_t>() == crc32_of(file_.substr(0, record.begin)),
                "checksum of the data");
        return;
      }
      require(record.opcode == 0x06, "a record outside of chunks");
      read_chunk(record);
      while (static_cast<std::uint8_t>(file_[at]) == 0x07) {
        const Record index = record_at(file_, at);
        read_message_index(index);
        at = index.end;
      }
      std::set<std::uint16_t> indexed;
      for (const auto& [channel, offset] : chunks_.back().indexes) indexed.insert(channel);
      require(indexed == in_chunk_ && indexed_ == expected_, "a message of a chunk has no index");
    }
  }

  void read_chunk(const Record& record) {
    BytesReader reader(record.content);
    Chunk chunk{};
    chunk.first_ns = reader.number<std::uint64_t>();
    chunk.last_ns = reader.number<std::uint64_t>();
    chunk.records_size = reader.number<std::uint64_t>();
    const auto crc = reader.number<std::uint32_t>();
    require(reader.counted().empty(), "compression");
    records_ = reader.take(reader.number<std::uint64_t>());
    require(reader.at_end() && records_.size() == chunk.records_size, "size of a chunk");
    require(crc32_of(records_) == crc, "checksum of a chunk");
    chunk.begin = record.begin;
    chunk.length = record.end - record.begin;
    in_chunk_.clear();
    const std::size_t before = messages.size();
    for (std::size_t at = 0; at < records_.size();) {
      const Record inner = record_at(records_, at);
      if (inner.opcode == 0x03) read_schema(inner.content);
      if (inner.opcode == 0x04) read_channel(inner.content);
      if (inner.opcode == 0x05) {
        read_message(inner.content);
        in_chunk_.insert(messages.back().channel);
        place_of_[{chunks_.size(), at}] = messages.size() - 1;
      }
      require(inner.opcode >= 0x03 && inner.opcode <= 0x05, "a record in a chunk");
      at = inner.end;
    }
    std::uint64_t first = messages.size() > before ? messages[before].log_ns : 0, last = first;
    for (std::size_t i = before; i < messages.size(); ++i) {
      first = std::min(first, messages[i].log_ns);
      last = std::max(last, messages[i].log_ns);
    }
    require(chunk.first_ns == first && chunk.last_ns == last, "times of a chunk");
    chunks_.push_back(chunk);
    chunks = chunks_.size();
    expected_ = messages.size() - before;
    indexed_ = 0;
  }

  void read_message_index(const Record& record) {
    BytesReader reader(record.content);
    const auto channel = reader.number<std::uint16_t>();
    BytesReader places(reader.counted());
    while (!places.at_end()) {
      const auto log_ns = places.number<std::uint64_t>();
      const auto found = place_of_.find({chunks_.size() - 1, places.number<std::uint64_t>()});
      require(found != place_of_.end(), "an index leads to no message");
      const Message& message = messages[found->second];
      require(message.channel == channel && message.log_ns == log_ns, "an index leads to another message");
      ++indexed_;
    }
    require(reader.at_end() && chunks_.back().indexes.emplace(channel, record.begin).second, "message index");
    chunks_.back().indexes_length += record.end - record.begin;
  }

  void read_summary(std::size_t at) {
    const std::size_t summary_start = at;
    const auto data_schemas = schemas;
    const auto data_channels = channels;
    std::map<std::uint8_t, std::pair<std::size_t, std::size_t>> groups;  // opcode -> begin, end
    std::size_t chunk_indexes = 0, copies = 0, statistics = 0;
    std::uint8_t before = 0;
    Record record = record_at(file_, at);
    for (; record.opcode != 0x0e && record.opcode != 0x02; record = record_at(file_, at)) {
      require(record.opcode == before || !groups.contains(record.opcode), "the summary is not grouped");
      groups.try_emplace(record.opcode, record.begin, 0).first->second.second = record.end;
      if (record.opcode == 0x03) read_schema(record.content);
      if (record.opcode == 0x04) read_channel(record.content);
      copies += record.opcode == 0x03 || record.opcode == 0x04;
      if (record.opcode == 0x08) check_chunk_index(record.content, chunks_.at(chunk_indexes++));
      if (record.opcode == 0x0b) {
        check_statistics(record.content, copies);
        ++statistics;
      }
      before = record.opcode;
      at = record.end;
    }
    require(schemas == data_schemas && channels == data_channels, "the summary has what the data lacks");
    require(copies == schemas.size() + channels.size(), "schemas and channels of the summary");
    require(chunk_indexes == chunks_.size() && statistics == 1, "chunk indexes and statistics");
    const std::size_t offsets_start = at;
    for (; record.opcode == 0x0e; record = record_at(file_, at)) {
      BytesReader reader(record.content);
      const auto [begin, end] = groups.at(reader.number<std::uint8_t>());
      require(reader.number<std::uint64_t>() == begin && reader.number<std::uint64_t>() == end - begin,
              "summary offset");
      at = record.end;
    }
    check_footer(record, summary_start, offsets_start);
  }

  void check_footer(const Record& record, std::size_t summary_start, std::size_t offsets_start) const {
    require(record.opcode == 0x02 && record.content.size() == 20, "footer");
    require(record.end + kMagic.size() == file_.size(), "something follows the footer");
    BytesReader reader(record.content);
    require(reader.number<std::uint64_t>() == summary_start, "begin of the summary");
    require(reader.number<std::uint64_t>() == offsets_start, "begin of the summary offsets");
    require(reader.number<std::uint32_t>() == crc32_of(file_.substr(summary_start, record.end - 4 - summary_start)),
            "checksum of the summary");
  }

  void check_chunk_index(std::string_view content, const Chunk& chunk) const {
    BytesReader reader(content);
    require(reader.number<std::uint64_t>() == chunk.first_ns && reader.number<std::uint64_t>() == chunk.last_ns,
            "times of a chunk index");
    require(reader.number<std::uint64_t>() == chunk.begin && reader.number<std::uint64_t>() == chunk.length,
            "place of a chunk");
    std::map<std::uint16_t, std::uint64_t> indexes;
    BytesReader map(reader.counted());
    while (!map.at_end()) {
      const auto channel = map.number<std::uint16_t>();
      indexes[channel] = map.number<std::uint64_t>();
    }
    require(indexes == chunk.indexes, "places of message indexes");
    require(reader.number<std::uint64_t>() == chunk.indexes_length, "length of message indexes");
    require(reader.counted().empty(), "compression of a chunk index");
    require(reader.number<std::uint64_t>() == chunk.records_size &&
                reader.number<std::uint64_t>() == chunk.records_size && reader.at_end(),
            "sizes of a chunk index");
  }

  void check_statistics(std::string_view content, std::size_t copies) const {
    BytesReader reader(content);
    require(copies == schemas.size() + channels.size(), "statistics before the channels");
    require(reader.number<std::uint64_t>() == messages.size(), "number of messages");
    require(reader.number<std::uint16_t>() == schemas.size(), "number of schemas");
    require(reader.number<std::uint32_t>() == channels.size(), "number of channels");
    require(reader.number<std::uint32_t>() == 0 && reader.number<std::uint32_t>() == 0, "attachments, metadata");
    require(reader.number<std::uint32_t>() == chunks_.size(), "number of chunks");
    const auto first = reader.number<std::uint64_t>();
    const auto last = reader.number<std::uint64_t>();
    if (!messages.empty())
      require(first == messages.front().log_ns && last == messages.back().log_ns, "times of the file");
    std::map<std::uint16_t, std::uint64_t> counts, counted;
    for (const auto& [id, channel] : channels) counts[id] = 0;
    for (const Message& message : messages) ++counts[message.channel];
    BytesReader map(reader.counted());
    while (!map.at_end()) {
      const auto channel = map.number<std::uint16_t>();
      counted[channel] = map.number<std::uint64_t>();
    }
    require(counted == counts && reader.at_end(), "messages of each channel");
  }

  const std::string_view file_;
  std::string_view records_;  // of the chunk that is read
  std::vector<Chunk> chunks_;
  std::set<std::uint16_t> in_chunk_;                                       // channels of the last chunk
  std::map<std::pair<std::size_t, std::uint64_t>, std::size_t> place_of_;  // chunk, offset -> message
  std::size_t expected_ = 0, indexed_ = 0;  // messages of the last chunk, and those that an index names
};

}  // namespace godobject::mcap
