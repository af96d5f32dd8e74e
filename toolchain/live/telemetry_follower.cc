#include "toolchain/live/telemetry_follower.h"

#include <sys/stat.h>

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "hal/linux/monotonic_clock.h"
#include "toolchain/command_line/failure.h"

namespace godobject::live {
namespace {

constexpr std::size_t kRead = std::size_t{1} << 18;     // at once [bytes]
constexpr std::size_t kBacklog = std::size_t{1} << 20;  // of a longer file the begin is skipped: some seconds

}  // namespace

TelemetryFollower::TelemetryFollower(const firmware::ControllerConfig& config)
    : file_(config.telemetry.folder / "telemetry.csv"),
      image_(config.scene.image),
      scene_(firmware::configured(image_.scene(), config)),
      placement_(firmware::place(config.workspace, config.device, scene_.H_MB.translation)),
      start_(config.workspace.start),
      posture_(config.workspace.posture) {}

/// The sample that a page shows before there is a telemetry.
LiveSample TelemetryFollower::waiting() const {
  LiveSample sample;
  sample.mode = fmt::format("waits for {}", file_.string());
  sample.H_WD = sample.H_WS = start_;
  sample.q = posture_;
  return sample;
}

/// True if the path is another file than before, a shorter one, or one whose rows do not continue those before.
bool TelemetryFollower::is_another_file() const {
  struct stat status {};
  if (::stat(file_.c_str(), &status) != 0) return false;
  return begins_again_ || status.st_ino != inode_ || static_cast<std::size_t>(status.st_size) < read_;
}

/// Opens the file and reads its header. Without effect before the header is complete. Of a long file only the last
/// rows are read.
void TelemetryFollower::open() {
  stream_.close();
  inode_ = 0;  // no file has this number
  begins_again_ = false;
  struct stat status {};
  std::string header;
  std::ifstream stream(file_, std::ios::binary);
  if (::stat(file_.c_str(), &status) != 0 || !std::getline(stream, header) || stream.eof()) return;
  try {
    columns_.emplace(header);
  } catch (const figures::MalformedTelemetry& malformed) {
    throw command::Failure(command::ExitCode::kBadData, fmt::format("{}:1: {}", file_.string(), malformed.what()));
  }
  inode_ = status.st_ino;
  read_ = header.size() + 1;
  rest_.clear();
  last_t_ = -1.0;
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size > read_ + kBacklog) {
    stream.seekg(static_cast<std::streamoff>(size - kBacklog));
    std::getline(stream, header);  // the end of a row
    read_ = size - kBacklog + header.size() + 1;
  }
  stream_ = std::move(stream);
}

void TelemetryFollower::take(std::vector<LiveSample>& samples) {
  if (is_another_file()) open();
  if (!stream_.is_open()) {
    if (!waits_) samples.push_back(waiting());
    waits_ = true;
    return;
  }
  std::vector<char> piece(kRead);
  const std::size_t before = samples.size();
  for (;;) {
    stream_.clear();
    stream_.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    const auto length = static_cast<std::size_t>(stream_.gcount());
    if (length == 0) break;
    read_ += length;
    rest_.append(piece.data(), length);
    std::size_t begin = 0;
    for (std::size_t end = rest_.find('\n'); end != std::string::npos; end = rest_.find('\n', begin)) {
      read_line(std::string_view(rest_).substr(begin, end - begin), samples);
      begin = end + 1;
    }
    rest_.erase(0, begin);
  }
  measure_speed({samples.begin() + static_cast<std::ptrdiff_t>(before), samples.end()});
}

void TelemetryFollower::read_line(std::string_view line, std::vector<LiveSample>& samples) {
  try {
    LiveSample sample = sample_of(columns_->row(line));
    begins_again_ = begins_again_ || sample.t < last_t_;  // another program has overwritten the file
    last_t_ = sample.t;
    samples.push_back(std::move(sample));
  } catch (const figures::MalformedTelemetry&) {
    ++skipped_;
  }
}

void TelemetryFollower::measure_speed(const std::vector<LiveSample>& samples) {
  constexpr std::int64_t kMeasured_ns = 1'000'000'000;
  const std::int64_t now_ns = hal::MonotonicClock().now_ns();
  if (now_ns - wall_mark_ns_ < kMeasured_ns) return;
  const double t = samples.empty() ? mark_ : samples.back().t;
  const bool goes_on = t > mark_ && wall_mark_ns_ > 0;
  speed_ = goes_on ? (t - mark_) / (1e-9 * static_cast<double>(now_ns - wall_mark_ns_)) : 0.0;
  mark_ = t;
  wall_mark_ns_ = now_ns;
}

std::string TelemetryFollower::answer(const Request&) {
  return "this page looks at a controller in another process, which it cannot move";
}

}  // namespace godobject::live
