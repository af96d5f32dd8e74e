#pragma once

#include <cstddef>
#include <vector>

#include "core/scene/format.h"
#include "toolchain/files/scene_image.h"

namespace godobject::scene_compiler {

/// One section of a scene image.
struct SectionBytes {
  format::SectionId id;
  std::vector<std::byte> bytes;
};

/// Returns the sections as one image, with checksums.
files::AlignedBytes make_image(const std::vector<SectionBytes>& sections);

}  // namespace godobject::scene_compiler
