#include "toolchain/report/contact_quality/meshes.h"

#include <map>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "toolchain/files/atomic_file.h"

namespace godobject::report {
namespace {

using Index = std::uint32_t;

void add_quad(TriangleMesh& mesh, Index a, Index b, Index c, Index d) {
  mesh.triangles.push_back({a, b, c});
  mesh.triangles.push_back({a, c, d});
}

}  // namespace

TriangleMesh cell_solid(const std::array<std::vector<double>, 3>& planes,
                        const std::function<bool(int, int, int)>& filled) {
  TriangleMesh mesh;
  std::map<std::array<int, 3>, Index> vertices;
  const auto vertex = [&](const std::array<int, 3>& at) {
    const auto [found, fresh] = vertices.try_emplace(at, static_cast<Index>(mesh.vertices.size()));
    if (fresh) {
      mesh.vertices.emplace_back(planes[0][static_cast<std::size_t>(at[0])], planes[1][static_cast<std::size_t>(at[1])],
                                 planes[2][static_cast<std::size_t>(at[2])]);
    }
    return found->second;
  };
  const std::array<int, 3> cells = {static_cast<int>(planes[0].size()) - 1, static_cast<int>(planes[1].size()) - 1,
                                    static_cast<int>(planes[2].size()) - 1};
  const auto is_filled = [&](const std::array<int, 3>& c) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (c[axis] < 0 || c[axis] >= cells[axis]) return false;
    }
    return filled(c[0], c[1], c[2]);
  };
  for (int k = 0; k < cells[2]; ++k) {
    for (int j = 0; j < cells[1]; ++j) {
      for (int i = 0; i < cells[0]; ++i) {
        const std::array<int, 3> cell = {i, j, k};
        if (!is_filled(cell)) continue;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const std::size_t u = (axis + 1) % 3;
          const std::size_t v = (axis + 2) % 3;
          for (const int side : {0, 1}) {
            std::array<int, 3> beyond = cell;
            beyond[axis] += side == 1 ? 1 : -1;
            if (is_filled(beyond)) continue;
            const auto corner = [&](int du, int dv) {
              std::array<int, 3> at = cell;
              at[axis] += side;
              at[u] += du;
              at[v] += dv;
              return vertex(at);
            };
            if (side == 1) {
              add_quad(mesh, corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1));
            } else {
              add_quad(mesh, corner(0, 0), corner(0, 1), corner(1, 1), corner(1, 0));
            }
          }
        }
      }
    }
  }
  return mesh;
}

TriangleMesh box_mesh(const Vector3& low, const Vector3& high) {
  return cell_solid({{{low.x(), high.x()}, {low.y(), high.y()}, {low.z(), high.z()}}},
                    [](int, int, int) { return true; });
}

TriangleMesh profile_solid(std::span<const double> xs, std::span<const double> heights, double bottom,
                           double half_width) {
  TriangleMesh mesh;
  const auto at = [](std::size_t column, Index side, Index top) {
    return 4 * static_cast<Index>(column) + 2 * side + top;
  };
  for (std::size_t i = 0; i < xs.size(); ++i) {
    for (const double y : {-half_width, half_width}) {
      mesh.vertices.emplace_back(xs[i], y, bottom);
      mesh.vertices.emplace_back(xs[i], y, heights[i]);
    }
  }
  for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
    add_quad(mesh, at(i, 0, 1), at(i + 1, 0, 1), at(i + 1, 1, 1), at(i, 1, 1));  // top
    add_quad(mesh, at(i, 0, 0), at(i, 1, 0), at(i + 1, 1, 0), at(i + 1, 0, 0));  // bottom
    add_quad(mesh, at(i, 0, 0), at(i + 1, 0, 0), at(i + 1, 0, 1), at(i, 0, 1));  // -y
    add_quad(mesh, at(i, 1, 0), at(i, 1, 1), at(i + 1, 1, 1), at(i + 1, 1, 0));  // +y
  }
  const std::size_t last = xs.size() - 1;
  add_quad(mesh, at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0));
  add_quad(mesh, at(last, 0, 0), at(last, 1, 0), at(last, 1, 1), at(last, 0, 1));
  return mesh;
}

TriangleMesh turned_solid(std::span<const TurnedCorner> profile, int around) {
  TriangleMesh mesh;
  std::vector<Index> first(profile.size());
  for (std::size_t i = 0; i < profile.size(); ++i) {
    first[i] = static_cast<Index>(mesh.vertices.size());
    const int count = profile[i].radius > 0.0 ? around : 1;
    for (int j = 0; j < count; ++j) {
      const double angle = 2.0 * std::numbers::pi * j / around;
      mesh.vertices.emplace_back(profile[i].radius * std::cos(angle), profile[i].radius * std::sin(angle),
                                 profile[i].z);
    }
  }
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    for (int j = 0; j < around; ++j) {
      const auto here = static_cast<Index>(j);
      const auto next = static_cast<Index>((j + 1) % around);
      const Index low = first[i];
      const Index high = first[i + 1];
      if (profile[i].radius <= 0.0) {
        mesh.triangles.push_back({low, high + next, high + here});
      } else if (profile[i + 1].radius <= 0.0) {
        mesh.triangles.push_back({low + here, low + next, high});
      } else {
        add_quad(mesh, low + here, low + next, high + next, high + here);
      }
    }
  }
  return mesh;
}

TriangleMesh ball_mesh(double radius, int rings) {
  std::vector<TurnedCorner> profile;
  for (int i = 0; i <= rings; ++i) {
    const double polar = std::numbers::pi * i / rings;
    profile.push_back({i == 0 || i == rings ? 0.0 : radius * std::sin(polar), -radius * std::cos(polar)});
  }
  return turned_solid(profile, 2 * rings);
}

TriangleMesh sheet_mesh(double half_edge) {
  const double h = half_edge;
  return {{{-h, -h, 0.0}, {h, -h, 0.0}, {h, h, 0.0}, {-h, h, 0.0}}, {{{0, 1, 2}}, {{0, 2, 3}}}};
}

TriangleMesh moved(TriangleMesh mesh, const Pose& motion) {
  for (Eigen::Vector3d& vertex : mesh.vertices) vertex = motion * vertex;
  return mesh;
}

void write_ply(const TriangleMesh& mesh, const std::filesystem::path& file) {
  files::AtomicFile out(file);
  out.write(
      fmt::format("ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\n"
                  "property double z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
                  mesh.vertices.size(), mesh.triangles.size()));
  for (const auto& v : mesh.vertices) out.write(fmt::format("{} {} {}\n", v.x(), v.y(), v.z()));
  for (const auto& t : mesh.triangles) out.write(fmt::format("3 {} {} {}\n", t[0], t[1], t[2]));
  out.commit();
}

}  // namespace godobject::report
