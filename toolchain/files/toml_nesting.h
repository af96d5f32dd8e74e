#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace godobject::files {

/// Deepest nesting of tables and arrays that is read. Scene, device and controller files need three.
inline constexpr std::size_t kMostNested = 32;

/// Returns the first line, from 1, of a TOML text at which tables and arrays nest deeper than kMostNested: by brackets,
/// dotted keys, dotted headers or all of these together. Nothing if there is none. Up to its first error the text is
/// read as TOML is. Cost: linear, without recursion.
std::optional<std::size_t> line_nested_too_deep(std::string_view text);

}  // namespace godobject::files
