#include "toolchain/mcap/mcap_writer.h"

#include <zlib.h>

#include "godobject/version.h"
#include "toolchain/mcap/little_endian.h"

namespace godobject::mcap {
namespace {

constexpr std::string_view kMagic = "\x89MCAP0\r\n";

enum class Opcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0b,
  kSummaryOffset = 0x0e,
  kDataEnd = 0x0f
};

std::uint32_t crc_of(std::string_view bytes, std::uint32_t before = 0) {
  return static_cast<std::uint32_t>(
      ::crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<z_size_t>(bytes.size())));
}

/// Appends a record: its opcode, the length of its content, its content.
void append_record(std::string& bytes, Opcode opcode, std::string_view content) {
  bytes += static_cast<char>(opcode);
  append_little_endian(bytes, std::uint64_t{content.size()});
  bytes += content;
}

std::string record(Opcode opcode, std::string_view content) {
  std::string bytes;
  append_record(bytes, opcode, content);
  return bytes;
}

/// Appends bytes after their length: a string, an array or a map.
void append_counted(std::string& bytes, std::string_view counted) {
  append_little_endian(bytes, static_cast<std::uint32_t>(counted.size()));
  bytes += counted;
}

/// Returns the quality of service of a topic, as rosbag2 writes it: reliable, and `latched` or volatile.
std::string offered_qos_profiles(bool latched) {
  constexpr std::string_view kForever = "\n    sec: 9223372036\n    nsec: 854775807\n";
  std::string text = "- history: 3\n  depth: 0\n  reliability: 1\n  durability: ";
  text += latched ? "1" : "2";
  for (const std::string_view limit : {"\n  deadline:", "  lifespan:", "  liveliness: 1\n  liveliness_lease_duration:"})
    text.append(limit).append(kForever);
  return text + "  avoid_ros_namespace_conventions: false";
}

}  // namespace

McapWriter::McapWriter(files::AtomicFile& file) : file_(file) {
  std::string content;
  append_counted(content, "ros2");
  append_counted(content, "godobject-mcap " GODOBJECT_VERSION);
  put(kMagic);
  put(record(Opcode::kHeader, content));
}

McapWriter::Id McapWriter::add_schema(std::string_view name, std::string_view definition) {
  std::string content;
  append_little_endian(content, ++schema_count_);
  append_counted(content, name);
  append_counted(content, "ros2msg");
  append_counted(content, definition);
  append_record(schemas_, Opcode::kSchema, content);
  append_record(chunk_, Opcode::kSchema, content);
  return schema_count_;
}

McapWriter::Id McapWriter::add_channel(std::string_view topic, Id schema, bool latched) {
  of_channel_.emplace_back();
  const auto id = static_cast<Id>(of_channel_.size());
  std::string metadata;
  append_counted(metadata, "offered_qos_profiles");
  append_counted(metadata, offered_qos_profiles(latched));
  std::string content;
  append_little_endian(content, id);
  append_little_endian(content, schema);
  append_counted(content, topic);
  append_counted(content, "cdr");
  append_counted(content, metadata);
  append_record(channels_, Opcode::kChannel, content);
  append_record(chunk_, Opcode::kChannel, content);
  return id;
}

void McapWriter::write(Id channel, std::uint64_t time_ns, std::string_view message) {
  Channel& of = of_channel_.at(channel - 1u);
  if (messages_ == 0) in_file_.first_ns = time_ns;
  if (messages_in_chunk_++ == 0) in_chunk_.first_ns = time_ns;
  in_file_.last_ns = in_chunk_.last_ns = time_ns;
  of.in_chunk.emplace_back(time_ns, chunk_.size());
  std::string content;
  append_little_endian(content, channel);
  append_little_endian(content, of.messages++);
  append_little_endian(content, time_ns);
  append_little_endian(content, time_ns);  // recorded when published
  content += message;
  append_record(chunk_, Opcode::kMessage, content);
  ++messages_;
  if (chunk_.size() >= kChunkSize) end_chunk();
}

void McapWriter::put(std::string_view bytes) {
  file_.write(bytes);
  data_crc_ = crc_of(bytes, data_crc_);
  position_ += bytes.size();
}

