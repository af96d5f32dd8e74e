#pragma once

namespace godobject::command {

/// Of the sources that this program was built from: "4f85a6f", with "-dirty" where they were changed; "unknown" where
/// they are no git checkout. Library `source_commit`.
extern const char* const kSourceCommit;

}  // namespace godobject::command
