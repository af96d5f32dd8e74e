#include "toolchain/scene_compiler/mesh/outer_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "toolchain/parallel/parallel.h"
#include "toolchain/scene_compiler/mesh/triangle_tree.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;

/// Of the bounding box's diagonal: above the rounding of vertices, below the thickness of walls.
constexpr double kOffset = 1e-6;
/// Least winding number outside is minus this. A flat open sheet has exactly -0.5 there, and 0.5 inside.
constexpr double kMostNegative = 0.49;
constexpr double kLeastOuterPart = 4e-3;  // Chosen; of the area. A mesh with less outer surface counts as one without.
constexpr std::uint64_t kBlock = 1u << 16;  // draws for each report of progress
constexpr std::size_t kRun = 256;           // samples that one thread tests in a row
constexpr std::size_t kPieces = 64;         // pieces of the surface that one thread samples in a row
/// Spacings: sqrt(2), rounded down. Halving a longer side leaves at least 0.7 spacings.
constexpr double kLongestCell = 1.4;
/// Squared spacings: a quarter of the largest cell's area. Smaller cells get a draw in proportion to their area.
constexpr double kLeastCell = 0.5;

/// Returns a number in 0 .. 1 for each (seed, index, dimension). A hash (splitmix64) allows draws in any order.
double uniform(std::uint64_t seed, std::uint64_t index, std::uint64_t dimension) {
  std::uint64_t x = (seed << 48) + 3 * index + dimension + 1;
  x *= 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  x ^= x >> 31;
  return static_cast<double>(x >> 11) * 0x1p-53;
}

}  // namespace

OuterSurface::OuterSurface(const SolidSurface& surface)
    : surface_(surface),
      body_(surface),
      patches_(body_),
      sharp_(sharp_features(body_)),
      step_(kOffset * body_.diagonal) {}

bool OuterSurface::is_outer(const SurfaceSample& sample, Known& known) const {
  if (!surface_.shell_triangles().empty()) {
    const double half = body_.half_thickness;
    if (surface_.distance_to_shells(sample.point, half + step_) < half - step_) return false;
  }
  if (surface_.solid_triangles().empty()) return true;
  if (sample.on_shell) return surface_.winding_number(sample.point) < 0.5;
  const Vector3d off = sample.point - step_ * sample.inward;
  const Vector3d path = known.point - off;
  TriangleTree::RayHit hit{};
  if (path.norm() < known.free_path && !surface_.solid_triangles().first_hit(off, path, 0.0, 1.0, hit)) {
    if (surface_.sealed()) known.point = off;
    return known.outer;
  }
  if (known.free_path > 0.0 && surface_.sealed()) {
    if (const auto change = surface_.solid_triangles().winding_change(known.point, off)) {
      known.point = off;
      known.winding += *change;
      known.outer = known.winding == 0;
      return known.outer;
    }
  }
  // through its own triangle the winding number grows by one. It passes one half if it was within one half of zero.
  const double outside = surface_.winding_number(off);
  const double margin = std::min(std::abs(outside - 0.5), std::abs(outside + kMostNegative));
  known = {off, surface_.constant_side_path(off, 0.5 - margin), outside > -kMostNegative && outside < 0.5,
           static_cast<int>(std::lround(outside))};
  return known.outer;
}

std::vector<std::uint8_t> OuterSurface::are_outer(std::span<const SurfaceSample> samples) const {
  std::vector<std::uint8_t> outer(samples.size());
  parallel::for_each_chunk(samples.size(), kRun,
                           [&](std::size_t begin, std::size_t end) {
                             Known known;
                             for (std::size_t i = begin; i < end; ++i) outer[i] = is_outer(samples[i], known) ? 1 : 0;
                           },
                           {});
  return outer;
}

void OuterSurface::append_outer(const std::vector<SurfaceSample>& candidates,
                                std::vector<SurfaceSample>& samples) const {
  const std::vector<std::uint8_t> outer = are_outer(candidates);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (outer[i]) samples.push_back(candidates[i]);
  }
}

std::vector<SurfaceSample> OuterSurface::draw(const Draws& draws, std::uint64_t begin, std::uint64_t end) const {
  std::vector<SurfaceSample> samples;
  for (std::uint64_t i = begin; i < end; ++i) {
    const double at = (static_cast<double>(i) + uniform(draws.seed, i, 0)) / static_cast<double>(draws.count);
    samples.push_back(patches_.draw(at, uniform(draws.seed, i, 1), uniform(draws.seed, i, 2)));
  }
  return samples;
}

std::vector<SurfaceSample> OuterSurface::draw_all(std::uint32_t count, std::uint32_t seed) const {
  return draw({count, 2 * std::uint64_t{seed}}, 0, count);
}

std::vector<SurfaceSample> OuterSurface::draw_near(double spacing, std::uint32_t seed,
                                                   const std::function<bool(const Vector3d&, double)>& near) const {
  const CellDraws draws{spacing, 2 * std::uint64_t{seed}, near};
  const std::size_t parts = patches_.size() / kPieces + 1;
  std::vector<std::vector<SurfaceSample>> samples(parts);
  parallel::for_each_index(parts, [&](std::size_t part) {
    const std::size_t end = std::min((part + 1) * kPieces, patches_.size());
    for (std::size_t piece = part * kPieces; piece < end; ++piece) {
      draw_cell({piece, 0.0, 0.0, 1.0, 1.0}, draws, samples[part]);
    }
  });
  std::vector<SurfaceSample> all;
  for (const std::vector<SurfaceSample>& some : samples) all.insert(all.end(), some.begin(), some.end());
  return all;
}

