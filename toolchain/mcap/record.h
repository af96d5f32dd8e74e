#pragma once

#include <filesystem>

#include "toolchain/figures/replay_log.h"
#include "toolchain/figures/telemetry_log.h"
#include "toolchain/mcap/mcap_writer.h"
#include "toolchain/viewer/scene_bodies.h"

namespace godobject::mcap {

/// The bodies of a scene and a motion in it.
struct Recording {
  viewer::SceneBodies bodies;
  int up_axis = 2;                   ///< axis of W that points up: 0 .. 2
  figures::ReplayLog cycles;         ///< at least one; times that increase, from 0 to 2^31 s
  figures::TelemetryLog controller;  ///< the same cycles, with the arm's columns; empty for a replay
};

/// Reads a replay of godobject-replay, or all cycles of a telemetry of godobject-controller. Throws Failure as
/// read_replay_log does; kNoInput for a pipe, because the file is read twice; kBadData if a time is not in 0 .. 2^31 s,
/// the range of ROS 2.
void read_cycles(const std::filesystem::path& file, Recording& recording);

/// Writes the messages of a recording, and finishes the file. README.md lists topics and frames. Throws Failure:
/// as CycleMessages::bodies and McapWriter do.
void write_record(const Recording& recording, McapWriter& writer);

}  // namespace godobject::mcap
