#pragma once

#include <algorithm>
#include <vector>

#include "core/scene/facets.h"
#include "core/scene/format.h"
#include "tests/support/analytic_shapes.h"
#include "tests/support/image_parts.h"
#include "tests/support/scene_image_builder.h"

namespace godobject::test {

/// Returns a facet that faces along z.
inline format::Facet facet_along_z() {
  format::Facet facet{};
  facet.vertex[1][0] = facet.vertex[2][1] = 0.01;
  set_planes(facet, Vector3::UnitZ());
  for (int k = 0; k < 3; ++k) facet.edge_normal[k][2] = facet.vertex_normal[k][2] = 1.0f;
  return facet;
}

/// Returns a ball of 10 mm with a refined position, a facet and a workspace. The moving body is the same ball, with the
/// box of `points` as its sample points; feature points of the still body are these, shifted by (0.1, 0.2, 0.3) m. So
/// the image has every section of the format.
inline ImageParts whole_image(const SurfaceSamples& points = sample_box(Vector3(0.01, 0.02, 0.03), 3)) {
  using format::SectionId;
  SceneDescription description;
  description.distance = [](const Vector3& p) { return ball_distance(p, 0.01); };
  description.surface_min = Vector3::Constant(-0.01);
  description.surface_max = Vector3::Constant(0.01);
  description.voxel_size = 0.01;
  description.band = 0.01;
  description.settings.safety_distance = 0.005;
  description.points = points.points;
  description.normals = points.normals;
  description.level_count = points.points.size() > 4 ? 3 : 1;
  description.refined = [](const Vector3& center, double size) { return size > 0.03 && center.maxCoeff() < 0.0; };
  description.facet = facet_along_z();
  description.workspace = format::Workspace{{-1.0, -2.0, -3.0}, {1.0, 2.0, -3.0}};
  description.H_MB.rotation = Quaternion(0.5, 0.5, -0.5, 0.5);
  description.H_MB.translation = Vector3(0.1, 0.2, 0.3);
  description.provenance = R"({"still": "ball"})";
  ImageParts image(build_scene_image(description));
  const auto copy = [&image](SectionId from, SectionId to) {
    const std::vector<std::byte> bytes = image[from];
    image[to] = bytes;
  };
  copy(SectionId::kGrid, SectionId::kBodyGrid);
  copy(SectionId::kBrickIndex, SectionId::kBodyBrickIndex);
  copy(SectionId::kBricks, SectionId::kBodyBricks);
  copy(SectionId::kRefined, SectionId::kBodyRefined);
  copy(SectionId::kFacets, SectionId::kBodyFacets);
  copy(SectionId::kExactBricks, SectionId::kBodyExactBricks);
  copy(SectionId::kFacetSets, SectionId::kBodyFacetSets);
  copy(SectionId::kFacetNumbers, SectionId::kBodyFacetNumbers);
  copy(SectionId::kPoints, SectionId::kFeaturePoints);
  copy(SectionId::kNodes, SectionId::kFeatureNodes);
  const auto& body = image.item<format::Body>(SectionId::kBody);
  image.set<format::Features>(SectionId::kFeatures,
                              {{{0.1, 0.2, 0.3}, body.radius, body.point_count, body.node_count, body.level_count, 0}});
  format::SharpEdge edge{};
  edge.end[1][0] = 0.01;
  edge.normal[0][2] = edge.normal[1][1] = 1.0f;
  image.set<format::SharpEdge>(SectionId::kSharpEdges, {edge});
  image.set<format::Node>(SectionId::kSharpEdgeNodes, {{{0.0f, 0.0f, 0.0f}, 0.02f, 1, 0, 1, 0, 1}});
  for (auto& end : edge.end) std::copy_n(body.sphere_center, 3, end);
  format::Node node{{0.0f, 0.0f, 0.0f}, 1e-6f, 1, 0, 1, 0, 1};
  for (int axis = 0; axis < 3; ++axis) node.center[axis] = static_cast<float>(body.sphere_center[axis]);
  image.set<format::SharpEdge>(SectionId::kBodySharpEdges, {edge});
  image.set<format::Node>(SectionId::kBodySharpEdgeNodes, {node});
  return image;
}

}  // namespace godobject::test
