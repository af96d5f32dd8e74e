#include "toolchain/scene_compiler/trimming/reachable_bricks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "toolchain/command_line/failure.h"
#include "toolchain/scene_compiler/field/brick_lattice.h"
#include "toolchain/scene_compiler/field/exact_bricks.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;
using format::kBrickCells;
namespace index_entry = format::index_entry;

/// The entries that stay, renumbered in the order of a walk through the index.
class Selection {
 public:
  explicit Selection(DistanceGrid& field) : field_(field), keeps_(field.bricks.size(), true) {}

  /// Drops a stored position with all its octants.
  void drop(std::uint32_t entry, LeftOutBricks& left_out, std::size_t halvings = 0) {
    if ((entry & index_entry::kFar) != 0) return;
    const std::uint32_t number = entry & index_entry::kNumber;
    if ((entry & index_entry::kRefined) == 0) {
      keeps_[number] = false;
      ++left_out.bricks[halvings];
      return;
    }
    const format::Refined& refined = field_.refined[number];
    if (refined.brick != format::kNoBrick) keeps_[refined.brick] = false;
    ++left_out.refined;
    bool looked_up = false;  // in its own nodes too
    for (const std::uint32_t child : refined.child) {
      looked_up |= (child & index_entry::kCoarse) != 0;
      drop(child, left_out, halvings + 1);
    }
    if (looked_up) ++left_out.bricks[halvings];
  }

  /// Renumbers the field. `field.index` must name exactly the entries that stay.
  void apply(LeftOutBricks& left_out) {
    number_bricks(left_out);
    const std::size_t exact = field_.exact.size();
    const std::size_t facets = field_.facets.size();
    const std::size_t sets = field_.facet_sets.size();
    const std::size_t numbers = field_.facet_numbers.size();
    leave_out_unnamed(field_);
    left_out.exact = exact - field_.exact.size();
    left_out.facets = facets - field_.facets.size();
    left_out.sets = sets - field_.facet_sets.size();
    left_out.numbers = numbers - field_.facet_numbers.size();
    std::vector<format::Refined> refined;
    for (std::uint32_t& entry : field_.index) entry = renumbered(entry, refined);
    field_.refined = std::move(refined);
    field_.grid.brick_count = static_cast<std::uint32_t>(field_.bricks.size());
  }

 private:
  void number_bricks(LeftOutBricks& left_out) {
    number_.resize(keeps_.size());
    std::vector<Brick> bricks;
    std::vector<bool> beside_seam;
    for (std::size_t i = 0; i < keeps_.size(); ++i) {
      if (!keeps_[i]) continue;
      number_[i] = static_cast<std::uint32_t>(bricks.size());
      bricks.push_back(field_.bricks[i]);
      if (i < field_.beside_seam.size()) beside_seam.push_back(field_.beside_seam[i]);
    }
    left_out.all_bricks = keeps_.size() - bricks.size();
    field_.bricks = std::move(bricks);
    field_.beside_seam = std::move(beside_seam);
  }

  std::uint32_t renumbered(std::uint32_t entry, std::vector<format::Refined>& refined) const {
    if ((entry & index_entry::kFar) != 0) return entry;
    const std::uint32_t old = entry & index_entry::kNumber;
    const std::uint32_t kind = entry & ~index_entry::kNumber;
    if ((entry & index_entry::kRefined) == 0) return kind | number_[old];
    const format::Refined& from = field_.refined[old];
    const auto number = static_cast<std::uint32_t>(refined.size());
    refined.push_back(from);
    if (from.brick != format::kNoBrick) refined[number].brick = number_[from.brick];
    for (std::size_t octant = 0; octant < std::size(from.child); ++octant) {
      const std::uint32_t child = renumbered(from.child[octant], refined);
      refined[number].child[octant] = child;
    }
    return kind | number;
  }

  DistanceGrid& field_;
  std::vector<bool> keeps_;            // by brick
  std::vector<std::uint32_t> number_;  // of those that stay
};

}  // namespace

