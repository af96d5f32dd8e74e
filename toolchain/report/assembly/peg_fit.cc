#include "toolchain/report/assembly/peg_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "toolchain/command_line/failure.h"
#include "toolchain/report/assembly/section.h"

namespace godobject::report {
namespace {

constexpr double kBeside = 1e-5;  // the angle of the section, which meets no vertex [rad]
constexpr double kSame = 2e-6;    // of radii [m]

}  // namespace

PegFit measure_peg_fit(const Pair& pair) {
  PegFit fit{.peg_radius = 0.0,
             .edge_z = std::numeric_limits<double>::infinity(),
             .hole_radius = std::numeric_limits<double>::infinity(),
             .rim_z = -std::numeric_limits<double>::infinity()};
  const std::vector<Segment> peg = axial_section(pair.moving, kBeside);
  for (const Segment& segment : peg) fit.peg_radius = std::max({fit.peg_radius, segment[0].x(), segment[1].x()});
  for (const Segment& segment : peg) {
    for (const Eigen::Vector2d& end : segment) {
      if (end.x() > fit.peg_radius - kSame) fit.edge_z = std::min(fit.edge_z, end.y());
    }
  }
  const std::vector<Segment> hole = axial_section(pair.still, kBeside);
  for (const Segment& segment : hole) {
    for (const Eigen::Vector2d& end : segment) {
      if (end.x() > fit.peg_radius) fit.hole_radius = std::min(fit.hole_radius, end.x());
    }
  }
  for (const Segment& segment : hole) {
    for (const Eigen::Vector2d& end : segment) {
      if (std::abs(end.x() - fit.hole_radius) < kSame) fit.rim_z = std::max(fit.rim_z, end.y());
    }
  }
  if (fit.hole_radius > 2.0 * fit.peg_radius) {
    throw command::Failure(command::ExitCode::kBadData,
                           "the still mesh of a peg's scene has no hole about z; name a scene of a peg along z");
  }
  return fit;
}

}  // namespace godobject::report
