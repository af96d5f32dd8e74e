#include "toolchain/scene_compiler/field/exact_bricks.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace godobject::scene_compiler {

void leave_out_unnamed(DistanceGrid& field) {
  std::vector<format::ExactBrick> exact;
  std::vector<std::uint32_t> number(field.facets.size());  // 1: in use; then 1 + the new number
  for (Brick& brick : field.bricks) {
    if (brick.exact == 0) continue;
    exact.push_back(field.exact[brick.exact - 1]);
    brick.exact = static_cast<std::uint32_t>(exact.size());
    for (const std::uint32_t facet : std::span(exact.back().facet).first(exact.back().facet_count)) number[facet] = 1;
  }
  std::vector<format::Facet> facets;
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (number[i] == 0) continue;
    facets.push_back(field.facets[i]);
    number[i] = static_cast<std::uint32_t>(facets.size());
  }
  for (format::ExactBrick& brick : exact) {
    for (std::uint32_t& facet : std::span(brick.facet).first(brick.facet_count)) facet = number[facet] - 1;
  }
  field.exact = std::move(exact);
  field.facets = std::move(facets);
}

}  // namespace godobject::scene_compiler
