#pragma once

#include <array>
#include <vector>

#include "core/scene/format.h"
#include "core/scene/voxelmap.h"
#include "godobject/pose.h"
#include "tests/support/random.h"

namespace godobject::test {

/// The parts of one voxelmap.
struct FieldParts {
  format::Grid grid{};
  std::vector<std::uint32_t> index;
  std::vector<format::Brick> bricks;
  std::vector<format::Refined> refined;
  std::vector<format::ExactBrick> exact;
  std::vector<format::Facet> facets;
  std::vector<format::FacetSet> facet_sets;
  std::vector<std::uint32_t> facet_numbers;

  Voxelmap map() const { return {grid, index, bricks, refined, exact, {facets, facet_sets, facet_numbers}}; }
};

/// Describes `random_field`.
struct RandomField {
  std::array<int, 3> bricks = {2, 3, 4};
  double voxel_size = 0x1p-7;  ///< a power of two: then points can be exactly on planes of the lattice
  double noise = 0.2;          ///< of each node, about a plane of slope 1 [voxels]
  bool exact = false;          ///< a third of the bricks is
  bool refined = true;         ///< a third of the positions is refined, and so on
  bool far = true;             ///< a quarter of the positions is not stored
};

/// Returns the parts of a map with random entries, nodes, bounds and deviations. It follows the layout of
/// core/scene/format.h and is no field of a body: it is not continuous.
FieldParts random_field(const RandomField& of, Random& random);

/// Numbers the bricks from the other end. The field stays the same.
void renumber_bricks(FieldParts& parts);

/// A slow second reader of core/scene/format.h in double precision. It shares no code with Voxelmap.
class SlowField {
 public:
  /// Place of a point in the brick that is looked up.
  struct Place {
    bool in_grid = false;
    std::uint32_t position = 0;  ///< entry of the index
    bool stored = false;
    bool exact = false;
    const format::Brick* brick = nullptr;
    int level = 0;
    std::array<int, 3> cell{};
    Vector3 at = Vector3::Zero();           ///< in the cell, 0 .. 1
    Vector3 in_position = Vector3::Zero();  ///< in the position [voxels]
  };

  explicit SlowField(const FieldParts& parts) : parts_(parts) {}

  Place place(const Vector3& p) const;
  /// Returns the value in a place's cell, at `at` [quanta of the unrefined lattice].
  double quanta(const Place& place, const Vector3& at) const;
  /// Returns the stored distance at p, beyond the band as well, where a brick is stored [m].
  double stored(const Vector3& p) const { return stored(place(p), p); }
  double stored(const Place& place, const Vector3& p) const;
  /// Returns the gradient of the trilinear field without facets [1].
  Vector3 slope(const Place& place) const;
  /// As Voxelmap::sample; without the gradient in an exact brick.
  FieldSample sample(const Vector3& p) const;
  /// Returns the clearance that Voxelmap::clearances subtracts rounding from: of the position's own nodes [m].
  double batch_clearance(const Vector3& p) const;
  LayerSample layer(const Vector3& p) const;
  double lower_bound(const Vector3& center, double radius) const;

  const format::ExactBrick& exact_of(const Place& place) const { return parts_.exact[place.brick->exact - 1u]; }
  /// Returns the weight I[w] at a place of an exact brick, and the distance g to the facets of its cell [m].
  double weight(const Place& place) const;
  double facet_distance(const Place& place, const Vector3& p) const;
  /// Returns the set of a cell; none if the cell has no facets.
  const format::FacetSet* facets_of(const Place& place) const;
  bool is_whole(const Place& place) const;  ///< all nodes of the cell have the weight 1
  /// Returns the least height of p above the faces of a set's first part; infinity if that is empty [m].
  double least_height(const format::FacetSet& set, const Vector3& p) const;
  double near_band() const;  ///< largest part of a distance that a clearance may use [m]
  double assured() const;    ///< clearance wherever nothing is stored outside [m]

 private:
  const format::Brick& own(std::uint32_t entry) const;
  double distance_to_box(const Vector3& p) const;
  double far_clearance(const Place& place) const;

  const FieldParts& parts_;
};

/// Returns the bound that Brick::lipschitz codes: the bits above the lowest eleven of a float, less those of 1.
double slow_lipschitz(std::uint16_t code);

}  // namespace godobject::test
