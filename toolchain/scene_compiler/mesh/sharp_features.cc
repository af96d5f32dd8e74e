#include "toolchain/scene_compiler/mesh/sharp_features.h"

#include <array>

#include <Eigen/Geometry>

#include "toolchain/scene_compiler/mesh/mesh_normals.h"

namespace godobject::scene_compiler {
namespace {

using Eigen::Vector3d;

/// The sharp edges that meet at one vertex.
struct Meeting {
  int edges = 0;
  std::array<Vector3d, 2> directions{Vector3d::Zero(),
                                     Vector3d::Zero()};  ///< along the first two, away from the vertex
  Vector3d outward = Vector3d::Zero();                   ///< sum of the edges' outward directions

  bool corner() const { return edges > 2 || (edges == 2 && directions[0].dot(directions[1]) > -kCreaseCosine); }

  void add(const Vector3d& direction, const Vector3d& edge_outward) {
    if (edges < 2) directions[static_cast<std::size_t>(edges)] = direction;
    ++edges;
    outward += edge_outward;
  }
};

/// Returns the outward direction of an edge; zero if it is not sharp.
Vector3d outward_of_edge(const BodyMesh& body, const MeshEdges::Edge& edge) {
  const auto sides = body.edges.sides(edge);
  const bool in_shell = body.in_shell[sides[0].triangle];
  if (sides.size() > 2 || (sides.size() == 1 && !in_shell)) return Vector3d::Zero();
  const Vector3d first = away_from_triangle(body.mesh, edge, sides[0]);
  if (sides.size() == 1) return first;
  const Vector3d second = away_from_triangle(body.mesh, edge, sides[1]);
  if (first.squaredNorm() == 0.0 || second.squaredNorm() == 0.0) return Vector3d::Zero();
  if (first.dot(second) <= -kCreaseCosine) return Vector3d::Zero();
  const Vector3d outward = (first + second).normalized();  // on the side of more than 180 degrees
  const Vector3d normals = body.face_normals[sides[0].triangle] + body.face_normals[sides[1].triangle];
  return in_shell || normals.dot(outward) > 0.0 ? outward : Vector3d::Zero();
}

/// Returns the outward direction of a vertex without sharp edges if its faces are steep all around it; otherwise zero.
Vector3d outward_of_apex(const BodyMesh& body, std::span<const std::size_t> corners) {
  const TriangleMesh& mesh = body.mesh;
  const std::uint32_t vertex = mesh.triangles[corners[0] / 3][corners[0] % 3];
  Vector3d sum = Vector3d::Zero();
  for (const std::size_t c : corners) sum += corner_angle(mesh, c / 3, c % 3) * body.face_normals[c / 3];
  const Vector3d outward = sum.stableNormalized();
  bool any_above = false;
  bool any_below = false;
  for (const std::size_t c : corners) {
    if (body.face_normals[c / 3].dot(outward) >= kCreaseCosine) return Vector3d::Zero();
    for (const std::uint32_t other : mesh.triangles[c / 3]) {
      if (other == vertex) continue;
      const bool above = (mesh.vertices[other] - mesh.vertices[vertex]).dot(outward) > 0.0;
      any_above |= above;
      any_below |= !above;
    }
  }
  if (any_above && any_below) return Vector3d::Zero();
  if (any_below) return outward;
  return body.in_shell[corners[0] / 3] ? Vector3d(-outward) : Vector3d::Zero();
}

}  // namespace

Vector3d away_from_triangle(const TriangleMesh& mesh, const MeshEdges::Edge& edge, const MeshEdges::Side& side) {
  const Vector3d& low = mesh.vertices[edge.low];
  const Vector3d along = (mesh.vertices[edge.high] - low).stableNormalized();
  const Vector3d to_triangle = mesh.vertices[side.opposite] - low;
  return (along.dot(to_triangle) * along - to_triangle).stableNormalized();
}

SharpFeatures sharp_features(const BodyMesh& body) {
  const TriangleMesh& mesh = body.mesh;
  SharpFeatures features;
  std::vector<Meeting> meetings(mesh.vertices.size());
  for (const MeshEdges::Edge& edge : body.edges.all()) {
    const Vector3d outward = outward_of_edge(body, edge);
    if (outward.squaredNorm() == 0.0) continue;
    const auto sides = body.edges.sides(edge);
    SharpEdge sharp{
        edge.low, edge.high, outward, {Vector3d::Zero(), Vector3d::Zero()}, body.in_shell[sides[0].triangle]};
    for (std::size_t k = 0; k < 2 && !sharp.in_shell; ++k) sharp.normals[k] = body.face_normals[sides[k].triangle];
    features.edges.push_back(sharp);
    const Vector3d along = (mesh.vertices[edge.high] - mesh.vertices[edge.low]).stableNormalized();
    meetings[edge.low].add(along, outward);
    meetings[edge.high].add(-along, outward);
  }
  const VertexCorners around(mesh);
  for (std::uint32_t vertex = 0; vertex < mesh.vertices.size(); ++vertex) {
    const auto corners = around.of(vertex);
    if (corners.empty()) continue;
    const Meeting& meeting = meetings[vertex];
    Vector3d outward = Vector3d::Zero();
    if (meeting.edges == 0) outward = outward_of_apex(body, corners);
    if (meeting.corner()) outward = meeting.outward.stableNormalized();
    if (outward.squaredNorm() > 0.0) features.vertices.push_back({vertex, outward, body.in_shell[corners[0] / 3]});
  }
  return features;
}

}  // namespace godobject::scene_compiler
