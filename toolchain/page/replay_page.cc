#include "toolchain/page/replay_page.h"

#include <algorithm>

#include <fmt/format.h>

#include "toolchain/files/html_text.h"
#include "toolchain/page/compressed_text.h"

namespace godobject::page {
namespace {

// The policy forbids every connection, so that the page works alike with and without a network.
constexpr const char* kPage = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:">
<link rel="icon" href="data:,">
<title>{0}</title></head>
<body>
<header><h1>{0}</h1>
<p class="lead">{1}</p></header>
<noscript><p>This page needs JavaScript, which is switched off.</p></noscript>
<div id="player"></div>
<script type="text/plain" id="replay-data">{2}</script>
<script>{3}</script>
</body></html>
)";

constexpr const char* kOne =
    "The translucent body follows a hand that pushes it into the grey body. The solid blue "
    "body, the god object, should stay on the surface. The red arrow is the force of the spring that pulls the hand "
    "back.";
constexpr const char* kSeveral =
    "Each picture shows another replay of the same motion of a hand. The translucent body "
    "follows the hand into the grey body. The solid coloured body, the god object, should stay on the surface. The red "
    "arrow is the force of the spring that pulls the hand back.";

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

std::string replay_page(const PageScene& scene, std::string_view title, std::string_view player) {
  return fmt::format(fmt::runtime(kPage), files::html_text(title), scene.replays.size() == 1 ? kOne : kSeveral,
                     compressed_text(page_data(scene)), script_text(player));
}

}  // namespace godobject::page
