#pragma once

#include <cstdint>

namespace godobject::scene_compiler {

/// Size of the core library's machine code in bytes, for each part that a build may leave out, counted when this
/// program was built (code_bytes.cmake). 0: this build is without the part.
struct CodeBytes {
  std::uint64_t paper = 0;
  std::uint64_t paper_with_friction = 0;  ///< beyond `paper`
  std::uint64_t corrected = 0;
  std::uint64_t corrected_with_friction = 0;  ///< beyond `corrected`
  std::uint64_t closed_forms = 0;             ///< shared by paper and corrected
  std::uint64_t contact = 0;                  ///< for a ball by its centre
  std::uint64_t contact_with_points = 0;      ///< beyond `contact`, for any number of points
  std::uint64_t contact_with_edges = 0;       ///< edge against edge
  std::uint64_t contact_with_friction = 0;
  std::uint64_t contact_features = 0;  ///< the second direction
};

extern const CodeBytes kCodeBytes;

}  // namespace godobject::scene_compiler
