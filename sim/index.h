#pragma once

#include <cstddef>
#include <cstdint>

namespace godobject::sim {

/// Returns the number of a joint, a bus or a place in a queue as an index of an array. It must not be negative.
constexpr std::size_t at(std::int64_t i) noexcept { return static_cast<std::size_t>(i); }

}  // namespace godobject::sim
