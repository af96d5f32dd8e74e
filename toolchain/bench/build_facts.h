#pragma once

namespace godobject::bench {

/// SHA-256 of the scene compiler in this build.
extern const char* const kCompilerDigest;

}  // namespace godobject::bench
