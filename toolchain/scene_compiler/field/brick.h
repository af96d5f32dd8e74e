#pragma once

#include <cstdint>

#include "core/scene/format.h"

namespace godobject::scene_compiler {

/// A brick of a field under construction; format::Brick is its stored form.
struct Brick {
  float value[format::kBrickValues];  ///< [m]
  float lipschitz;                    ///< as format::decode_lipschitz returns it
  std::uint32_t exact;
  float deviation;  ///< [m]
};

}  // namespace godobject::scene_compiler
