#include "toolchain/files/toml_file.h"

#include <algorithm>

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/files/input_file.h"

namespace godobject::files {

using command::ExitCode;
using command::Failure;

toml::table parse_toml_file(const std::filesystem::path& file) {
  require_regular_input(file);
  try {
    return toml::parse_file(file.string());
  } catch (const toml::parse_error& wrong) {
    throw Failure(ExitCode::kBadConfig, fmt::format("{}:{}: not TOML: {}; correct the line", file.string(),
                                                    wrong.source().begin.line, std::string_view(wrong.description())));
  }
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
