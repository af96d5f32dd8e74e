#pragma once

#include <string>
#include <string_view>

namespace godobject::page {

/// Returns the bytes compressed in the zlib format (level 9), as base64 without line breaks. A browser reads it with
/// `atob` and `DecompressionStream('deflate')`.
std::string compressed_text(std::string_view bytes);

}  // namespace godobject::page
