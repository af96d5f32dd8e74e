#pragma once

#include <cstdint>

#include "core/scene/format.h"

namespace godobject::scene_compiler {

/// format::Brick while a field is being made.
struct Brick {
  float value[format::kBrickValues];  ///< [m]
  float lipschitz;                    ///< what format::decode_lipschitz gives
  std::uint32_t edge;
  float deviation;  ///< [m]
};

}  // namespace godobject::scene_compiler
