#pragma once

namespace godobject::command {

/// The commit of the sources that this program was built from: "4f85a6f", with "-dirty" if they were changed; "unknown"
/// if they are no git checkout. Library godobject::source_commit.
extern const char* const kSourceCommit;

}  // namespace godobject::command
