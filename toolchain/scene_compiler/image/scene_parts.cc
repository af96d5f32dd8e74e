#include "toolchain/scene_compiler/image/scene_parts.h"

#include <span>

#include "toolchain/scene_compiler/field/brick_packing.h"

namespace godobject::scene_compiler {
namespace {

template <class T>
std::vector<std::byte> bytes_of(const std::vector<T>& values) {
  const auto bytes = std::as_bytes(std::span(values));
  return {bytes.begin(), bytes.end()};
}

template <class T>
std::vector<std::byte> bytes_of_one(const T& value) {
  const auto bytes = std::as_bytes(std::span(&value, 1));
  return {bytes.begin(), bytes.end()};
}

}  // namespace

std::vector<SectionBytes> lay_out(const SceneParts& parts) {
  using format::SectionId;
  const DistanceGrid& field = parts.field;
  const MovingBody& body = parts.body;
  const bool holds_paper = (parts.settings.solvers >> static_cast<std::uint32_t>(format::Solver::kPaper) & 1u) != 0;
  std::vector<SectionBytes> sections;
  sections.push_back({SectionId::kSettings, bytes_of_one(parts.settings)});
  if (parts.workspace) sections.push_back({SectionId::kWorkspace, bytes_of_one(*parts.workspace)});
  sections.push_back({SectionId::kGrid, bytes_of_one(field.grid)});
  sections.push_back({SectionId::kBrickIndex, bytes_of(field.index)});
  sections.push_back({SectionId::kBricks, bytes_of(packed_bricks(field))});
  if (!field.refined.empty()) sections.push_back({SectionId::kRefined, bytes_of(field.refined)});
  if (!field.exact.empty()) {
    sections.push_back({SectionId::kFacets, bytes_of(field.facets)});
    sections.push_back({SectionId::kExactBricks, bytes_of(field.exact)});
    sections.push_back({SectionId::kFacetSets, bytes_of(field.facet_sets)});
    sections.push_back({SectionId::kFacetNumbers, bytes_of(field.facet_numbers)});
  }
  sections.push_back({SectionId::kBody, bytes_of_one(body.body)});
  sections.push_back({SectionId::kPoints, bytes_of(body.points)});
  if (!body.normals.empty() && holds_paper) sections.push_back({SectionId::kNormals, bytes_of(body.normals)});
  sections.push_back({SectionId::kNodes, bytes_of(body.nodes)});
  if (!parts.edges.edges.empty() && !parts.body_edges.edges.empty()) {
    sections.push_back({SectionId::kSharpEdges, bytes_of(parts.edges.edges)});
    sections.push_back({SectionId::kSharpEdgeNodes, bytes_of(parts.edges.nodes)});
    sections.push_back({SectionId::kBodySharpEdges, bytes_of(parts.body_edges.edges)});
    sections.push_back({SectionId::kBodySharpEdgeNodes, bytes_of(parts.body_edges.nodes)});
  }
  if (parts.features.points.empty()) return sections;
  sections.push_back({SectionId::kBodyGrid, bytes_of_one(parts.body_field.grid)});
  sections.push_back({SectionId::kBodyBrickIndex, bytes_of(parts.body_field.index)});
  sections.push_back({SectionId::kBodyBricks, bytes_of(packed_bricks(parts.body_field))});
  if (!parts.body_field.refined.empty())
    sections.push_back({SectionId::kBodyRefined, bytes_of(parts.body_field.refined)});
  if (!parts.body_field.exact.empty()) {
    sections.push_back({SectionId::kBodyFacets, bytes_of(parts.body_field.facets)});
    sections.push_back({SectionId::kBodyExactBricks, bytes_of(parts.body_field.exact)});
    sections.push_back({SectionId::kBodyFacetSets, bytes_of(parts.body_field.facet_sets)});
    sections.push_back({SectionId::kBodyFacetNumbers, bytes_of(parts.body_field.facet_numbers)});
  }
  sections.push_back({SectionId::kFeatures, bytes_of_one(parts.features.header)});
  sections.push_back({SectionId::kFeaturePoints, bytes_of(parts.features.points)});
  sections.push_back({SectionId::kFeatureNodes, bytes_of(parts.features.nodes)});
  return sections;
}

}  // namespace godobject::scene_compiler
