#include "toolchain/files/toml_file.h"

#include <algorithm>

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/files/input_file.h"
#include "toolchain/files/text_file.h"
#include "toolchain/files/toml_nesting.h"

namespace godobject::files {

using command::ExitCode;
using command::Failure;

toml::table parse_toml(std::string_view text, std::string_view name) {
  // the library reads keys, and destroys tables, by recursion
  if (const auto line = line_nested_too_deep(text)) {
    throw Failure(
        ExitCode::kBadConfig,
        fmt::format("{}:{}: tables and arrays nest deeper than {} levels; write fewer brackets, or fewer dots "
                    "in the key",
                    name, *line, kMostNested));
  }
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& wrong) {
    throw Failure(ExitCode::kBadConfig, fmt::format("{}:{}: not TOML: {}; correct the line", name,
                                                    wrong.source().begin.line, std::string_view(wrong.description())));
  }
}

toml::table parse_toml_file(const std::filesystem::path& file) {
  require_regular_input(file);
  return parse_toml(read_text(file), file.string());
}

void allow_tables(const toml::table& root, const std::filesystem::path& file,
                  std::initializer_list<std::string_view> tables) {
  for (const auto& [key, node] : root) {
    if (std::find(tables.begin(), tables.end(), key.str()) == tables.end()) {
      throw Failure(ExitCode::kBadConfig, fmt::format("{}:{}: {} is not a known table; known: {}", file.string(),
                                                      key.source().begin.line, key.str(), fmt::join(tables, ", ")));
    }
  }
}

}  // namespace godobject::files
