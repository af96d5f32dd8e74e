#pragma once

namespace godobject::bench {

/// SHA-256 of the scene compiler that this build holds.
extern const char* const kCompilerDigest;

}  // namespace godobject::bench
