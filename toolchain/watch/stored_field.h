#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/scene/format.h"
#include "toolchain/watch/oracle.h"

namespace godobject::watch {

/// The sections of a scene image that a field stands in: those of the still body, or those of the moving body.
struct FieldSections {
  format::SectionId grid, index, bricks, refined, exact, facets, facet_sets, facet_numbers;
};
inline constexpr FieldSections kStillField{format::SectionId::kGrid,        format::SectionId::kBrickIndex,
                                           format::SectionId::kBricks,      format::SectionId::kRefined,
                                           format::SectionId::kExactBricks, format::SectionId::kFacets,
                                           format::SectionId::kFacetSets,   format::SectionId::kFacetNumbers};
inline constexpr FieldSections kBodyField{format::SectionId::kBodyGrid,        format::SectionId::kBodyBrickIndex,
                                          format::SectionId::kBodyBricks,      format::SectionId::kBodyRefined,
                                          format::SectionId::kBodyExactBricks, format::SectionId::kBodyFacets,
                                          format::SectionId::kBodyFacetSets,   format::SectionId::kBodyFacetNumbers};

/// A stored field, read from the bytes of an image as core/scene/format.h describes them. It shares no code with
/// Voxelmap: look-ups are plain double precision, one at a time.
class StoredField final : public Oracle {
 public:
  /// `image` is valid and outlives the field. Throws std::runtime_error if it lacks the sections.
  StoredField(std::span<const std::byte> image, const FieldSections& sections);

  double distance(const Vector3& p) const override { return slope(p).distance; }
  Vector3 gradient(const Vector3& p) const override { return slope(p).gradient; }
  Slope slope(const Vector3& p) const override;
  double lipschitz() const override { return lipschitz_; }
  double band() const { return grid_.band; }
  double voxel_size() const { return grid_.voxel_size; }

 private:
  /// A brick, and the point in it, in cells of that brick.
  struct Place {
    const format::Brick* brick = nullptr;
    bool is_exact = false;
    double unit = 0.0;  ///< of the brick's values [m]
    double cell = 0.0;  ///< edge of the brick's cells [m]
    Vector3 at = Vector3::Zero();
  };

  /// The edge of a facet from its vertex k, with the normals of both.
  struct Edge {
    Vector3 from;
    Vector3 along;   ///< unit
    double length;   ///< [m]
    Vector3 inward;  ///< in the facet's plane
    Vector3 normal;  ///< of the edge
    Vector3 vertex_normal;
  };
  struct Facet {
    Vector3 up;  ///< unit
    std::array<Edge, 3> edges;
  };

  static Facet measured(const format::Facet& facet);
  Place descend(std::uint32_t entry, Vector3 at) const;
  static Slope interpolate(const Place& place);
  Slope blend(const Place& place, const Vector3& p, const Slope& interpolated) const;
  Slope from_facets(const format::FacetSet& set, const Vector3& p) const;
  double steepest() const;

  format::Grid grid_;
  std::span<const std::uint32_t> index_;
  std::span<const format::Brick> bricks_;
  std::span<const format::Refined> refined_;
  std::vector<Facet> facets_;
  std::span<const format::FacetSet> facet_sets_;
  std::span<const std::uint32_t> facet_numbers_;
  std::span<const format::ExactBrick> exact_;
  double lipschitz_ = 1.0;
};

}  // namespace godobject::watch
