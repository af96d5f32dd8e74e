#include "firmware/incidents/incident_reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <deque>
#include <fstream>
#include <map>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/files/csv_lines.h"
#include "toolchain/files/text_file.h"
#include "toolchain/files/toml_file.h"
#include "toolchain/files/toml_table.h"

namespace godobject::firmware {
namespace {

namespace fs = std::filesystem;
using command::ExitCode;
using command::Failure;
using files::TomlTable;

constexpr double kRowsBefore = 30.0;  // rows before the stop, as of an incident's record [s]
constexpr double kRowsAfter = 60.0;   // [s]
constexpr std::size_t kMostLines = ~std::size_t{0};
constexpr TomlTable::Range kNumber = TomlTable::kFinite;

/// The folder of the record in `named`: of the newest run, and of its last incident.
fs::path record_folder(const fs::path& named) {
  std::error_code error;
  if (!fs::is_directory(named, error)) {
    throw Failure(ExitCode::kNoInput,
                  fmt::format("{}: is no folder; name the folder of a run or of an incident", named.string()));
  }
  fs::path folder = named;
  if (fs::is_directory(folder / "latest", error)) folder /= fs::read_symlink(folder / "latest", error);
  if (fs::is_directory(folder / "incident", error)) {
    const fs::path first = folder / "incident";
    folder = first;
    for (int i = 2; fs::is_directory(fs::path(fmt::format("{}-{}", first.string(), i)), error); ++i) {
      folder = fmt::format("{}-{}", first.string(), i);
    }
  }
  if (fs::exists(folder / "telemetry.csv", error)) return folder;
  fs::path newest;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (fs::exists(entry.path() / "telemetry.csv", error)) newest = std::max(newest, entry.path());
  }
  if (!newest.empty()) {
    throw Failure(ExitCode::kNoInput, fmt::format("{}: has no telemetry.csv; name one of its folders, such as {}",
                                                  folder.string(), newest.string()));
  }
  throw Failure(ExitCode::kNoInput,
                fmt::format("{}: has no telemetry.csv; name the folder of a run or of an incident", folder.string()));
}

/// The columns of a telemetry by their names.
class Columns {
 public:
  explicit Columns(std::string_view header) {
    for (std::string_view rest = header;;) {
      const std::size_t comma = rest.find(',');
      at_.emplace(std::string(rest.substr(0, comma)), count_++);
      if (comma == std::string_view::npos) break;
      rest.remove_prefix(comma + 1);
    }
    while (joints_ < static_cast<int>(kMaxJoints) && at_.contains(fmt::format("q{}_rad", joints_ + 1))) ++joints_;
    for (const char* name : {"t_s", "late_us", "compute_us", "mode", "fault", "lost", "dpx_m", "dpy_m", "dpz_m", "dqw",
                             "dqx", "dqy", "dqz", "fx_N", "fy_N", "fz_N", "tx_Nm", "ty_Nm", "tz_Nm"}) {
      if (!at_.contains(name)) missing_ = missing_.empty() ? name : missing_;
    }
  }

  int joints() const { return joints_; }
  const std::string& missing() const { return missing_; }

  /// False: the line is no row.
  bool read(std::string_view line, IncidentRow& row) {
    words_.clear();
    for (std::string_view rest = line;;) {
      const std::size_t comma = rest.find(',');
      words_.push_back(rest.substr(0, comma));
      if (comma == std::string_view::npos) break;
      rest.remove_prefix(comma + 1);
    }
    if (words_.size() != count_) return false;
    good_ = true;
    row.t = number("t_s");
    good_ = good_ && std::isfinite(row.t);
    row.late = 1e-6 * number("late_us");
    row.computing = 1e-6 * number("compute_us");
    row.mode = words_[at_.at("mode")];
    row.fault = static_cast<Fault>(whole("fault", 255));
    row.lost = whole("lost", 1e9);
    if (at_.contains("fault_joint")) row.fault_joint = whole("fault_joint", kMaxJoints);
    if (at_.contains("alarm")) row.alarm = static_cast<hal::Alarm>(whole("alarm", 255));
    for (int i = 0; i < joints_; ++i) {
      row.q[i] = number(fmt::format("q{}_rad", i + 1));
      row.qd[i] = number(fmt::format("qd{}_rad_s", i + 1));
      row.torque[i] = number(fmt::format("torque{}_Nm", i + 1));
    }
    row.H_WD.translation = {number("dpx_m"), number("dpy_m"), number("dpz_m")};
    row.H_WD.rotation = Quaternion(number("dqw"), number("dqx"), number("dqy"), number("dqz"));
    row.force = {number("fx_N"), number("fy_N"), number("fz_N")};
    row.hand_torque = {number("tx_Nm"), number("ty_Nm"), number("tz_Nm")};
    return good_;
  }

