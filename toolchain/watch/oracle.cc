#include "toolchain/watch/oracle.h"

#include <algorithm>
#include <cmath>

namespace godobject::watch {
namespace {

/// A piece of a chord from share t0 to t1, and the distances above the bound at its ends.
struct Piece {
  double t0, above0, t1, above1;
};

}  // namespace

bool falls_below(const Oracle& oracle, const Chord& chord, double least, double resolution) {
  const Vector3 whole = chord.end - chord.begin;
  const double length = whole.norm();
  const double steepness = oracle.lipschitz() * length;
  const double shortest = resolution / std::max(length, resolution);
  constexpr int kDeepest = 64;  // each level halves the piece, so that doubles end long before
  Piece stack[kDeepest];
  int depth = 0;
  stack[depth++] = {0.0, chord.at_begin - least, 1.0, chord.at_end - least};
  while (depth > 0) {
    const Piece piece = stack[--depth];
    if (piece.above0 < 0.0 || piece.above1 < 0.0) return true;
    if (piece.above0 + piece.above1 > steepness * (piece.t1 - piece.t0) || piece.t1 - piece.t0 < shortest) continue;
    const double middle = 0.5 * (piece.t0 + piece.t1);
    const double nearer_end = std::min(std::fabs(piece.above0 + least), std::fabs(piece.above1 + least));
    const double most = nearer_end + steepness * 0.5 * (piece.t1 - piece.t0);
    const double above = oracle.distance_within(chord.begin + middle * whole, most) - least;
    if (depth + 2 > kDeepest) continue;
    stack[depth++] = {middle, above, piece.t1, piece.above1};
    stack[depth++] = {piece.t0, piece.above0, middle, above};
  }
  return false;
}

}  // namespace godobject::watch
