#include "toolchain/report/assembly/thread_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace godobject::report {
namespace {

using scene_compiler::TriangleMesh;
using Index = std::uint32_t;

/// A corner of a thread's profile: height within a pitch, and radius.
using Corner = std::pair<double, double>;

/// A surface of revolution-like columns: column j holds the vertices at angle 2 pi j / around, from low to high.
struct ScrewSurface {
  int around = 0;
  Index rows = 0;
};

/// Adds the vertices of a helical surface between two heights. Corners beyond an end move to it, with the profile's
/// radius there. The last column is the first, one pitch lower.
ScrewSurface add_vertices(const std::vector<Corner>& profile, double pitch, int around, double low, double high,
                          TriangleMesh& mesh) {
  const auto radius_at = [&](double u) {
    u -= pitch * std::floor(u / pitch);
    for (std::size_t i = 0; i < profile.size(); ++i) {
      const Corner& from = profile[i];
      const Corner to = i + 1 < profile.size() ? profile[i + 1] : Corner{profile[0].first + pitch, profile[0].second};
      for (const double shifted : {u, u - pitch}) {
        if (shifted < from.first || shifted > to.first) continue;
        return from.second + (to.second - from.second) * (shifted - from.first) / (to.first - from.first);
      }
    }
    return profile[0].second;
  };
  const int first = static_cast<int>(std::floor(low / pitch)) - 2;
  const int last = static_cast<int>(std::ceil(high / pitch)) + 1;
  for (int j = 0; j < around; ++j) {
    const double angle = 2.0 * std::numbers::pi * j / around;
    const double lift = pitch * j / around;
    for (int turn = first; turn <= last; ++turn) {
      for (const Corner& corner : profile) {
        const double wanted = turn * pitch + corner.first + lift;
        const double z = std::clamp(wanted, low, high);
        const double radius = z == wanted ? corner.second : radius_at(z - lift);
        mesh.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
      }
    }
  }
  return {around, static_cast<Index>((last - first + 1) * static_cast<int>(profile.size()))};
}

/// Adds the triangles between the columns; `outward`: the body is inside.
void add_triangles(const ScrewSurface& surface, Index corners, bool outward, TriangleMesh& mesh) {
  const auto at = [&](int column, Index row) {
    const bool wraps = column == surface.around;
    return static_cast<Index>(wraps ? 0 : column) * surface.rows + row + (wraps ? corners : 0);
  };
  for (int j = 0; j < surface.around; ++j) {
    // the last turn of the last column would be beyond the first column's; all its vertices are at the end
    for (Index k = 0; k + 1 < surface.rows - corners; ++k) {
      const Index a = at(j, k), b = at(j + 1, k), c = at(j + 1, k + 1), d = at(j, k + 1);
      if (outward) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
      } else {
        mesh.triangles.push_back({a, c, b});
        mesh.triangles.push_back({a, d, c});
      }
    }
  }
}

}  // namespace

TriangleMesh bolt_mesh(const Thread& thread, double length) {
  const double flank = (thread.crest - thread.root) * std::tan(thread.flank_angle);
  const double half = 0.5 * thread.crest_width;
  const std::vector<Corner> profile = {
      {-half - flank, thread.root}, {-half, thread.crest}, {half, thread.crest}, {half + flank, thread.root}};
  TriangleMesh mesh;
  const ScrewSurface surface = add_vertices(profile, thread.pitch, thread.around, 0.0, length, mesh);
  add_triangles(surface, static_cast<Index>(profile.size()), true, mesh);
  const auto bottom = static_cast<Index>(mesh.vertices.size());
  mesh.vertices.emplace_back(0.0, 0.0, 0.0);
  mesh.vertices.emplace_back(0.0, 0.0, length);
  for (int j = 0; j < thread.around; ++j) {
    const Index here = static_cast<Index>(j) * surface.rows;
    const Index next = static_cast<Index>((j + 1) % thread.around) * surface.rows;
    mesh.triangles.push_back({bottom, next, here});
    mesh.triangles.push_back({bottom + 1, here + surface.rows - 1, next + surface.rows - 1});
  }
  return mesh;
}

TriangleMesh nut_mesh(const Thread& thread, double outer_radius, double low, double high) {
  const double minor = thread.root + thread.radial_play;
  const double major = thread.crest + 0.3 * thread.radial_play;
  const double tangent = std::tan(thread.flank_angle);
  // half the width of the bolt's thread at a radius, and half the play
  const auto half_width = [&](double radius) {
    return 0.5 * thread.crest_width + (thread.crest - radius) * tangent + 0.5 * thread.axial_play;
  };
  const std::vector<Corner> profile = {
      {-half_width(minor), minor}, {-half_width(major), major}, {half_width(major), major}, {half_width(minor), minor}};
  TriangleMesh mesh;
  const ScrewSurface surface = add_vertices(profile, thread.pitch, thread.around, low, high, mesh);
  add_triangles(surface, static_cast<Index>(profile.size()), false, mesh);
  const auto outer = static_cast<Index>(mesh.vertices.size());
  for (int j = 0; j < thread.around; ++j) {
    const double angle = 2.0 * std::numbers::pi * j / thread.around;
    for (const double z : {low, high}) {
      mesh.vertices.emplace_back(outer_radius * std::cos(angle), outer_radius * std::sin(angle), z);
    }
  }
  for (int j = 0; j < thread.around; ++j) {
    const auto next = static_cast<Index>((j + 1) % thread.around);
    const auto here = static_cast<Index>(j);
    const Index o0 = outer + 2 * here, o1 = o0 + 1, n0 = outer + 2 * next, n1 = n0 + 1;
    const Index i0 = here * surface.rows, i1 = i0 + surface.rows - 1;
    const Index m0 = next * surface.rows, m1 = m0 + surface.rows - 1;
    for (const auto& t :
         {std::array<Index, 3>{o0, n0, n1}, {o0, n1, o1}, {i0, m0, n0}, {i0, n0, o0}, {i1, o1, n1}, {i1, n1, m1}}) {
      mesh.triangles.push_back(t);
    }
  }
  return mesh;
}

}  // namespace godobject::report
