#pragma once

#include <string>
#include <string_view>

namespace godobject::files {

/// Returns the text escaped for HTML, also within the quotes of an attribute.
inline std::string html_text(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '<': result += "&lt;"; break;
      case '>': result += "&gt;"; break;
      case '&': result += "&amp;"; break;
      case '"': result += "&quot;"; break;
      default: result += c;
    }
  }
  return result;
}

}  // namespace godobject::files
