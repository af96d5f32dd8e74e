#include "toolchain/files/pose_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "core/scene/format.h"
#include "toolchain/command_line/failure.h"
#include "toolchain/files/csv_table.h"

namespace godobject::files {

using command::ExitCode;
using command::Failure;

namespace {

/// The mean step of the column t [s]. Throws Failure: kBadData if t is not finite or does not fit into the range of
/// periods.
double mean_step(const std::filesystem::path& file, const CsvTable& table) {
  const double steps = static_cast<double>(table.rows() - 1);
  const double span = table.row(table.rows() - 1)[0] - table.row(0)[0];
  constexpr double kSpare = 1.001;  // rounding of t
  const bool fits = span >= steps * format::kShortestPeriod / kSpare && span <= steps * format::kLongestPeriod * kSpare;
  // to a nanosecond: the rounding of t must not become another period
  if (fits) return std::clamp(std::round(1e9 * span / steps) / 1e9, format::kShortestPeriod, format::kLongestPeriod);
  throw Failure(ExitCode::kBadData,
                fmt::format("{}:{}: t = {} makes a mean step of {:g} ms from row to row; it must be {:g} to {:g} ms: "
                            "resample the path, for instance to 1 kHz",
                            file.string(), table.lines.back(), table.row(table.rows() - 1)[0], 1e3 * span / steps,
                            1e3 * format::kShortestPeriod, 1e3 * format::kLongestPeriod));
}

}  // namespace

PosePath read_pose_path(const std::filesystem::path& file) {
  constexpr std::array<std::string_view, 8> kPathColumns = {"t", "px", "py", "pz", "qw", "qx", "qy", "qz"};
  const CsvTable table = read_csv(file, kPathColumns);
  if (table.rows() == 0) {
    throw Failure(ExitCode::kBadData, fmt::format("{}: contains no pose; write one row for each cycle", file.string()));
  }
  PosePath path;
  if (table.rows() > 1) path.period = mean_step(file, table);
  const double tolerance = 0.1 * path.period + 1e-9;  // plus the rounding of t itself
  path.lines = table.lines;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const auto row = table.row(i);
    if (!std::isfinite(row[0]) || (i > 0 && !(std::fabs(row[0] - path.t.back() - path.period) <= tolerance))) {
      throw Failure(ExitCode::kBadData,
                    fmt::format("{}:{}: t = {} is not {:g} ms (within 10 %) after the row before, as in the mean of "
                                "the path; resample it to one period",
                                file.string(), table.lines[i], row[0], 1e3 * path.period));
    }
    Pose pose;
    pose.translation = Vector3(row[1], row[2], row[3]);
    pose.rotation = Quaternion(row[4], row[5], row[6], row[7]);
    path.t.push_back(row[0]);
    path.poses.push_back(pose);
  }
  return path;
}

}  // namespace godobject::files
