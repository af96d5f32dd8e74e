#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>

#include <nlohmann/json.hpp>

namespace godobject::page {

/// Columns of numbers as bytes that compress well. A number is stored as a whole multiple of the column's step, as the
/// difference from the number before, with the sign in the lowest bit. The lowest bytes of all numbers come first, then
/// the second ones, and so on: four planes.
class ColumnPack {
 public:
  /// Adds finite numbers, each rounded to a multiple of `step`. The step grows if the largest number needs more than 30
  /// bits. Returns `{"offset", "count", "step"}`: the first byte, the number of numbers and the step used. A column
  /// that is there already is not stored again.
  nlohmann::json add(std::span<const double> numbers, double step);

  /// Adds whole numbers.
  nlohmann::json add(std::span<const std::uint32_t> numbers);

  const std::string& bytes() const { return bytes_; }

 private:
  nlohmann::json store(const std::string& planes, std::size_t count, double step);

  std::string bytes_;
  std::map<std::string, std::size_t> offsets_;  ///< of the columns by their planes
};

}  // namespace godobject::page
