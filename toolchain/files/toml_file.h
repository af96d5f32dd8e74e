#pragma once

#include <filesystem>
#include <initializer_list>
#include <string_view>

#include <toml++/toml.h>

namespace godobject::files {

/// Returns the content of a TOML file. Throws Failure: kNoInput if it cannot be read, kBadConfig naming the line if it
/// is not TOML.
toml::table parse_toml_file(const std::filesystem::path& file);

/// Throws Failure (kBadConfig) for the first top-level entry that is not in `tables`.
void allow_tables(const toml::table& root, const std::filesystem::path& file,
                  std::initializer_list<std::string_view> tables);

}  // namespace godobject::files
