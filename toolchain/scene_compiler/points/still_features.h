#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/scene/format.h"
#include "toolchain/scene_compiler/mesh/surface_sample.h"

namespace godobject::scene_compiler {

/// Feature points of the still body as the image stores them; none if `points` is empty.
struct StillFeatures {
  format::Features header{};
  std::vector<float> points;  ///< x[n], y[n], z[n] relative to the header's origin, in tree order
  std::vector<format::Node> nodes;
  std::uint32_t corners = 0;   ///< of the points: sharp vertices
  std::uint32_t on_edges = 0;  ///< on sharp edges and rims
  std::uint32_t on_faces = 0;  ///< where the surface bends too tightly
};

/// Lays out `chosen` (in W) with a sphere tree whose levels grow about threefold. `area` of their surface [m^2].
/// Deterministic.
StillFeatures make_still_features(std::span<const SurfaceSample> chosen, double area);

}  // namespace godobject::scene_compiler
