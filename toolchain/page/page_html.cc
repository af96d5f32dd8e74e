#include "toolchain/page/page_html.h"

#include <algorithm>

#include <fmt/format.h>

#include "toolchain/files/html_text.h"

namespace godobject::page {
namespace {

constexpr const char* kPage = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; connect-src {5}; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:">
<link rel="icon" href="data:,">
<title>{0}</title></head>
<body>
<header><h1>{0}</h1>
<p class="lead">{1}</p></header>
<noscript><p>This page needs JavaScript, which is switched off.</p></noscript>
<div id="player"></div>
<script type="text/plain" id="{4}">{2}</script>
<script>{3}</script>
</body></html>
)";

/// Tells if `text` begins with `word`, which is in lower case, whatever the case of `text`.
bool begins_with(std::string_view text, std::string_view word) {
  const auto same = [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b; };
  return text.size() >= word.size() &&
         std::equal(word.begin(), word.end(), text.begin(), [&](char b, char a) { return same(a, b); });
}

/// Returns a script in which no string ends or hides the element around it: `</script` and `<!--` get a backslash after
/// the first character, which a string and a regular expression of JavaScript ignore.
std::string script_text(std::string_view script) {
  std::string text;
  text.reserve(script.size());
  for (std::size_t i = 0; i < script.size(); ++i) {
    text += script[i];
    const std::string_view rest = script.substr(i);
    if (rest.front() == '<' && (begins_with(rest, "</script") || begins_with(rest, "<!--"))) text += '\\';
  }
  return text;
}

}  // namespace

std::string page_html(const PageParts& parts) {
  return fmt::format(fmt::runtime(kPage), files::html_text(parts.title), parts.lead, parts.data,
                     script_text(parts.player), parts.data_id, parts.connections);
}

}  // namespace godobject::page
