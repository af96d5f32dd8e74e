#include "firmware/records/hand_log.h"

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"

namespace godobject::firmware {

HandLog::HandLog(const std::filesystem::path& folder) : file_(folder / "hand.csv"), stream_(file_) {
  stream_ << "t_s,hand_J\n";
  check();
}

void HandLog::write_row(std::int64_t now_ns, double work) {
  stream_ << fmt::format("{:.6f},{:.9g}\n", 1e-9 * static_cast<double>(now_ns), work);
}

void HandLog::close() {
  stream_.close();
  check();
}

void HandLog::check() const {
  if (!stream_) {
    throw command::Failure(command::ExitCode::kIo,
                           fmt::format("{}: cannot be written; check the folder", file_.string()));
  }
}

}  // namespace godobject::firmware
