#pragma once

namespace godobject::scene_compiler {

/// Returns the SHA-256 of the scene compiler in this build. Programs with the same one make the same images.
const char* compiler_digest();

}  // namespace godobject::scene_compiler
