#include "core/pipeline/contact/search/front.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/vector_widths.h"

namespace godobject {
namespace {

/// Rounding of a transformed point over the sum of its terms. Derived: four rounded products of rounded factors and
/// their sum, at most nine roundings of 6e-8, and room to spare.
constexpr double kPointRounding = 1e-6;
/// Derived: more than the roundings to single precision of a ball, a distance and a pace together, a few times 6e-8.
constexpr double kRoundedDown = 1.0 - 2e-6;

/// Front::compare for blocks of `stride` floats, whose first eight components of sixteen items are those of
/// Front::Block.
GODOBJECT_VECTOR_WIDTHS
void compare_balls(const float* blocks, std::size_t stride, const std::uint32_t* due, std::uint32_t count,
                   const float (&m)[3][4], float rounding, float reach, std::uint32_t* bits_of,
                   float* least_of) noexcept {
  constexpr float kMost = std::numeric_limits<float>::max();
  constexpr std::uint32_t kSize = Front::kBlockSize;
  constexpr std::uint32_t kLanes = 8;
  // versions of a function may pass vectors differently, so none is passed to or from a function
  using Floats __attribute__((vector_size(4 * kLanes))) = float;
  using Ints __attribute__((vector_size(4 * kLanes))) = std::int32_t;
  for (std::uint32_t i = 0; i < count; ++i) {
    const float* const block = blocks + stride * due[i];
    alignas(64) float distance[kSize];
    for (std::uint32_t k = 0; k < kSize; ++k) {
      const float x = block[k];
      const float y = block[kSize + k];
      const float z = block[2 * kSize + k];
      const float dx = m[0][0] * x + m[0][1] * y + m[0][2] * z + m[0][3] - block[3 * kSize + k];
      const float dy = m[1][0] * x + m[1][1] * y + m[1][2] * z + m[1][3] - block[4 * kSize + k];
      const float dz = m[2][0] * x + m[2][1] * y + m[2][2] * z + m[2][3] - block[5 * kSize + k];
      distance[k] = std::sqrt(dx * dx + dy * dy + dz * dz);
    }
    Ints bits = {};
    Ints here = {1, 2, 4, 8, 16, 32, 64, 128};
    Floats least = kMost - Floats{};
    for (std::uint32_t k = 0; k < kSize; k += kLanes, here <<= kLanes) {
      const Floats ball = *reinterpret_cast<const Floats*>(block + 6 * kSize + k);
      const Floats room = ball - rounding - *reinterpret_cast<const Floats*>(distance + k);
      const Floats left = room * *reinterpret_cast<const Floats*>(block + 7 * kSize + k);
      const Ints stays = left >= reach;
      bits |= ~stays & here;
      least = stays & (left < least) ? left : least;
    }
    std::uint32_t all = 0;
    float smallest = kMost;
    for (std::uint32_t k = 0; k < kLanes; ++k) {
      all |= static_cast<std::uint32_t>(bits[k]);
      smallest = least[k] < smallest ? least[k] : smallest;
    }
    bits_of[i] = all;
    least_of[i] = smallest;
  }
}

/// Returns the smallest of `count` values. Four at a time, so that no comparison waits for the one before.
GODOBJECT_VECTOR_WIDTHS
double least_of(const double* values, std::uint32_t count) noexcept {
  constexpr std::uint32_t kLanes = 4;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double least[kLanes] = {kInfinity, kInfinity, kInfinity, kInfinity};
  for (std::uint32_t i = 0; i < count; ++i) {
    double& lane = least[i % kLanes];
    lane = lane <= values[i] ? lane : values[i];
  }
  return std::min(std::min(least[0], least[1]), std::min(least[2], least[3]));
}

}  // namespace

void Front::start(std::span<std::uint32_t> memory, const Pointshell& shell) noexcept {
  nodes_ = shell.nodes;
  x_ = shell.x;
  y_ = shell.y;
  z_ = shell.z;
  node_count_ = static_cast<std::uint32_t>(shell.nodes.size());
  count_ = marked_ = 0;
  extent_ = 0.0;
  if (shell.size == 0) return;
  const std::size_t items = node_count_ + shell.size;
  const std::size_t blocks = blocks_for(shell);
  const std::size_t before = -(reinterpret_cast<std::uintptr_t>(memory.data()) / sizeof(std::uint32_t)) % kAlignment;
  std::span<std::uint32_t> left = memory.subspan(before);
  const auto take = [&left](std::size_t words) noexcept {
    const std::span<std::uint32_t> taken = left.first(words);
    left = left.subspan(words);
    return taken;
  };
  blocks_ = reinterpret_cast<Block*>(take(blocks * sizeof(Block) / sizeof(std::uint32_t)).data());
  until_ = reinterpret_cast<double*>(take(blocks * sizeof(double) / sizeof(std::uint32_t)).data());
  words_ = take(kWords * items);
  marks_ = take(mark_words(shell.size));
  marked_words_ = take(mark_words(marks_.size()));
  std::fill(marks_.begin(), marks_.end(), 0u);
  std::fill(marked_words_.begin(), marked_words_.end(), 0u);
  for (std::uint32_t i = 0; i < items; ++i) {
    word(i, kSlot) = kNone;
    word(i, kNext) = kNotChained;
  }
  word(0, kParent) = kNone;
  for (std::uint32_t n = 0; n < node_count_; ++n) {
    for_each_child(shell, n, [&](std::uint32_t child) { word(child, kParent) = n; });
  }
  for (std::uint32_t i = 0; i < items; ++i) {
    const Sphere sphere = sphere_of(i);
    extent_ = std::max(extent_, static_cast<double>(std::fabs(sphere.x) + std::fabs(sphere.y) + std::fabs(sphere.z)));
  }
  insert_due(0);
}

Front::Place Front::place(const Matrix3& R, const Vector3& t) const noexcept {
  Place place;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) place.m[row][column] = static_cast<float>(R(row, column));
    place.m[row][3] = static_cast<float>(t[row]);
  }
  // each coordinate has at most the sum of the terms; their errors add up to no more than twice a coordinate's
  place.rounding = static_cast<float>(2.0 * kPointRounding * (extent_ + t.cwiseAbs().sum()));
  return place;
}

