#include "firmware/records/hand_log.h"

#include <iterator>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"

namespace godobject::firmware {
namespace {

constexpr std::uint64_t kHandRowsAtOnce = 64;  // rows a write call, as of the telemetry
constexpr std::string_view kHandHeader = "t_s,hand_J\n";

}  // namespace

HandLog::HandLog(LogFile file) : file_(std::move(file)) { file_.write(kHandHeader, 0); }

void HandLog::write_row(std::int64_t now_ns, double work) {
  fmt::format_to(std::back_inserter(text_), "{:.6f},{:.9g}\n", 1e-9 * static_cast<double>(now_ns), work);
  if (++rows_ == kHandRowsAtOnce) write_rows();
}

void HandLog::write_rows() {
  file_.write(text_, rows_);
  text_.clear();
  rows_ = 0;
}

void HandLog::close() {
  write_rows();
  if (file_.lost() > 0) {
    throw command::Failure(command::ExitCode::kIo, fmt::format("{}: {} rows could not be written; check the disk",
                                                               file_.path().string(), file_.lost()));
  }
}

}  // namespace godobject::firmware
