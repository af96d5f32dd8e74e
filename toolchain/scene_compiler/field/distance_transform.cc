#include "toolchain/scene_compiler/field/distance_transform.h"

#include <limits>

namespace godobject::scene_compiler {
namespace {

constexpr float kUnreached = std::numeric_limits<float>::infinity();

/// One line of the transform: the lower envelope of parabolas with vertices at (i, line[i]) (Felzenszwalb and
/// Huttenlocher 2012).
class LineTransform {
 public:
  explicit LineTransform(std::size_t longest) : roots_(longest), starts_(longest + 1), heights_(longest) {}

  void run(float* line, std::size_t length, std::size_t stride) {
    for (std::size_t i = 0; i < length; ++i) heights_[i] = static_cast<double>(line[i * stride]);
    std::size_t count = 0;
    for (std::size_t i = 0; i < length; ++i) {
      if (heights_[i] == static_cast<double>(kUnreached)) continue;
      double start = -std::numeric_limits<double>::infinity();
      while (count > 0) {
        start = crossing(roots_[count - 1], i);
        if (start > starts_[count - 1]) break;
        --count;
        start = -std::numeric_limits<double>::infinity();
      }
      roots_[count] = i;
      starts_[count++] = start;
    }
    if (count == 0) return;
    std::size_t piece = 0;
    for (std::size_t i = 0; i < length; ++i) {
      while (piece + 1 < count && starts_[piece + 1] < static_cast<double>(i)) ++piece;
      const double step = static_cast<double>(i) - static_cast<double>(roots_[piece]);
      line[i * stride] = static_cast<float>(heights_[roots_[piece]] + step * step);
    }
  }

 private:
  /// Returns the place where the parabola of j, j > i, falls below that of i.
  double crossing(std::size_t i, std::size_t j) const {
    const auto x = static_cast<double>(i);
    const auto y = static_cast<double>(j);
    return ((heights_[j] + y * y) - (heights_[i] + x * x)) / (2.0 * (y - x));
  }

  std::vector<std::size_t> roots_;
  std::vector<double> starts_;
  std::vector<double> heights_;
};

}  // namespace

std::vector<float> squared_distance_transform(const BrickLattice& lattice, const std::vector<bool>& set) {
  std::vector<float> squared(lattice.count());
  for (std::size_t i = 0; i < squared.size(); ++i) squared[i] = set[i] ? 0.0f : kUnreached;
  std::size_t stride = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto length = static_cast<std::size_t>(lattice.size[axis]);
    LineTransform transform(length);
    for (std::size_t i = 0; i < squared.size(); ++i) {
      if (lattice.position(i)[axis] == 0) transform.run(squared.data() + i, length, stride);
    }
    stride *= length;
  }
  return squared;
}

}  // namespace godobject::scene_compiler
