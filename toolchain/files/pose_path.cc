#include "toolchain/files/pose_path.h"

#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/files/csv_table.h"

namespace godobject::files {

using command::ExitCode;
using command::Failure;

PosePath read_pose_path(const std::filesystem::path& file, double period) {
  const double tolerance = 0.1 * period + 1e-9;  // plus the rounding of t itself
  constexpr std::array<std::string_view, 8> kPathColumns = {"t", "px", "py", "pz", "qw", "qx", "qy", "qz"};
  const CsvTable table = read_csv(file, kPathColumns);
  if (table.rows() == 0)
    throw Failure(ExitCode::kBadData,
                  fmt::format("{}: contains no pose; write one row for each {:g} ms", file.string(), 1e3 * period));
  PosePath path;
  path.lines = table.lines;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const auto row = table.row(i);
    if (!std::isfinite(row[0]) || (i > 0 && !(std::fabs(row[0] - path.t.back() - period) <= tolerance))) {
      throw Failure(
          ExitCode::kBadData,
          fmt::format("{}:{}: t = {} is not {:g} ms (within 10 %) after the row before; resample the path to {:g} kHz",
                      file.string(), table.lines[i], row[0], 1e3 * period, 1e-3 / period));
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
