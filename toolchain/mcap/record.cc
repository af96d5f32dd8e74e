#include "toolchain/mcap/record.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/files/input_file.h"
#include "toolchain/mcap/cycle_messages.h"

namespace godobject::mcap {
namespace {

using command::ExitCode;
using command::Failure;
using figures::ReplayRow;
using figures::TelemetryRow;

constexpr double kArrowPeriod = 0.01;  // a viewer draws no more arrows [s]

double largest_force(const figures::ReplayLog& cycles) {
  double largest = 0.0;
  for (const ReplayRow& row : cycles) largest = std::max(largest, row.wrench.force.norm());
  return largest;
}

/// Writes the messages of a recording, one topic after the other in each cycle.
class RecordWriter {
 public:
  RecordWriter(const Recording& recording, McapWriter& writer)
      : recording_(recording),
        writer_(writer),
        messages_(recording.bodies, recording.up_axis, largest_force(recording.cycles)) {}

  void write() {
    add_topics();
    const std::uint64_t begin_ns = nanoseconds(recording_.cycles.front().t);
    put(begin_ns, messages_.upright(begin_ns));
    put(begin_ns, messages_.bodies(begin_ns));
    const std::vector<Pose> device = figures::device_poses(recording_.cycles);
    for (std::size_t i = 0; i < recording_.cycles.size(); ++i) {
      write_cycle(recording_.cycles[i], device[i]);
      if (!is_replay()) write_controller(recording_.controller[i]);
    }
    writer_.finish();
  }

 private:
  bool is_replay() const { return recording_.controller.empty(); }

  void add_topics() {
    std::map<std::string, McapWriter::Id> schemas;
    for (const TopicInfo& info : is_replay() ? replay_topics() : controller_topics()) {
      const std::string name = info.schema_name();
      if (!schemas.contains(name)) schemas[name] = writer_.add_schema(name, info.schema());
      channels_[info.topic] = writer_.add_channel(info.name, schemas[name], info.latched);
    }
  }

  void put(std::uint64_t time_ns, const TopicMessage& message) {
    writer_.write(channels_.at(message.topic), time_ns, message.bytes);
  }

  void write_cycle(const ReplayRow& row, const Pose& H_WD) {
    const std::uint64_t time_ns = nanoseconds(row.t);
    const bool has_arrow = row.t >= next_arrow_;
    if (has_arrow) next_arrow_ = row.t + kArrowPeriod;
    for (const TopicMessage& message : messages_.cycle(time_ns, row, H_WD)) {
      if (has_arrow || message.topic != Topic::kForceArrow) put(time_ns, message);
    }
    if (is_replay()) put(time_ns, CycleMessages::solver_times(time_ns, row));
  }

  void write_controller(const TelemetryRow& row) {
    const std::uint64_t time_ns = nanoseconds(row.cycle.t);
    for (const TopicMessage& message : CycleMessages::controller(time_ns, row)) put(time_ns, message);
  }

  const Recording& recording_;
  McapWriter& writer_;
  const CycleMessages messages_;
  std::map<Topic, McapWriter::Id> channels_;
  double next_arrow_ = 0.0;  ///< [s]
};

}  // namespace

void read_cycles(const std::filesystem::path& file, Recording& recording) {
  files::require_regular_input(file, "make it with godobject-replay or godobject-controller, or check the path");
  if (figures::is_telemetry(file)) {
    recording.controller = figures::read_telemetry_log(file);
    for (const TelemetryRow& row : recording.controller) recording.cycles.push_back(row.cycle_in_scene());
  } else {
    recording.cycles = figures::read_replay_log(file);
  }
  for (const double t : {recording.cycles.front().t, recording.cycles.back().t}) {
    if (t >= 0.0 && t < std::numeric_limits<std::int32_t>::max()) continue;
    throw Failure(ExitCode::kBadData,
                  fmt::format("{}: a record holds times from 0 to 2^31 s, and there is one of {} s; add a constant to "
                              "the times of the path, and replay it again",
                              file.string(), t));
  }
}

void write_record(const Recording& recording, McapWriter& writer) { RecordWriter(recording, writer).write(); }

}  // namespace godobject::mcap