 private:
  /// A number from 0 to `most`.
  int whole(const std::string& column, double most) {
    const double value = number(column);
    const bool in_range = value >= 0.0 && value <= most;
    good_ = good_ && in_range;
    return in_range ? static_cast<int>(value) : 0;
  }

  double number(const std::string& column) {
    double value = 0.0;
    const auto at = at_.find(column);
    good_ = good_ && at != at_.end() && files::read_number(words_[at->second], value);
    return value;
  }

  std::map<std::string, std::size_t> at_;
  std::size_t count_ = 0;
  int joints_ = 0;
  std::string missing_;
  std::vector<std::string_view> words_;
  bool good_ = true;
};

/// Gathers the rows around the last stop.
class StopFinder {
 public:
  void add(const IncidentRow& row) {
    const bool stopped = stop_t_.has_value();
    if (stopped && row.fault == Fault::kNone) {  // reset by the operator
      found_ = std::move(rows_);
      rows_.clear();
      stop_t_.reset();
    }
    if (!stop_t_ && row.fault != Fault::kNone) stop_t_ = row.t;
    if (stop_t_ && row.t > *stop_t_ + kRowsAfter) return;
    rows_.push_back(row);
    while (rows_.front().t < stop_t_.value_or(row.t) - kRowsBefore) rows_.pop_front();
  }

  std::vector<IncidentRow> rows() const {
    const std::deque<IncidentRow>& rows = stop_t_ || found_.empty() ? rows_ : found_;
    return {rows.begin(), rows.end()};
  }

