#include "toolchain/files/toml_table.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"

namespace godobject::files {

using command::ExitCode;
using command::Failure;

TomlTable::TomlTable(const toml::table& root, std::string name, std::filesystem::path file)
    : name_(std::move(name)), file_(std::move(file)) {
  const toml::node* node = root.get(name_);
  if (node == nullptr) return;
  table_ = node->as_table();
  if (table_ == nullptr) {
    throw Failure(ExitCode::kBadConfig, fmt::format("{}:{}: {} must be a table: write [{}]", file_.string(),
                                                    node->source().begin.line, name_, name_));
  }
}

std::vector<TomlTable> TomlTable::each(const toml::table& root, const std::string& name,
                                       const std::filesystem::path& file) {
  std::vector<TomlTable> tables;
  const toml::node* node = root.get(name);
  if (node == nullptr) return tables;
  const toml::array* array = node->as_array();
  if (array == nullptr || array->empty() || !array->is_homogeneous<toml::table>()) {
    throw Failure(ExitCode::kBadConfig, fmt::format("{}:{}: {} must be an array of tables: write [[{}]]", file.string(),
                                                    node->source().begin.line, name, name));
  }
  for (const toml::node& element : *array) {
    tables.push_back(TomlTable(element.as_table(), fmt::format("{}[{}]", name, tables.size() + 1), file));
  }
  return tables;
}

TomlTable TomlTable::inner(std::string_view key) const {
  const toml::node* node = find(key);
  if (node != nullptr && !node->is_table()) complain(key, fmt::format("must be a table: write {} = {{ ... }}", key));
  return TomlTable(node == nullptr ? nullptr : node->as_table(), fmt::format("{}.{}", name_, key), file_);
}

void TomlTable::allow(std::initializer_list<std::string_view> keys) const {
  if (table_ == nullptr) return;
  for (const auto& [key, node] : *table_) {
    if (std::find(keys.begin(), keys.end(), key.str()) == keys.end()) {
      complain(key.str(), fmt::format("is not a known key; known here: {}", fmt::join(keys, ", ")));
    }
  }
}

std::string TomlTable::text(std::string_view key, const char* fallback) const {
  return find(key) == nullptr ? fallback : text(key);
}

std::string TomlTable::text(std::string_view key, Example example) const {
  const toml::node* node = find(key);
  if (node == nullptr) miss(key, example.text.empty() ? "\"...\"" : example.text);
  const auto value = node->value<std::string>();
  if (!value) complain(key, "must be a text in quotes");
  return *value;
}

double TomlTable::number(std::string_view key, Range range, Example example) const {
  const toml::node* node = find(key);
  if (node == nullptr) {
    const std::string any = fmt::format("a number from {:g} to {:g}", range.low, range.high);
    miss(key, example.text.empty() ? any : example.text);
  }
  if (!node->is_number()) complain(key, "must be a number");
  const double value = node->value<double>().value_or(0.0);
  require_in_range(key, value, range);
  return value;
}

double TomlTable::number(std::string_view key, Range range, double fallback) const {
  return find(key) == nullptr ? fallback : number(key, range);
}

std::vector<double> TomlTable::numbers(std::string_view key, std::size_t count, Range range) const {
  const toml::node* node = find(key);
  if (node == nullptr) miss(key, fmt::format("an array of {} numbers", count));
  const toml::array* array = node->as_array();
  if (array == nullptr || array->size() != count) complain(key, fmt::format("must be an array of {} numbers", count));
  std::vector<double> values;
  for (const toml::node& element : *array) {
    if (!element.is_number()) complain(key, fmt::format("must be an array of {} numbers", count));
    values.push_back(element.value<double>().value_or(0.0));
    require_in_range(key, values.back(), range);
  }
  return values;
}

std::int64_t TomlTable::whole_number(std::string_view key, Range range, std::int64_t fallback) const {
  return find(key) == nullptr ? fallback : whole_number(key, range);
}

std::int64_t TomlTable::whole_number(std::string_view key, Range range) const {
  const toml::node* node = find(key);
  if (node == nullptr) miss(key, fmt::format("a whole number from {:g} to {:g}", range.low, range.high));
  if (!node->is_integer()) complain(key, "must be a whole number");
  const std::int64_t value = node->value<std::int64_t>().value_or(0);
  require_in_range(key, static_cast<double>(value), range);
  return value;
}

bool TomlTable::flag(std::string_view key, bool fallback) const {
  const toml::node* node = find(key);
  if (node == nullptr) return fallback;
  if (!node->is_boolean()) complain(key, "must be true or false");
  return node->value<bool>().value_or(fallback);
}

void TomlTable::complain(std::string_view key, const std::string& what) const {
  const toml::node* node = find(key);
  const toml::source_index line = node != nullptr     ? node->source().begin.line
                                  : table_ != nullptr ? table_->source().begin.line
                                                      : 0;
  const std::string where = line == 0 ? file_.string() : fmt::format("{}:{}", file_.string(), line);
  const std::string table = name_.empty() ? "" : name_ + ".";
  throw Failure(ExitCode::kBadConfig, fmt::format("{}: {}{} {}", where, table, key, what));
}

void TomlTable::miss(std::string_view key, std::string_view example) const {
  const std::size_t bracket = name_.find('[');  // of an array of tables
  const std::size_t dot = name_.rfind('.');     // of an inner table
  const std::string below = name_.empty()                  ? "at the top"
                            : dot != std::string::npos     ? fmt::format("in {} = {{ ... }}", name_.substr(dot + 1))
                            : bracket == std::string::npos ? fmt::format("below [{}]", name_)
                                                           : fmt::format("below [[{}]]", name_.substr(0, bracket));
  complain(key, fmt::format("is missing and has no default; {} write {} = {}", below, key, example));
}

void TomlTable::require_in_range(std::string_view key, double value, Range range) const {
  if (value >= range.low && value <= range.high) return;
  if (range.low == kFinite.low && range.high == kFinite.high) complain(key, "must be a finite number");
  complain(key, fmt::format("= {:g} is out of range; it must be from {:g} to {:g}", value, range.low, range.high));
}

}  // namespace godobject::files
