#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "toolchain/files/atomic_file.h"

namespace godobject::mcap {

/// Writes a file of messages in the container format MCAP (https://mcap.dev/spec), profile `ros2`. Messages go to
/// chunks without compression. Every chunk has an index of its messages, and the end of the file an index of the
/// chunks. All checksums are set. The memory is that of one chunk and 150 bytes for each chunk before it.
///
/// Call add_schema and add_channel first, then write, and finish once. Throws Failure as AtomicFile does.
class McapWriter {
 public:
  using Id = std::uint16_t;

  /// Size of the messages of a chunk [bytes]; the last message may exceed it.
  static constexpr std::size_t kChunkSize = std::size_t{1} << 20;

  /// Begins the file. It stays incomplete until finish; the caller commits it.
  explicit McapWriter(files::AtomicFile& file);

  /// Adds a message type. `name`: as `geometry_msgs/msg/WrenchStamped`. `definition`: as from message_definition.
  Id add_schema(std::string_view name, std::string_view definition);

  /// Adds a topic. `latched`: ROS 2 gives the last message to those who subscribe later.
  Id add_channel(std::string_view topic, Id schema, bool latched);

  /// Appends a message. `time_ns`: not before that of the last message [ns]. `message`: as from CdrWriter.
  void write(Id channel, std::uint64_t time_ns, std::string_view message);

  /// Writes the last chunk, the summary and the end of the file.
  void finish();

  std::uint64_t messages() const { return messages_; }
  std::uint64_t size() const { return position_; }  ///< of the file so far [bytes]

 private:
  /// The times of messages; both 0 if there is none.
  struct Span {
    std::uint64_t first_ns = 0;
    std::uint64_t last_ns = 0;
  };

  /// A topic, with its messages in the chunk: the time [ns], and the offset in the chunk's records [bytes].
  struct Channel {
    std::vector<std::pair<std::uint64_t, std::uint64_t>> in_chunk;
    std::uint32_t messages = 0;
  };

  void put(std::string_view bytes);
  void end_chunk();
  std::string write_message_indexes();  // returns the map from channels to the indexes' offsets
  std::string statistics() const;

  files::AtomicFile& file_;
  std::uint64_t position_ = 0;
  std::uint32_t data_crc_ = 0;
  std::string schemas_, channels_, chunk_indexes_;  // records of the summary
  Id schema_count_ = 0;
  std::vector<Channel> of_channel_;  // by id - 1
  std::string chunk_;                // records
  std::uint64_t messages_in_chunk_ = 0;
  Span in_chunk_, in_file_;
  std::uint32_t chunk_count_ = 0;
  std::uint64_t messages_ = 0;
};

}  // namespace godobject::mcap