 private:
  std::deque<IncidentRow> rows_, found_;
  std::optional<double> stop_t_;
};

bool ends_with_line_feed(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  stream.seekg(-1, std::ios::end);
  return stream.get() == '\n';
}

void read_telemetry(Incident& incident) {
  const fs::path file = incident.folder / "telemetry.csv";
  files::CsvLines lines(file, kMostLines);
  std::string_view line;
  if (!lines.next(line)) throw Failure(ExitCode::kBadData, fmt::format("{}: is empty; it has no row", file.string()));
  Columns columns(line);
  if (!columns.missing().empty()) {
    lines.refuse(fmt::format("has no column {}; it is no telemetry of godobject-controller", columns.missing()));
  }
  incident.joint_count = columns.joints();
  StopFinder finder;
  std::optional<IncidentRow> row;  // added once the next line shows that it is whole
  std::size_t broken = 0;          // line
  while (lines.next(line)) {
    if (broken > 0) {
      throw Failure(ExitCode::kBadData,
                    fmt::format("{}:{}: is no row of this telemetry; was the file changed?", file.string(), broken));
    }
    if (row) finder.add(*row);
    row.emplace();
    if (columns.read(line, *row)) continue;
    row.reset();
    broken = lines.number();
  }
  const bool cut_off = broken > 0 || !ends_with_line_feed(file);
  if (row && !cut_off) finder.add(*row);
  incident.rows = finder.rows();
  if (incident.rows.empty()) {
    throw Failure(ExitCode::kBadData, fmt::format("{}: has no whole row; the run was killed before its first one was "
                                                  "written",
                                                  file.string()));
  }
  if (cut_off) incident.notes.emplace_back("the last row of telemetry.csv is cut off and left out");
  const auto stop = std::find_if(incident.rows.begin(), incident.rows.end(),
                                 [](const IncidentRow& one) { return one.fault != Fault::kNone; });
  if (stop != incident.rows.end()) incident.stop = static_cast<std::size_t>(stop - incident.rows.begin());
}

IncidentBounds read_bounds(const toml::table& root, const fs::path& file) {
  IncidentBounds bounds;
  const TomlTable loop(root, "loop", file);
  bounds.period = loop.number("period", {1e-6, 1.0});
  bounds.compute = loop.number("compute", kNumber);
  bounds.velocity_span = bounds.period * loop.number("velocity_window", {2.0, 1e4}) - bounds.period;
  bounds.scale = loop.number("scale", {1e-6, 1e6});
  const TomlTable limits(root, "limits", file);
  bounds.force = limits.number("force", kNumber);
  bounds.torque = limits.number("torque", kNumber);
  bounds.speed_stop = limits.number("speed_stop", kNumber);
  bounds.turn_stop = limits.number("turn_stop", kNumber);
  bounds.joint_speed_stop = limits.number("joint_speed_stop", kNumber);
  for (const TomlTable& table : TomlTable::each(root, "joint", file)) {
    bounds.joints.push_back({.lower = table.number("lower", kNumber),
                             .upper = table.number("upper", kNumber),
                             .velocity = table.number("velocity", {1e-9, 1e9}),
                             .torque = table.number("torque", {1e-9, 1e9}),
                             .bus = static_cast<int>(table.whole_number("bus", {0, 255})),
                             .node = static_cast<int>(table.whole_number("node", {0, 255}))});
  }
  if (const toml::array* const buses = root["buses"].as_array()) {
    for (const toml::node& bus : *buses) bounds.buses.push_back(bus.value_or(std::string()));
  }
  return bounds;
}

/// A fact that is missing, or that cannot be read, is a note.
void read_facts(Incident& incident) {
  const fs::path file = incident.folder / "run.toml";
  if (!fs::exists(file)) {
    incident.notes.emplace_back("run.toml is missing: the bounds are not known");
    return;
  }
  try {
    const toml::table root = files::parse_toml_file(file);
    const TomlTable top = TomlTable::top(root, file);
    incident.began = top.text("began", "");
    incident.program = top.text("program", "");
    incident.machine = top.text("machine", "");
    incident.image = top.text("image", "");
    incident.stopped = TomlTable(root, "stop", file).text("utc", "");
    IncidentBounds bounds = read_bounds(root, file);
    if (bounds.joints.size() == static_cast<std::size_t>(incident.joint_count)) {
      incident.bounds = std::move(bounds);
    } else {
      incident.notes.push_back(fmt::format("run.toml has {} joints, telemetry.csv {}: the bounds are not used",
                                           bounds.joints.size(), incident.joint_count));
    }
  } catch (const Failure& failure) {
    incident.notes.push_back(fmt::format("the bounds are not known: {}", failure.what()));
  }
}

/// An emergency message in a line of candump; false: the line has none, or one that reports no error.
bool read_emergency(const std::string& line, Emergency& emergency) {
  const std::size_t bus = line.find(") ");
  const std::size_t id = bus == std::string::npos ? bus : line.find(' ', bus + 2);
  const std::size_t data = id == std::string::npos ? id : line.find('#', id);
  if (data == std::string::npos || data - id != 4) return false;
  unsigned number = 0;
  const auto hex = [&](std::size_t from, std::size_t count, unsigned& value) {
    return from + count <= line.size() &&
           std::from_chars(line.data() + from, line.data() + from + count, value, 16).ptr == line.data() + from + count;
  };
  if (!hex(id + 1, 3, number) || number <= 0x80 || number > 0xFF) return false;
  std::size_t first = data + 1;
  if (first < line.size() && line[first] == '#') first += 2;  // an FD frame with its digit of flags
  unsigned low = 0;
  unsigned high = 0;
  if (!hex(first, 2, low) || !hex(first + 2, 2, high) || (low == 0 && high == 0)) return false;
  emergency = {
      .bus = line.substr(bus + 2, id - bus - 2), .node = static_cast<int>(number - 0x80), .code = high << 8 | low};
  return true;
}

void read_emergencies(Incident& incident) {
  std::ifstream stream(incident.folder / "can.log");
  Emergency emergency;
  for (std::string line; std::getline(stream, line);) {
    if (read_emergency(line, emergency)) incident.emergencies.push_back(emergency);
  }
}

}  // namespace

Incident read_incident(const fs::path& folder) {
  Incident incident;
  incident.folder = record_folder(folder);
  read_telemetry(incident);
  read_facts(incident);
  read_emergencies(incident);
  if (const fs::path words = incident.folder / "words.txt"; fs::exists(words)) {
    const std::string text = files::read_text(words);
    incident.words = text.substr(0, text.find('\n'));
  }
  return incident;
}

}  // namespace godobject::firmware
