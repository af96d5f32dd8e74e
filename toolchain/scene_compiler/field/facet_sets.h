#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "core/scene/format.h"

namespace godobject::scene_compiler {

/// The facets of a cell: their numbers in the order of format::FacetSet.
struct CellFacets {
  std::vector<std::uint32_t> numbers;
  std::size_t plane_count = 0;  ///< of the first part
};

/// Sets of facets, each stored once.
class FacetSets {
 public:
  /// Returns the number of a set with these facets; adds it if it is new.
  std::uint32_t number_of(const CellFacets& facets);

  const std::vector<format::FacetSet>& sets() const { return sets_; }
  const std::vector<std::uint32_t>& numbers() const { return numbers_; }

 private:
  std::vector<format::FacetSet> sets_;
  std::vector<std::uint32_t> numbers_;
  std::map<std::vector<std::uint32_t>, std::uint32_t> known_;  ///< sets by plane count and numbers
};

}  // namespace godobject::scene_compiler