void Front::set_ball(Block& block, std::uint32_t k, const Place& place, const Ball& ball) noexcept {
  const auto at = [&](const float(&m)[4]) noexcept {
    return m[0] * block.x[k] + m[1] * block.y[k] + m[2] * block.z[k] + m[3];
  };
  block.at_x[k] = at(place.m[0]);
  block.at_y[k] = at(place.m[1]);
  block.at_z[k] = at(place.m[2]);
  block.ball[k] = static_cast<float>(kRoundedDown * ball.radius) - place.rounding;
  block.per_pace[k] = static_cast<float>(kRoundedDown * ball.per_pace);
}

/// Gives an item the next slot, without a ball.
std::uint32_t Front::append(std::uint32_t item) noexcept {
  const std::uint32_t slot = count_++;
  Block& block = blocks_[slot / kBlockSize];
  const std::uint32_t k = slot % kBlockSize;
  if (k == 0) {
    until_[slot / kBlockSize] = std::numeric_limits<double>::infinity();
    block = Block{};
    std::fill_n(block.ball, kBlockSize, kNeverLeft);
    std::fill_n(block.per_pace, kBlockSize, 1.0f);
  }
  const Sphere sphere = sphere_of(item);
  block.x[k] = sphere.x;
  block.y[k] = sphere.y;
  block.z[k] = sphere.z;
  block.radius[k] = sphere.radius;
  block.item[k] = item;
  word(item, kSlot) = slot;
  return slot;
}

void Front::insert_due(std::uint32_t item) noexcept {
  std::uint32_t slot = word(item, kSlot);
  if (slot == kNone) slot = append(item);
  Block& block = blocks_[slot / kBlockSize];
  const std::uint32_t k = slot % kBlockSize;
  block.ball[k] = -kNeverLeft;
  lower(slot / kBlockSize, -std::numeric_limits<double>::infinity());
}

void Front::remove(std::uint32_t item) noexcept {
  const std::uint32_t slot = word(item, kSlot);
  word(item, kSlot) = kNone;
  const std::uint32_t last = --count_;
  Block& from = blocks_[last / kBlockSize];
  const std::uint32_t j = last % kBlockSize;
  if (slot != last) {
    Block& to = blocks_[slot / kBlockSize];
    const std::uint32_t k = slot % kBlockSize;
    to.x[k] = from.x[j];
    to.y[k] = from.y[j];
    to.z[k] = from.z[j];
    to.at_x[k] = from.at_x[j];
    to.at_y[k] = from.at_y[j];
    to.at_z[k] = from.at_z[j];
    to.ball[k] = from.ball[j];
    to.per_pace[k] = from.per_pace[j];
    to.radius[k] = from.radius[j];
    to.item[k] = from.item[j];
    word(to.item[k], kSlot) = slot;
    lower(slot / kBlockSize, until_[last / kBlockSize]);
  }
  from.ball[j] = kNeverLeft;  // so that its block is not due because of it
}

double Front::certain() const noexcept {
  if (marked_ > 0) return 0.0;
  return least_of(until_, block_count());
}

void Front::compare(const std::uint32_t* due, std::uint32_t count, const Place& place, float reach,
                    Found* found) const noexcept {
  static_assert(offsetof(Block, ball) == 6 * sizeof(Block::x) && offsetof(Block, per_pace) == 7 * sizeof(Block::x));
  std::uint32_t bits[kAtOnce];
  float least[kAtOnce];
  compare_balls(reinterpret_cast<const float*>(blocks_), sizeof(Block) / sizeof(float), due, count, place.m,
                place.rounding, reach, bits, least);
  for (std::uint32_t k = 0; k < count; ++k) found[k] = {bits[k], least[k]};
}

}  // namespace godobject
