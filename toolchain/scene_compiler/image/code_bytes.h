#pragma once

#include <cstdint>

namespace godobject::scene_compiler {

/// Machine code of the core's library, by the part that alone needs it, counted when this program was built
/// (code_bytes.cmake). 0: this build is without.
struct CodeBytes {
  std::uint64_t paper = 0;
  std::uint64_t paper_with_friction = 0;  ///< only there, beyond `paper`
  std::uint64_t corrected = 0;
  std::uint64_t corrected_with_friction = 0;
  std::uint64_t closed_forms = 0;         ///< of either of the two
  std::uint64_t contact = 0;              ///< of a ball by its centre
  std::uint64_t contact_with_points = 0;  ///< beyond it, of any number of points
  std::uint64_t contact_with_friction = 0;
  std::uint64_t contact_features = 0;  ///< the second direction
};

extern const CodeBytes kCodeBytes;

}  // namespace godobject::scene_compiler
