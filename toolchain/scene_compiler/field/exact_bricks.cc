#include "toolchain/scene_compiler/field/exact_bricks.h"

#include <cstdint>
#include <utility>
#include <vector>

#include "toolchain/scene_compiler/field/facet_sets.h"

namespace godobject::scene_compiler {

void leave_out_unnamed(DistanceGrid& field) {
  std::vector<format::ExactBrick> exact;
  FacetSets sets;
  for (Brick& brick : field.bricks) {
    if (brick.exact == 0) continue;
    exact.push_back(field.exact[brick.exact - 1]);
    brick.exact = static_cast<std::uint32_t>(exact.size());
    for (std::uint32_t& word : exact.back().cell) {
      if (word == 0) continue;
      const std::uint32_t set = (word & format::cell_facets::kSet) - 1;
      const auto numbers = field.facet_lists().of(set);
      const std::uint32_t number =
          sets.number_of({{numbers.begin(), numbers.end()}, field.facet_sets[set].plane_count});
      word = (word & format::cell_facets::kWhole) | (number + 1);
    }
  }
  std::vector<std::uint32_t> numbers = sets.numbers();
  std::vector<std::uint32_t> renumbered(field.facets.size());  // 1: in use; then 1 + the new number
  for (const std::uint32_t number : numbers) renumbered[number] = 1;
  std::vector<format::Facet> facets;
  for (std::size_t i = 0; i < renumbered.size(); ++i) {
    if (renumbered[i] == 0) continue;
    facets.push_back(field.facets[i]);
    renumbered[i] = static_cast<std::uint32_t>(facets.size());
  }
  for (std::uint32_t& number : numbers) number = renumbered[number] - 1;
  field.exact = std::move(exact);
  field.facets = std::move(facets);
  field.facet_sets = sets.sets();
  field.facet_numbers = std::move(numbers);
}

}  // namespace godobject::scene_compiler
