#pragma once

namespace godobject::bench {

/// SHA-256 of the scene compiler that this build holds.
extern const char* const kCompilerDigest;

/// The sources' commit; -dirty: with changes that no commit holds.
extern const char* const kSourceCommit;

}  // namespace godobject::bench
