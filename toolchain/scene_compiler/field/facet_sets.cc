#include "toolchain/scene_compiler/field/facet_sets.h"

#include <utility>

namespace godobject::scene_compiler {

std::uint32_t FacetSets::number_of(const CellFacets& facets) {
  std::vector<std::uint32_t> key = facets.numbers;
  key.push_back(static_cast<std::uint32_t>(facets.plane_count));
  const auto [known, is_new] = known_.try_emplace(std::move(key), static_cast<std::uint32_t>(sets_.size()));
  if (is_new) {
    sets_.push_back({static_cast<std::uint32_t>(numbers_.size()), static_cast<std::uint16_t>(facets.numbers.size()),
                     static_cast<std::uint16_t>(facets.plane_count)});
    numbers_.insert(numbers_.end(), facets.numbers.begin(), facets.numbers.end());
  }
  return known->second;
}

}  // namespace godobject::scene_compiler
