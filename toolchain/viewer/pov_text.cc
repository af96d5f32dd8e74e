#include "toolchain/viewer/pov_text.h"

#include <cmath>
#include <iterator>
#include <vector>

#include <fmt/format.h>

#include "toolchain/scene_compiler/mesh/mesh_normals.h"

namespace godobject::viewer {
namespace {

using scene_compiler::TriangleMesh;

constexpr double kMillimetre = 1e3;

const char* const kHead = R"(#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 20 }
background { rgb <0.90, 0.91, 0.93> }
#default { finish { ambient 0 emission 0.16 diffuse 0.72 specular 0.12 roughness 0.05 } }
#declare Green = texture { pigment { rgb <0.33, 0.60, 0.24> } }
#declare Cut = texture { pigment { rgb <0.62, 0.78, 0.50> } }
#declare Blue = texture { pigment { rgb <0.07, 0.20, 0.72> } finish { specular 0.3 roughness 0.02 } }
#declare Red = texture { pigment { rgbt <0.95, 0.08, 0.06, 0.45> } finish { emission 0.25 } }
)";

std::string vector(const Vector3& v) { return fmt::format("<{:.6g},{:.6g},{:.6g}>", v.x(), v.y(), v.z()); }

/// Returns the declaration of a mesh with smooth faces and sharp creases.
std::string declare(const char* name, const TriangleMesh& mesh) {
  const auto faces = scene_compiler::face_normals(mesh);
  const auto corners = scene_compiler::corner_normals(mesh, faces);
  std::string text = fmt::format("#declare {} = mesh2 {{\nvertex_vectors {{ {}", name, mesh.vertices.size());
  const auto out = std::back_inserter(text);
  for (const Vector3& v : mesh.vertices) fmt::format_to(out, ",\n{}", vector(kMillimetre * v));
  fmt::format_to(out, " }}\nnormal_vectors {{ {}", 3 * mesh.triangles.size());
  for (const auto& corner : corners) {
    for (const Vector3& n : corner) fmt::format_to(out, ",\n{}", vector(n));
  }
  fmt::format_to(out, " }}\nface_indices {{ {}", mesh.triangles.size());
  for (const auto& t : mesh.triangles) fmt::format_to(out, ",\n<{},{},{}>", t[0], t[1], t[2]);
  fmt::format_to(out, " }}\nnormal_indices {{ {}", mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    fmt::format_to(out, ",\n<{},{},{}>", 3 * i, 3 * i + 1, 3 * i + 2);
  fmt::format_to(out, " }}\ninside_vector <0.12,0.31,0.94>\n}}\n");
  return text;
}

/// Returns the mesh with every vertex moved inward by a share of the diagonal.
TriangleMesh shrunk(const TriangleMesh& mesh) {
  constexpr double kShare = 1.0 / 500.0;
  const auto faces = scene_compiler::face_normals(mesh);
  std::vector<Vector3> normals(mesh.vertices.size(), Vector3::Zero());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t c = 0; c < 3; ++c)
      normals[mesh.triangles[t][c]] += scene_compiler::corner_angle(mesh, t, c) * faces[t];
  }
  Vector3 low = mesh.vertices.front();
  Vector3 high = low;
  for (const Vector3& v : mesh.vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  TriangleMesh small = mesh;
  for (std::size_t i = 0; i < normals.size(); ++i)
    small.vertices[i] -= kShare * (high - low).norm() * normals[i].stableNormalized();
  return small;
}

/// Returns the pose as POV-Ray's matrix; POV-Ray multiplies row vectors, so the rotation is transposed.
std::string matrix(const Pose& pose) {
  const Matrix3 r = pose.rotation.normalized().toRotationMatrix();
  const Vector3 t = kMillimetre * pose.translation;
  return fmt::format("matrix <{:.9g},{:.9g},{:.9g}, {:.9g},{:.9g},{:.9g}, {:.9g},{:.9g},{:.9g}, {:.9g},{:.9g},{:.9g}>",
                     r(0, 0), r(1, 0), r(2, 0), r(0, 1), r(1, 1), r(2, 1), r(0, 2), r(1, 2), r(2, 2), t.x(), t.y(),
                     t.z());
}

/// Returns the camera. All its vectors are given, so that POV-Ray's left-handed defaults do not apply.
std::string camera_text(const Camera& camera, int width, int height) {
  const double side = 2.0 * std::tan(kHalfView);
  const double across = width >= height ? side * width / height : side;
  const double upright = width >= height ? side : side * height / width;
  return fmt::format("camera {{ location {} direction {} right {} up {} }}\n", vector(kMillimetre * camera.eye),
                     vector(camera.forward), vector(across * camera.right), vector(upright * camera.up));
}

/// Returns the lights: a broad key light from above the left shoulder, and a weak one from the right without shadows.
std::string lights(const Camera& camera) {
  const Vector3 back = -camera.forward;
  const double distance = (camera.eye - camera.target).norm();
  const Vector3 key = camera.target + distance * (0.8 * back - 0.7 * camera.right + 1.3 * camera.up);
  const Vector3 fill = camera.target + distance * (0.7 * back + 1.2 * camera.right + 0.1 * camera.up);
  return fmt::format(
      "light_source {{ {} rgb 0.85 area_light {} {} 5 5 adaptive 1 circular orient }}\nlight_source {{ {} rgb 0.40 "
      "shadowless }}\n",
      vector(kMillimetre * key), vector(kMillimetre * 0.4 * distance * camera.right),
      vector(kMillimetre * 0.4 * distance * camera.up), vector(kMillimetre * fill));
}

std::string still_object(const std::optional<Cut>& cut) {
  if (!cut) return "object { Still texture { Green } }\n";
  return fmt::format(
      "intersection {{ object {{ Still texture {{ Green }} }} plane {{ {}, {:.6g} texture {{ Cut }} }} }}\n",
      vector(cut->normal), kMillimetre * cut->normal.dot(cut->point));
}

}  // namespace

std::string pov_text(const TriangleMesh& still, const TriangleMesh& moving, const Picture& picture) {
  std::string text = kHead;
  text += camera_text(picture.camera, picture.width, picture.height);
  text += lights(picture.camera);
  text += declare("Still", still);
  text += declare("Moving", moving);
  text += declare("Ghost", shrunk(moving));
  text += still_object(picture.cut);
  text += fmt::format("object {{ Moving {} texture {{ Blue }} }}\n", matrix(picture.placement.H_WS));
  text += fmt::format("object {{ Ghost {} texture {{ Red }} no_shadow }}\n", matrix(picture.placement.H_WD));
  return text;
}

}  // namespace godobject::viewer
