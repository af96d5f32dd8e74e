#include "firmware/records/telemetry_writer.h"

#include <utility>

namespace godobject::firmware {
namespace {

constexpr std::uint64_t kRowsAtOnce = 64;  // rows a write call; chosen: some 40 KiB of text

}  // namespace

TelemetryWriter::TelemetryWriter(LogFile file, const TelemetryFormat& format, std::uint32_t every)
    : file_(std::move(file)), format_(format), every_(every) {
  file_.write(telemetry_header(format.joint_count), 0);
}

void TelemetryWriter::add(const TelemetryRecord& record) {
  if (++cycles_ % every_ != 0) return;
  append_telemetry_row(record, format_, text_);
  if (++rows_ == kRowsAtOnce) flush();
}

void TelemetryWriter::flush() {
  file_.write(text_, rows_);
  text_.clear();
  rows_ = 0;
}

}  // namespace godobject::firmware
