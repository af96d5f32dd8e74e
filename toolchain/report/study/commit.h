#pragma once

namespace godobject::report {

/// Of the sources that this program was built from: "4f85a6f", with "-dirty" where they were changed; "unknown" where
/// they are no git checkout.
const char* commit();

}  // namespace godobject::report