double look_up_radius(const format::Body& body, const std::vector<format::Node>& nodes) {
  double radius = body.radius;
  for (const format::Node& node : nodes) {
    radius = std::max(radius, Eigen::Map<const Eigen::Vector3f>(node.center).cast<double>().norm());
  }
  return radius;
}

namespace {

/// Leaves out all positions whose box, from `low` to `high`, does not satisfy is_met(low, high). False, without a
/// change, if none would stay.
template <class IsMet>
bool leave_out_unmet(DistanceGrid& field, const IsMet& is_met, LeftOutBricks& left_out) {
  const format::Grid& grid = field.grid;
  const BrickLattice lattice{{grid.bricks[0], grid.bricks[1], grid.bricks[2]}};
  const double edge = kBrickCells * grid.voxel_size;
  std::vector<std::size_t> unmet;
  bool any_stays = false;
  for (std::size_t i = 0; i < field.index.size(); ++i) {
    if ((field.index[i] & index_entry::kFar) != 0) continue;
    const BrickPosition p = lattice.position(i);
    const Vector3d low = Eigen::Map<const Vector3d>(grid.origin) + edge * Vector3d(p[0], p[1], p[2]);
    if (is_met(low, (low.array() + edge).matrix().eval())) {
      any_stays = true;
    } else {
      unmet.push_back(i);
    }
  }
  if (!any_stays) return false;
  Selection selection(field);
  for (const std::size_t i : unmet) {
    selection.drop(field.index[i], left_out);
    field.index[i] = index_entry::encode_far(true, 0.0f);
    ++left_out.positions;
  }
  selection.apply(left_out);
  return true;
}

double distance_to(const format::Workspace& workspace, const Vector3d& p) {
  const Eigen::Map<const Vector3d> low(workspace.low);
  const Eigen::Map<const Vector3d> high(workspace.high);
  return (low - p).cwiseMax(p - high).cwiseMax(0.0).norm();
}

}  // namespace

double least_look_up(const StillFeatures& features, const format::Workspace& workspace, double longest_path) {
  const Vector3d origin = Eigen::Map<const Vector3d>(features.header.origin);
  double least = std::numeric_limits<double>::infinity();
  const auto look = [&](const Eigen::Vector3f& p) {
    least = std::min(least, distance_to(workspace, origin + p.cast<double>()));
  };
  const std::size_t n = features.points.size() / 3;
  for (std::size_t i = 0; i < n; ++i) look({features.points[i], features.points[n + i], features.points[2 * n + i]});
  for (const format::Node& node : features.nodes) look(Eigen::Map<const Eigen::Vector3f>(node.center));
  return least - 0.5 * longest_path;
}

LeftOutBricks leave_out_unreachable_core(DistanceGrid& body_field, double least) {
  const double stored_from = least - kLookUpSlack * body_field.grid.voxel_size;
  LeftOutBricks left_out;
  leave_out_unmet(
      body_field,
      [&](const Vector3d& low, const Vector3d& high) {
        return low.cwiseAbs().cwiseMax(high.cwiseAbs()).norm() >= stored_from;
      },
      left_out);
  return left_out;
}

LeftOutBricks leave_out_unreachable(DistanceGrid& field, const format::Workspace& workspace, double radius) {
  const Eigen::Map<const Vector3d> low(workspace.low);
  const Eigen::Map<const Vector3d> high(workspace.high);
  const double search_radius = radius + kLookUpSlack * field.grid.voxel_size;
  LeftOutBricks left_out;
  const bool any_stays = leave_out_unmet(
      field,
      [&](const Vector3d& from, const Vector3d& to) {
        return (low - to).cwiseMax(from - high).cwiseMax(0.0).norm() <= search_radius;
      },
      left_out);
  if (!any_stays) {
    throw command::Failure(
        command::ExitCode::kBadConfig,
        "[workspace]: the moving body touches the still one from no place in it; set low and high, in metres in the "
        "still mesh's frame, to the box in which its centre of mass moves");
  }
  return left_out;
}

}  // namespace godobject::scene_compiler