void McapWriter::end_chunk() {
  const std::uint64_t size = chunk_.size();
  std::string content;
  append_little_endian(content, in_chunk_.first_ns);
  append_little_endian(content, in_chunk_.last_ns);
  append_little_endian(content, size);
  append_little_endian(content, crc_of(chunk_));
  append_counted(content, "");  // no compression
  append_little_endian(content, size);
  content += chunk_;
  const std::string chunk = record(Opcode::kChunk, content);
  const std::uint64_t chunk_start = position_;
  put(chunk);
  const std::uint64_t indexes_start = position_;
  const std::string index_offsets = write_message_indexes();

  std::string index;
  append_little_endian(index, in_chunk_.first_ns);
  append_little_endian(index, in_chunk_.last_ns);
  append_little_endian(index, chunk_start);
  append_little_endian(index, std::uint64_t{chunk.size()});
  append_counted(index, index_offsets);
  append_little_endian(index, position_ - indexes_start);
  append_counted(index, "");
  append_little_endian(index, size);
  append_little_endian(index, size);
  append_record(chunk_indexes_, Opcode::kChunkIndex, index);
  ++chunk_count_;
  chunk_.clear();
  in_chunk_ = {};
  messages_in_chunk_ = 0;
}

std::string McapWriter::write_message_indexes() {
  std::string offsets;
  for (std::size_t i = 0; i < of_channel_.size(); ++i) {
    auto& messages = of_channel_[i].in_chunk;
    if (messages.empty()) continue;
    const auto id = static_cast<Id>(i + 1);
    append_little_endian(offsets, id);
    append_little_endian(offsets, position_);
    std::string places;
    for (const auto& [time_ns, offset] : messages) {
      append_little_endian(places, time_ns);
      append_little_endian(places, offset);
    }
    std::string index;
    append_little_endian(index, id);
    append_counted(index, places);
    put(record(Opcode::kMessageIndex, index));
    messages.clear();
  }
  return offsets;
}

std::string McapWriter::statistics() const {
  std::string counts;
  for (std::size_t i = 0; i < of_channel_.size(); ++i) {
    append_little_endian(counts, static_cast<Id>(i + 1));
    append_little_endian(counts, std::uint64_t{of_channel_[i].messages});
  }
  std::string content;
  append_little_endian(content, messages_);
  append_little_endian(content, schema_count_);
  append_little_endian(content, static_cast<std::uint32_t>(of_channel_.size()));
  append_little_endian(content, std::uint32_t{0});  // attachments
  append_little_endian(content, std::uint32_t{0});  // metadata
  append_little_endian(content, chunk_count_);
  append_little_endian(content, in_file_.first_ns);
  append_little_endian(content, in_file_.last_ns);
  append_counted(content, counts);
  return record(Opcode::kStatistics, content);
}

void McapWriter::finish() {
  if (!chunk_.empty()) end_chunk();
  std::string data_end;
  append_little_endian(data_end, data_crc_);
  put(record(Opcode::kDataEnd, data_end));

  const std::uint64_t summary_start = position_;
  std::string summary, offsets;
  const auto add_group = [&](Opcode opcode, const std::string& records) {
    if (records.empty()) return;
    std::string content(1, static_cast<char>(opcode));
    append_little_endian(content, summary_start + summary.size());
    append_little_endian(content, std::uint64_t{records.size()});
    append_record(offsets, Opcode::kSummaryOffset, content);
    summary += records;
  };
  add_group(Opcode::kSchema, schemas_);
  add_group(Opcode::kChannel, channels_);
  add_group(Opcode::kStatistics, statistics());
  add_group(Opcode::kChunkIndex, chunk_indexes_);
  const std::uint64_t offsets_start = summary_start + summary.size();
  summary += offsets;

  constexpr std::uint64_t kFooterSize = 8 + 8 + 4;
  summary += static_cast<char>(Opcode::kFooter);
  append_little_endian(summary, kFooterSize);
  append_little_endian(summary, summary_start);
  append_little_endian(summary, offsets_start);
  append_little_endian(summary, crc_of(summary));
  put(summary);
  put(kMagic);
}

}  // namespace godobject::mcap