/// Draws in one cell. Of pieces much smaller than the spacing only some get a draw.
void OuterSurface::draw_cell(const Cell& cell, const CellDraws& draws, std::vector<SurfaceSample>& samples) const {
  const auto point = [&](double u, double v) {
    return patches_.at(cell.piece, cell.u + u * cell.size_u, cell.v + v * cell.size_v).point;
  };
  const std::array<Vector3d, 4> corners{point(0.0, 0.0), point(1.0, 0.0), point(0.0, 1.0), point(1.0, 1.0)};
  const Vector3d center = 0.25 * (corners[0] + corners[1] + corners[2] + corners[3]);
  double radius = 0.0;
  for (const Vector3d& corner : corners) radius = std::max(radius, (corner - center).norm());
  if (!draws.near(center, radius)) return;
  const double along_u = std::max((corners[1] - corners[0]).norm(), (corners[3] - corners[2]).norm());
  const double along_v = std::max((corners[2] - corners[0]).norm(), (corners[3] - corners[1]).norm());
  if (std::max(along_u, along_v) > kLongestCell * draws.spacing) {
    Cell half = cell;
    const bool across_u = along_u > along_v;
    (across_u ? half.size_u : half.size_v) *= 0.5;
    draw_cell(half, draws, samples);
    (across_u ? half.u : half.v) += across_u ? half.size_u : half.size_v;
    draw_cell(half, draws, samples);
    return;
  }
  const auto key =
      static_cast<std::uint64_t>((cell.u + cell.v * 0.754877666) * 0x1p40) + (std::uint64_t{cell.piece} << 20);
  const double area = patches_.area(cell.piece) * cell.size_u * cell.size_v;
  if (uniform(draws.seed, key, 0) * kLeastCell * draws.spacing * draws.spacing > area) return;
  samples.push_back(patches_.at(cell.piece, cell.u + uniform(draws.seed, key, 1) * cell.size_u,
                                cell.v + uniform(draws.seed, key, 2) * cell.size_v));
}

void OuterSurface::draw_outer(const Draws& draws, const parallel::Progress& progress,
                              std::vector<SurfaceSample>& samples) const {
  for (std::uint64_t begin = 0; begin < draws.count; begin += kBlock) {
    const std::uint64_t end = std::min(begin + kBlock, draws.count);
    append_outer(draw(draws, begin, end), samples);
    if (progress) progress(static_cast<double>(end) / static_cast<double>(draws.count));
  }
}

OuterSurface::Spread OuterSurface::spread(std::uint32_t wanted, std::uint32_t seed,
                                          const parallel::Progress& progress) const {
  Spread spread;
  std::uint64_t drawn = wanted;
  if (patches_.area() > 0.0) draw_outer({drawn, 2 * std::uint64_t{seed}}, progress, spread.samples);
  const double outer_part = static_cast<double>(spread.samples.size()) / static_cast<double>(drawn);
  if (outer_part < kLeastOuterPart) {
    throw std::runtime_error(
        "no outer surface found: the mesh neither encloses a solid nor is taken as a thin sheet; set moving.surface = "
        "\"shell\", or close the mesh");
  }
  if (spread.samples.size() < wanted) {
    const double missing = static_cast<double>(wanted) - static_cast<double>(spread.samples.size());
    const auto more = static_cast<std::uint64_t>(std::ceil(missing / outer_part * 1.05)) + 1;
    draw_outer({more, 2 * std::uint64_t{seed} + 1}, progress, spread.samples);
    drawn += more;
  }
  spread.area = patches_.area() * static_cast<double>(spread.samples.size()) / static_cast<double>(drawn);
  return spread;
}

SurfaceSample OuterSurface::sharp_sample(const Vector3d& at, const Vector3d& outward, bool in_shell,
                                         SurfaceSample::Place place) const {
  const double off = in_shell ? body_.half_thickness : 0.0;
  return {at + off * outward, -outward, place, in_shell};
}

std::vector<SurfaceSample> OuterSurface::sharp_samples(double step, std::uint32_t most) const {
  const std::vector<Vector3d>& vertices = body_.mesh.vertices;
  std::vector<SurfaceSample> candidates;
  const std::size_t stride = sharp_.vertices.size() / most + 1;
  for (std::size_t i = 0; i < sharp_.vertices.size(); i += stride) {
    const SharpVertex& sharp = sharp_.vertices[i];
    candidates.push_back(
        sharp_sample(vertices[sharp.vertex], sharp.outward, sharp.in_shell, SurfaceSample::Place::kVertex));
  }
  double length = 0.0;
  for (const SharpEdge& edge : sharp_.edges) length += (vertices[edge.high] - vertices[edge.low]).norm();
  const double spacing = std::max(step, length / most);
  double travelled = 0.5 * spacing;  // along all edges since the last sample
  for (const SharpEdge& edge : sharp_.edges) {
    const Vector3d along = vertices[edge.high] - vertices[edge.low];
    const double edge_length = along.norm();
    double at = spacing - travelled;
    for (; at < edge_length; at += spacing) {
      const Vector3d point = vertices[edge.low] + at / edge_length * along;
      candidates.push_back(sharp_sample(point, edge.outward, edge.in_shell, SurfaceSample::Place::kEdge));
    }
    travelled = edge_length - (at - spacing);
  }
  std::vector<SurfaceSample> samples;
  append_outer(candidates, samples);
  return samples;
}

}  // namespace godobject::scene_compiler
