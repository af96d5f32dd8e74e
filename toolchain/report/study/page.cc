#include "toolchain/report/study/page.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "toolchain/files/html_text.h"

namespace godobject::report {
namespace {

using files::html_text;

const char* const kHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Study of the god object</title>
<style>
body { font: 16px/1.5 sans-serif; color: #222; max-width: 1000px; margin: 1.5em auto; padding: 0 1em }
table { border-collapse: collapse; font-size: 13px; margin: 1em 0 }
th, td { padding: 3px 8px; border-bottom: 1px solid #ddd; text-align: left; vertical-align: top }
.number { text-align: right } td.number { white-space: nowrap }
.wide { overflow-x: auto } .wide td:nth-child(2) { min-width: 14em }
.held { color: #1b6e2c } .missed { color: #b00020; font-weight: bold } .not { color: #777 }
img { max-width: 100%; height: auto }
figure { margin: 1.5em 0 } figcaption { font-size: 14px; color: #444 }
.facts { font-size: 13px; color: #555 }
</style></head><body>
<h1>Study of the god object</h1>
)";

const char* look(const Finding& finding) {
  if (!finding.not_judged.empty() || !finding.most) return "not";
  return is_held(finding) ? "held" : "missed";
}

std::string value_text(double value, const std::string& unit) {
  if (std::isnan(value)) return "no number";
  return unit.empty() ? fmt::format("{:.4g}", value) : fmt::format("{:.4g} {}", value, html_text(unit));
}

std::string verdict_rows(const std::vector<Finding>& findings) {
  std::string text =
      "<div class=\"wide\"><table><tr><th>row</th><th>quantity</th><th>verdict</th><th class=\"number\">measured</th>"
      "<th class=\"number\">at most</th>"
      "<th>where</th></tr>\n";
  for (const Finding& finding : findings) {
    text += fmt::format(
        "<tr><td>{}</td><td>{}</td><td class=\"{}\">{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td>"
        "<td>{}</td></tr>\n",
        html_text(finding.row), html_text(finding.what), look(finding), html_text(verdict_text(finding)),
        finding.not_judged.empty() ? value_text(finding.value, finding.unit) : "-",
        finding.most ? value_text(*finding.most, finding.unit) : "-", html_text(finding.where));
  }
  return text + "</table></div>\n";
}

std::string chapter_html(const PageChapter& entry) {
  const Chapter& chapter = *entry.chapter;
  std::string text = fmt::format("<h2 id=\"{}\">{}</h2>\n{}\n", html_text(chapter.name), html_text(chapter.title),
                                 chapter.introduction);
  text += fmt::format("<p>{}.</p>\n<p class=\"facts\">{} cases, {:.0f} s.</p>\n",
                      html_text(summary(entry.section.findings)), chapter.cases.size(), entry.seconds);
  text += verdict_rows(entry.section.findings);
  for (std::size_t i = 0; i < entry.section.pictures.size(); ++i) {
    const Picture& picture = entry.section.pictures[i];
    text +=
        fmt::format("<figure><img src=\"data:image/png;base64,{}\" alt=\"{}\"><figcaption>{}</figcaption></figure>\n",
                    base64(entry.pictures[i]), html_text(picture.name), picture.caption);
  }
  return text + entry.section.html;
}

}  // namespace

std::string base64(const std::string& bytes) {
  constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t k = 0; k < 3; ++k) {
      word = word << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    }
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[word >> (18 - 6 * k) & 63u] : '=';
  }
  return text;
}

std::string page(const PageContent& content) {
  std::string text = kHead;
  for (const std::string& sentence : content.made_by)
    text += fmt::format("<p class=\"facts\">{}</p>\n", html_text(sentence));
  text += "<ul>\n";
  for (const PageChapter& entry : content.chapters) {
    text += fmt::format("<li><a href=\"#{}\">{}</a>: {}</li>\n", html_text(entry.chapter->name),
                        html_text(entry.chapter->title), html_text(summary(entry.section.findings)));
  }
  text += "</ul>\n";
  for (const PageChapter& entry : content.chapters) text += chapter_html(entry);
  return text + "</body></html>\n";
}

}  // namespace godobject::report
