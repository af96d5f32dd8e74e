#include "toolchain/report/assembly/screw.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "toolchain/command_line/failure.h"
#include "toolchain/report/assembly/section.h"

namespace godobject::report {
namespace {

constexpr int kSections = 12;

/// Flanks where the sections of a mesh cross a radius.
struct Flanks {
  std::vector<double> pitches;
  std::vector<double> angles;
};

void add_flanks(const scene_compiler::TriangleMesh& mesh, double radius, double low, double high, Flanks& flanks) {
  for (int i = 0; i < kSections; ++i) {
    std::array<std::vector<double>, 2> heights;  // of flanks that rise and fall with the radius
    for (const Segment& segment : axial_section(mesh, 0.31 + 2.0 * std::numbers::pi * i / kSections)) {
      const Eigen::Vector2d along = segment[1] - segment[0];
      const double share = (radius - segment[0].x()) / along.x();
      if (!(share >= 0.0 && share < 1.0)) continue;
      const double z = segment[0].y() + share * along.y();
      if (z < low || z > high) continue;
      heights[along.y() * along.x() > 0.0 ? 1 : 0].push_back(z);
      flanks.angles.push_back(std::atan(std::abs(along.y() / along.x())));
    }
    for (std::vector<double>& of_side : heights) {
      std::sort(of_side.begin(), of_side.end());
      for (std::size_t j = 1; j < of_side.size(); ++j) flanks.pitches.push_back(of_side[j] - of_side[j - 1]);
    }
  }
}

double median(std::vector<double> values) {
  if (values.empty()) {
    throw command::Failure(command::ExitCode::kBadData,
                           "the meshes of a nut and a bolt have no threads about z that overlap; check the scene");
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

Screw measure_screw(const scene_compiler::TriangleMesh& bolt, const scene_compiler::TriangleMesh& nut, double low,
                    double high) {
  Screw screw{
      .pitch = 0.0, .flank_angle = 0.0, .inner_radius = std::numeric_limits<double>::infinity(), .outer_radius = 0.0};
  for (const auto& p : bolt.vertices) {
    if (p.z() > low && p.z() < high) screw.outer_radius = std::max(screw.outer_radius, std::hypot(p.x(), p.y()));
  }
  for (const auto& p : nut.vertices) screw.inner_radius = std::min(screw.inner_radius, std::hypot(p.x(), p.y()));
  Flanks flanks;
  add_flanks(bolt, screw.mean_radius(), low, high, flanks);
  add_flanks(nut, screw.mean_radius(), -std::numeric_limits<double>::infinity(),
             std::numeric_limits<double>::infinity(), flanks);
  screw.pitch = median(flanks.pitches);
  screw.flank_angle = median(flanks.angles);
  return screw;
}

double self_locking_friction(const Screw& screw, double radius) {
  return screw.pitch / (2.0 * std::numbers::pi * radius) * std::cos(screw.flank_angle);
}

double raising_torque(const Screw& screw, double radius, double friction) {
  const double around = 2.0 * std::numbers::pi * radius;
  const double mu = friction / std::cos(screw.flank_angle);
  return radius * (screw.pitch + mu * around) / (around - mu * screw.pitch);
}

}  // namespace godobject::report
