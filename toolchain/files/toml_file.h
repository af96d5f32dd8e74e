#pragma once

#include <filesystem>
#include <initializer_list>
#include <string_view>

#include <toml++/toml.h>

namespace godobject::files {

/// Returns the content of a TOML text; `name` stands for it in messages. Throws Failure (kBadConfig) naming the line if
/// it is not TOML, or if tables and arrays nest deeper than kMostNested.
toml::table parse_toml(std::string_view text, std::string_view name);

/// Returns the content of a TOML file. Throws Failure as parse_toml does, kNoInput if the file cannot be read, and
/// kBadData if it is too long.
toml::table parse_toml_file(const std::filesystem::path& file);

/// Throws Failure (kBadConfig) for the first top-level entry that is not in `tables`.
void allow_tables(const toml::table& root, const std::filesystem::path& file,
                  std::initializer_list<std::string_view> tables);

}  // namespace godobject::files
