#include "toolchain/figures/curve.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <set>

#include <fmt/format.h>

namespace godobject::figures {
namespace {

constexpr std::size_t kParts = 650;  // chosen: two pixels each on a wide screen

/// Returns the numbers of the samples from `begin` to `end` that stay, ascending.
std::set<std::size_t> kept(const std::vector<Sample>& curve, std::size_t begin, std::size_t end) {
  std::set<std::size_t> numbers = {begin, end - 1};
  std::size_t lowest = end, highest = end;
  bool has_gap = false;
  for (std::size_t i = begin; i < end; ++i) {
    const double value = curve[i].value;
    if (std::isnan(value)) {
      if (!has_gap) numbers.insert(i);
      has_gap = true;
      continue;
    }
    if (lowest == end || value < curve[lowest].value) lowest = i;
    if (highest == end || value > curve[highest].value) highest = i;
  }
  if (lowest < end) numbers.insert({lowest, highest});
  return numbers;
}

}  // namespace

std::vector<Sample> thinned(const std::vector<Sample>& curve) {
  std::vector<Sample> result;
  const std::size_t parts = std::min(kParts, curve.size());
  for (std::size_t part = 0; part < parts; ++part) {
    const std::size_t begin = part * curve.size() / parts;
    const std::size_t end = (part + 1) * curve.size() / parts;
    for (const std::size_t i : kept(curve, begin, end)) result.push_back(curve[i]);
  }
  return result;
}

std::string curve_block(const std::string& name, const std::vector<Sample>& curve) {
  std::string text = fmt::format("${} << END\n", name);
  for (const Sample& sample : thinned(curve)) {
    fmt::format_to(std::back_inserter(text), "{:.4f} {:.6g}\n", sample.t, sample.value);
  }
  return text + "END\n";
}

}  // namespace godobject::figures
