#include "toolchain/files/toml_nesting.h"

#include <algorithm>
#include <vector>

namespace godobject::files {
namespace {

/// Follows the brackets and dots of a TOML text.
class Nesting {
 public:
  /// Takes the next character outside strings and comments.
  void take(char c) {
    switch (c) {
      case '\n': end_line(); break;
      case '[': open(false); break;
      case '{': open(true); break;
      case ']':
      case '}': close(); break;
      case '=': in_key_ = false; break;
      case ',': begin_element(); break;
      case '.': dots_ += in_key_ ? 1 : 0; break;
      default: break;
    }
  }

  std::size_t depth() const { return container() + dots_ + (in_header_ ? 1 : 0); }

 private:
  struct Bracket {
    std::size_t depth;
    bool is_table;
  };

  std::size_t container() const { return open_.empty() ? header_ : open_.back().depth; }

  void open(bool is_table) {
    if (in_header_) return;  // the second one of an array of tables
    if (!is_table && in_key_ && open_.empty()) {
      in_header_ = true;
      header_ = 0;
      return;
    }
    open_.push_back({container() + dots_ + 1, is_table});
    in_key_ = is_table;
    dots_ = 0;
  }

  void close() {
    if (in_header_) return;
    if (!open_.empty()) open_.pop_back();
    in_key_ = false;
    dots_ = 0;
  }

  void begin_element() {
    in_key_ = !open_.empty() && open_.back().is_table;
    dots_ = 0;
  }

  void end_line() {
    if (!open_.empty()) return;
    if (in_header_) header_ = dots_ + 1;
    in_header_ = false;
    in_key_ = true;
    dots_ = 0;
  }

  std::vector<Bracket> open_;
  std::size_t header_ = 0;  // depth of the table that the last header begins
  std::size_t dots_ = 0;    // of the key that is read, and then of the key whose value is read
  bool in_key_ = true;
  bool in_header_ = false;
};

/// Returns the end of the string that begins at text[at], behind its last quote.
std::size_t end_of_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const bool escapes = quote == '"';
  const bool many_lines = text.substr(at, 3) == std::string_view(escapes ? R"(""")" : "'''");
  std::size_t run = 0;  // of quotes
  for (at += many_lines ? 3 : 1; at < text.size(); ++at) {
    if (text[at] == '\n' && !many_lines) return at;
    run = text[at] == quote ? run + 1 : 0;
    if (escapes && text[at] == '\\') {
      ++at;
    } else if (!many_lines && run == 1) {
      return at + 1;
    } else if (run >= 3 && (run == 5 || text.substr(at + 1, 1) != text.substr(at, 1))) {
      return at + 1;  // up to two quotes before the last three belong to the string
    }
  }
  return text.size();
}

}  // namespace

std::optional<std::size_t> line_nested_too_deep(std::string_view text) {
  Nesting nesting;
  std::size_t line = 1;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t begin = at;
    const char c = text[at];
    if (c == '#') {
      at = std::min(text.find('\n', at), text.size());
    } else if (c == '"' || c == '\'') {
      at = end_of_string(text, at);
    } else {
      nesting.take(c);
      if (nesting.depth() > kMostNested) return line;
      ++at;
    }
    line += static_cast<std::size_t>(std::count(text.begin() + static_cast<std::ptrdiff_t>(begin),
                                                text.begin() + static_cast<std::ptrdiff_t>(std::min(at, text.size())),
                                                '\n'));
  }
  return std::nullopt;
}

}  // namespace godobject::files
