#include "toolchain/page/scene_header.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/scene_compiler/mesh/mass_properties.h"
#include "toolchain/scene_compiler/mesh/mesh_edges.h"
#include "toolchain/scene_compiler/scene_config.h"

namespace godobject::page {
namespace {

using command::ExitCode;
using command::Failure;
using nlohmann::json;
using scene_compiler::TriangleMesh;

constexpr double kQuantisation = 65535;  // steps along an edge of a mesh's bounding box

json array_of(const Vector3& v) { return {v.x(), v.y(), v.z()}; }

/// Returns the entry of a body in the header.
json body_entry(const TriangleMesh& mesh, const std::string& name, ColumnPack& pack) {
  if (mesh.triangles.size() > kMaxTriangles) {
    throw Failure(ExitCode::kBadData, fmt::format("{}: has {} triangles, a page shows at most {}; write a scene file "
                                                  "with a decimated mesh for the page",
                                                  name, mesh.triangles.size(), kMaxTriangles));
  }
  Vector3 low = mesh.vertices.front();
  Vector3 high = low;
  for (const Vector3& vertex : mesh.vertices) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  json entry{{"name", name}, {"low", array_of(low)}, {"high", array_of(high)}};
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> offsets;
    for (const Vector3& vertex : mesh.vertices) offsets.push_back(vertex[axis] - low[axis]);
    const double step = std::max((high[axis] - low[axis]) / kQuantisation, 1e-12);  // a flat mesh
    entry["vertices"].push_back(pack.add(offsets, step));
  }
  std::vector<std::uint32_t> corners;
  for (const auto& triangle : mesh.triangles) corners.insert(corners.end(), triangle.begin(), triangle.end());
  entry["triangles"] = pack.add(corners);
  const bool closed = scene_compiler::MeshEdges(mesh).closed();
  entry["closed"] = closed;
  entry["centre"] = array_of(scene_compiler::centre_of_mass(mesh, closed));
  return entry;
}

json camera_entry(const PageBodies& scene, std::vector<viewer::Placement> shown, double zoom) {
  const viewer::Camera camera = viewer::make_camera({.still = scene.bodies.still,
                                                     .moving = scene.bodies.moving,
                                                     .placements = std::move(shown),
                                                     .up_axis = scene.up_axis,
                                                     .zoom = zoom,
                                                     .direction = {}});
  return {{"eye", array_of(camera.eye)}, {"target", array_of(camera.target)}, {"half_view", viewer::kHalfView}};
}

std::string length_bytes(std::size_t length) {
  std::string bytes;
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>((length >> (8 * i)) & 0xffu);
  return bytes;
}

}  // namespace

PageBodies read_page_bodies(const std::filesystem::path& scene_file) {
  const auto config = scene_compiler::read_scene_config(scene_file);
  return {.bodies = viewer::read_scene_bodies(scene_file),
          .still_name = config.still.file.stem().string(),
          .moving_name = config.moving.file.stem().string(),
          .workspace = config.workspace};
}

json scene_header(const PageBodies& scene, std::vector<viewer::Placement> shown, ColumnPack& pack, double zoom) {
  json header;
  header["up"] = scene.up_axis;
  header["still"] = body_entry(scene.bodies.still, scene.still_name, pack);
  header["moving"] = body_entry(scene.bodies.moving, scene.moving_name, pack);
  if (scene.workspace) header["workspace"] = {{"low", scene.workspace->low}, {"high", scene.workspace->high}};
  header["camera"] = camera_entry(scene, std::move(shown), zoom);
  return header;
}

std::string packed(const json& header, const ColumnPack& pack) {
  const std::string text = header.dump(-1, ' ', true, json::error_handler_t::replace);
  return length_bytes(text.size()) + text + pack.bytes();
}

}  // namespace godobject::page
