#pragma once

#include <string>
#include <string_view>

namespace godobject::page {

/// The parts of a page with the player.
struct PageParts {
  std::string_view title;        ///< text
  std::string_view lead;         ///< HTML, one or two sentences
  std::string_view data_id;      ///< of the element with the data: the player finds out by it what to show
  std::string_view data;         ///< as `compressed_text` makes it
  std::string_view player;       ///< the script
  std::string_view connections;  ///< sources that the page may connect to, as in a content security policy
};

/// Returns a page without references to other files. Its content security policy forbids everything but its own script,
/// styles and pictures, and `connections`.
std::string page_html(const PageParts& parts);

}  // namespace godobject::page
