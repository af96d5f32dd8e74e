#pragma once

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <toml++/toml.h>

namespace godobject::files {

/// One table of a TOML file, read key by key. Every complaint is a Failure (kBadConfig) naming file, line and key.
class TomlTable {
 public:
  struct Range {
    double low, high;
  };
  /// Every number except infinity and NaN.
  static constexpr Range kFinite{std::numeric_limits<double>::lowest(), std::numeric_limits<double>::max()};

  /// An example value for a key without a default, for the message if the key is missing.
  struct Example {
    std::string_view text;
  };

  /// The table `name` of `root`. If it is absent, the table is empty and complaints name no line.
  TomlTable(const toml::table& root, std::string name, std::filesystem::path file);

  /// Returns the tables of an array, [[name]], in their order. Complaints number them from 1. Empty if `root` has none.
  static std::vector<TomlTable> each(const toml::table& root, const std::string& name,
                                     const std::filesystem::path& file);

  /// Returns the table of the keys at the top of the file, outside all tables.
  static TomlTable top(const toml::table& root, std::filesystem::path file) {
    return TomlTable(&root, "", std::move(file));
  }

  /// Returns the table at a key: KEY = { ... }. If it is absent, the table is empty.
  TomlTable inner(std::string_view key) const;

  bool present() const { return table_ != nullptr; }
  bool has(std::string_view key) const { return find(key) != nullptr; }

  /// Throws for the first key that is not in `keys`.
  void allow(std::initializer_list<std::string_view> keys) const;

  std::string text(std::string_view key, const char* fallback) const;
  std::string text(std::string_view key, Example example = {}) const;            ///< no default
  double number(std::string_view key, Range range, Example example = {}) const;  ///< no default
  double number(std::string_view key, Range range, double fallback) const;
  std::vector<double> numbers(std::string_view key, std::size_t count, Range range) const;  ///< no default
  std::int64_t whole_number(std::string_view key, Range range) const;                       ///< no default
  std::int64_t whole_number(std::string_view key, Range range, std::int64_t fallback) const;
  bool flag(std::string_view key, bool fallback) const;

  /// Throws "FILE:LINE: TABLE.KEY WHAT".
  [[noreturn]] void complain(std::string_view key, const std::string& what) const;

 private:
  TomlTable(const toml::table* table, std::string name, std::filesystem::path file)
      : table_(table), name_(std::move(name)), file_(std::move(file)) {}

  const toml::node* find(std::string_view key) const { return table_ == nullptr ? nullptr : table_->get(key); }
  [[noreturn]] void miss(std::string_view key, std::string_view example) const;
  void require_in_range(std::string_view key, double value, Range range) const;

  const toml::table* table_ = nullptr;
  std::string name_;
  std::filesystem::path file_;
};

}  // namespace godobject::files
