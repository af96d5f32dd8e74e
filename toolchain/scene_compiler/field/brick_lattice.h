#pragma once

#include <array>
#include <cstddef>

namespace godobject::scene_compiler {

using BrickPosition = std::array<int, 3>;

/// The positions of bricks in a box, numbered x fastest.
struct BrickLattice {
  BrickPosition size{};

  std::size_t count() const noexcept {
    return static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(size[2]);
  }
  bool contains(const BrickPosition& p) const noexcept {
    return p[0] >= 0 && p[1] >= 0 && p[2] >= 0 && p[0] < size[0] && p[1] < size[1] && p[2] < size[2];
  }
  std::size_t number(const BrickPosition& p) const noexcept {
    return static_cast<std::size_t>(p[0]) +
           static_cast<std::size_t>(size[0]) *
               (static_cast<std::size_t>(p[1]) + static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(p[2]));
  }
  BrickPosition position(std::size_t number) const noexcept {
    const auto nx = static_cast<std::size_t>(size[0]);
    const auto ny = static_cast<std::size_t>(size[1]);
    return {static_cast<int>(number % nx), static_cast<int>(number / nx % ny), static_cast<int>(number / nx / ny)};
  }
};

inline constexpr std::array<BrickPosition, 6> kFaceSteps = {
    {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};

/// Returns the position `step` away from `from`.
inline BrickPosition moved(const BrickPosition& from, const BrickPosition& step) noexcept {
  return {from[0] + step[0], from[1] + step[1], from[2] + step[2]};
}

}  // namespace godobject::scene_compiler
