#include "toolchain/query/query_points.h"

#include <cmath>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "toolchain/files/atomic_file.h"
#include "toolchain/files/csv_lines.h"
#include "toolchain/scene_compiler/points/ball.h"

namespace godobject::query {
namespace {

/// Reads exactly three finite numbers separated by commas.
bool read_point(std::string_view line, Vector3& point) {
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t comma = line.find(',');
    if ((comma == std::string_view::npos) != (axis == 2)) return false;
    if (!files::read_number(files::trimmed(line.substr(0, comma)), point[axis])) return false;
    if (!std::isfinite(point[axis])) return false;
    if (axis < 2) line.remove_prefix(comma + 1);
  }
  return true;
}

bool names_columns(std::string_view line) {
  return !line.empty() && line.find_first_of("0123456789") == std::string_view::npos &&
         line.find_first_of("xX") != std::string_view::npos;
}

void append_row(std::string& text, std::string_view point_text, const FieldSample& sample, double dilation) {
  const double length = sample.gradient.norm();
  const Vector3 normal = length > 0.0 ? Vector3(sample.gradient / length) : Vector3::Zero();
  fmt::format_to(std::back_inserter(text), "{},{:.9g},{:.9g},{:.9g},{:.9g},{}\n", point_text,
                 sample.distance + dilation, normal.x(), normal.y(), normal.z(), sample.known ? 1 : 0);
}

}  // namespace

std::uint64_t query_points(const SceneView& scene, const std::filesystem::path& points,
                           const std::filesystem::path& output, const parallel::Progress& progress) {
  constexpr std::size_t kMostLines = 100'000'000;  // a cube of 464 points a side; their rows take no memory
  files::CsvLines lines(points, kMostLines);
  std::error_code unknown;  // of a pipe: no progress is shown
  const std::uintmax_t size = std::filesystem::file_size(points, unknown);
  files::AtomicFile file(output);
  std::string text = "x,y,z,distance,nx,ny,nz,known\n";
  const double dilation = scene_compiler::ball_radius(scene);
  std::uint64_t rows = 0;
  bool first = true;
  for (std::string_view row; lines.next(row); first = false) {
    if (first && names_columns(row)) continue;
    Vector3 point;
    if (!read_point(row, point)) {
      lines.refuse(
          fmt::format("\"{}\" is not three finite numbers x,y,z; correct or remove the row", row.substr(0, 60)));
    }
    append_row(text, row, scene.voxelmap.sample(point), dilation);
    ++rows;
    if (text.size() > 1u << 20) {
      file.write(text);
      text.clear();
      if (progress && !unknown) progress(static_cast<double>(lines.bytes()) / static_cast<double>(size));
    }
  }
  file.write(text);
  file.commit();
  return rows;
}

}  // namespace godobject::query
