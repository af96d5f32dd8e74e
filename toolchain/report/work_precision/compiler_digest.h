#pragma once

namespace godobject::report {

/// Returns a digest of the libraries that compile images. Programs with the same one make the same images.
const char* compiler_digest();

}  // namespace godobject::report
