#include "toolchain/figures/replay_log.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/figures/telemetry_log.h"
#include "toolchain/files/csv_lines.h"
#include "toolchain/files/input_file.h"
#include "toolchain/replay/replay.h"

namespace godobject::figures {
namespace {

using command::ExitCode;
using command::Failure;

constexpr std::size_t kRowNumbers = 26;  // and the status

Pose pose(const double* v) { return {Quaternion(v[3], v[4], v[5], v[6]), Vector3(v[0], v[1], v[2])}; }

/// Splits a line into its numbers and the status. Returns false if their number is wrong or a number is malformed.
bool split(std::string_view line, std::array<double, kRowNumbers>& numbers, std::string& status) {
  for (double& number : numbers) {
    const std::size_t comma = line.find(',');
    if (comma == std::string_view::npos) return false;
    const auto [end, error] = std::from_chars(line.data(), line.data() + comma, number);
    if (error != std::errc{} || end != line.data() + comma) return false;
    line.remove_prefix(comma + 1);
  }
  status = line;
  return !line.empty() && line.find(',') == std::string_view::npos;
}

/// Cuts the last field off a line. Returns false if it is no finite number.
bool cut_last_number(std::string_view& line) {
  const std::size_t comma = line.rfind(',');
  double number = 0.0;
  if (comma == std::string_view::npos || !files::read_number(line.substr(comma + 1), number)) return false;
  line = line.substr(0, comma);
  return std::isfinite(number);
}

ReplayRow make_row(const std::array<double, kRowNumbers>& v, std::string status) {
  ReplayRow row;
  row.t = v[0];
  row.H_WD = pose(&v[1]);
  row.H_WS = pose(&v[8]);
  row.wrench = {Vector3(v[15], v[16], v[17]), Vector3(v[18], v[19], v[20])};
  row.depth = v[21];
  row.contacts = v[22];
  row.step1_ns = v[24];
  row.solve_ns = v[25];
  row.status = std::move(status);
  return row;
}

/// Tells if all numbers are finite, except the device pose of a `bad_input` row, which may have any value.
bool finite(const std::array<double, kRowNumbers>& v, std::string_view status) {
  const auto first = v.begin() + (status == "bad_input" ? 8 : 0);
  return std::isfinite(v[0]) && std::all_of(first, v.end(), [](double x) { return std::isfinite(x); });
}

}  // namespace

ReplayLog read_replay_log(const std::filesystem::path& file) {
  files::require_input(file, "make it with godobject-replay or godobject-controller, or check the path");
  files::CsvLines lines(file);
  const auto refuse = [&](std::size_t line, std::string_view what) {
    throw Failure(ExitCode::kBadData,
                  fmt::format("{}:{}: {}; make it again with godobject-replay", file.string(), line, what));
  };
  std::string_view text;
  ReplayLog log;
  if (!lines.next(text)) refuse(1, "is empty");
  if (text.starts_with(kTelemetryBegin)) {
    log = rendered(read_telemetry_log(file));
    if (log.empty())
      throw Failure(ExitCode::kBadData,
                    fmt::format("{}: no cycle rendered a force; see the mode and the fault of the run", file.string()));
    return log;
  }
  const bool has_overlap = text == fmt::format("{},{}", replay::kColumns, replay::kOverlapColumn);
  if (text != replay::kColumns && !has_overlap) refuse(1, "not the header of a replay");
  std::array<double, kRowNumbers> numbers{};
  std::string status;
  while (lines.next(text)) {
    const std::size_t line = lines.number();
    if (has_overlap && !cut_last_number(text)) refuse(line, "not a number at its end");
    if (!split(text, numbers, status)) refuse(line, fmt::format("not {} numbers and a status", kRowNumbers));
    if (!finite(numbers, status)) refuse(line, "a number is not finite");
    if (!log.empty() && numbers[0] <= log.back().t) refuse(line, "t does not increase");
    log.push_back(make_row(numbers, std::move(status)));
  }
  if (log.empty()) refuse(lines.number() + 1, "holds no cycle");
  return log;
}

const ReplayRow& row_at(const ReplayLog& log, double t, const std::filesystem::path& file) {
  constexpr double kNear = 1e-3;  // a moment may lie this far outside of the log, chosen [s]
  const double begin = log.front().t;
  const double end = log.back().t;
  if (!(t >= begin - kNear && t <= end + kNear)) {
    throw Failure(ExitCode::kBadData,
                  fmt::format("{}: no cycle at {} s; choose a time within {} .. {} s", file.string(), t, begin, end));
  }
  return *std::min_element(log.begin(), log.end(), [t](const ReplayRow& a, const ReplayRow& b) {
    return std::abs(a.t - t) < std::abs(b.t - t);
  });
}

std::vector<Pose> device_poses(const ReplayLog& log) {
  std::vector<Pose> poses;
  Pose last = log.front().H_WS;
  for (const ReplayRow& row : log) {
    const bool is_pose = row.H_WD.is_finite() && std::abs(row.H_WD.rotation.norm() - 1.0) < 1e-3;
    if (is_pose) last = row.H_WD;
    poses.push_back(last);
  }
  return poses;
}

const ReplayRow& deepest_row(const ReplayLog& log) {
  return *std::max_element(log.begin(), log.end(),
                           [](const ReplayRow& a, const ReplayRow& b) { return a.depth < b.depth; });
}

std::optional<double> moment(std::string_view name, const std::vector<const ReplayLog*>& logs) {
  if (name == "deepest") {
    const ReplayRow* deepest = &deepest_row(*logs.front());
    for (const ReplayLog* log : logs) {
      const ReplayRow& row = deepest_row(*log);
      if (row.depth > deepest->depth) deepest = &row;
    }
    return deepest->t;
  }
  double t = 0.0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), t);
  if (error != std::errc{} || end != name.data() + name.size() || !std::isfinite(t)) return std::nullopt;
  return t;
}

}  // namespace godobject::figures
