#include "firmware/records/telemetry_writer.h"

#include <utility>

#include "firmware/records/telemetry_rows.h"

namespace godobject::firmware {
namespace {

constexpr std::uint64_t kRowsAtOnce = 64;  // rows a write call; chosen: some 40 KiB of text

}  // namespace

TelemetryWriter::TelemetryWriter(LogFile file, int joint_count, std::uint32_t every)
    : file_(std::move(file)), joint_count_(joint_count), every_(every) {
  file_.write(telemetry_header(joint_count), 0);
}

void TelemetryWriter::add(const TelemetryRecord& record) {
  if (++cycles_ % every_ != 0) return;
  append_telemetry_row(record, joint_count_, text_);
  if (++rows_ == kRowsAtOnce) flush();
}

void TelemetryWriter::flush() {
  file_.write(text_, rows_);
  text_.clear();
  rows_ = 0;
}

}  // namespace godobject::firmware
