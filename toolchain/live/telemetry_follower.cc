#include "toolchain/live/telemetry_follower.h"

#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "firmware/cycle/fault.h"
#include "hal/linux/monotonic_clock.h"
#include "toolchain/files/csv_lines.h"

namespace godobject::live {
namespace {

constexpr std::size_t kRead = std::size_t{1} << 18;     // at once [bytes]
constexpr std::size_t kBacklog = std::size_t{1} << 20;  // of a longer file the begin is skipped: some seconds

std::vector<std::string> fields_of(std::string_view line) {
  std::vector<std::string> fields;
  for (;;) {
    const std::size_t comma = line.find(',');
    fields.emplace_back(files::trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

/// The place for the number of a column; null: there is none.
double* number_of(std::string_view column, LiveSample& sample) {
  struct Number {
    std::string_view name;
    double* value;
  };
  const std::array numbers = {
      Number{"t_s", &sample.t},
      Number{"share", &sample.share},
      Number{"contacts", &sample.contacts},
      Number{"depth_m", &sample.depth},
      Number{"absorbed_J", &sample.absorbed},
      Number{"compute_us", &sample.computed},
      Number{"late_us", &sample.late},
      Number{"fx_N", &sample.wrench_R.force.x()},
      Number{"fy_N", &sample.wrench_R.force.y()},
      Number{"fz_N", &sample.wrench_R.force.z()},
      Number{"tx_Nm", &sample.wrench_R.torque.x()},
      Number{"ty_Nm", &sample.wrench_R.torque.y()},
      Number{"tz_Nm", &sample.wrench_R.torque.z()},
  };
  for (const auto& [name, value] : numbers) {
    if (name == column) return value;
  }
  if (column.size() == 6 && column.starts_with('q') && column.ends_with("_rad")) {
    const int joint = column[1] - '1';
    if (joint >= 0 && joint < kMaxJoints) return &sample.q[joint];
  }
  if (column.size() < 3 || (column.front() != 'd' && column.front() != 'g')) return nullptr;
  Pose& pose = column.front() == 'd' ? sample.H_WD : sample.H_WS;
  const std::string_view part = column.substr(1);
  if (part == "px_m") return &pose.translation.x();
  if (part == "py_m") return &pose.translation.y();
  if (part == "pz_m") return &pose.translation.z();
  if (part == "qw") return &pose.rotation.w();
  if (part == "qx") return &pose.rotation.x();
  if (part == "qy") return &pose.rotation.y();
  if (part == "qz") return &pose.rotation.z();
  return nullptr;
}

/// Describes the fault whose number the telemetry has.
bool read_fault(const std::string& field, std::string& text) {
  int number = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), number);
  if (error != std::errc{} || end != field.data() + field.size()) return false;
  const bool known = number > 0 && number <= static_cast<int>(firmware::Fault::kComputedLate);
  text = known ? describe(static_cast<firmware::Fault>(number)) : "";
  return true;
}

}  // namespace

bool read_telemetry_row(std::string_view line, const std::vector<std::string>& columns, LiveSample& sample) {
  const std::vector<std::string> fields = fields_of(line);
  if (fields.size() != columns.size()) return false;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (columns[i] == "mode") sample.mode = fields[i];
    if (columns[i] == "outcome") sample.outcome = fields[i];
    if (columns[i] == "fault" && !read_fault(fields[i], sample.fault)) return false;
    double* number = number_of(columns[i], sample);
    if (number != nullptr && !files::read_number(fields[i], *number)) return false;
  }
  sample.computed *= 1e-6;
  sample.late *= 1e-6;
  return true;
}

TelemetryFollower::TelemetryFollower(const firmware::ControllerConfig& config)
    : file_(config.telemetry.folder / "telemetry.csv"),
      image_(config.scene.image),
      scene_(firmware::configured(image_.scene(), config)),
      placement_(firmware::place(config.workspace, config.device, scene_.H_MB.translation)) {}

/// True if the path is another file than before, or a shorter one.
bool TelemetryFollower::is_another_file() const {
  struct stat status {};
  if (::stat(file_.c_str(), &status) != 0) return false;
  return status.st_ino != inode_ || static_cast<std::size_t>(status.st_size) < read_;
}

/// Opens the file and reads its header. Without effect before the header is complete. Of a long file only the last
/// rows are read.
void TelemetryFollower::open() {
  stream_.close();
  inode_ = 0;  // no file has this number
  struct stat status {};
  std::string header;
  std::ifstream stream(file_, std::ios::binary);
  if (::stat(file_.c_str(), &status) != 0 || !std::getline(stream, header) || stream.eof()) return;
  columns_ = fields_of(header);
  inode_ = status.st_ino;
  read_ = header.size() + 1;
  rest_.clear();
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
  if (!stream_.is_open()) return;
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
  LiveSample sample;
  if (read_telemetry_row(line, columns_, sample)) {
    samples.push_back(std::move(sample));
  } else {
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
