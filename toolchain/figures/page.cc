#include "toolchain/figures/page.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "toolchain/figures/table.h"

namespace godobject::figures {
namespace {

const char* const kHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>The god object, measured</title>
<style>
body { font: 16px/1.5 sans-serif; color: #222; max-width: 1200px; margin: 2em auto; padding: 0 1em }
table { border-collapse: collapse; font-size: 13px }
th, td { padding: 2px 8px; border-bottom: 1px solid #ddd; text-align: right; white-space: nowrap }
th:nth-child(-n+2), td:nth-child(-n+2) { text-align: left }
.wide { overflow-x: auto }
img { max-width: 100%; height: auto }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(360px, 1fr)); gap: 12px }
figure { margin: 0 } figcaption { font-size: 13px; color: #555 }
</style></head><body>
<h1>The god object, measured</h1>
<p>The voxelised object is green. The moving object is red where the device has it, blue where the god object keeps it.
Depths are those of the god object; times are those of this run, of cycles in contact.</p>
)";

std::string escaped(std::string_view text) {
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

std::string table_html(const std::vector<Entry>& entries) {
  std::string text = "<div class=\"wide\"><table><tr>";
  for (const Column& column : columns()) text += fmt::format("<th>{}</th>", escaped(column.heading));
  text += "</tr>\n";
  for (const Entry& entry : entries) {
    text += "<tr>";
    for (const Column& column : columns()) text += fmt::format("<td>{}</td>", escaped(column.value(entry)));
    text += "</tr>\n";
  }
  return text + "</table></div>\n<p>The same as <a href=\"statistics.csv\">CSV</a>.</p>\n";
}

std::string list(const std::vector<std::string>& sentences) {
  std::string text = "<ul>\n";
  for (const std::string& sentence : sentences) text += fmt::format("<li>{}</li>\n", escaped(sentence));
  return text + "</ul>\n";
}

/// Names of the pictures in a scene's folder, the figure left out, in alphabetical order.
std::vector<std::string> pictures(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const auto& file = entry.path();
    if (file.extension() == ".png" && file.stem() != "figure") names.push_back(file.filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// "corrected_1.200.png" -> "corrected, 1.200 s"
std::string caption(const std::string& name) {
  const std::string stem = name.substr(0, name.size() - std::string_view(".png").size());
  const std::size_t line = stem.rfind('_');
  return line == std::string::npos ? stem : fmt::format("{}, {} s", stem.substr(0, line), stem.substr(line + 1));
}

std::string scene_html(const ScenePlan& plan, const std::vector<Entry>& entries, const std::filesystem::path& folder) {
  const std::string name = escaped(plan.name);
  std::string text = fmt::format(
      "<h2 id=\"{0}\">{1}</h2>\n<p>{2}</p>\n<p><a href=\"{0}/figure.png\"><img src=\"{0}/figure.png\" "
      "alt=\"{1}\"></a></p>\n",
      name, escaped(plan.title), escaped(plan.text));
  text += "<div class=\"pictures\">\n";
  for (const std::string& picture : pictures(folder / plan.name)) {
    text += fmt::format(
        "<figure><a href=\"{0}/{1}\"><img src=\"{0}/{1}\" alt=\"{2}\"></a><figcaption>{2}</figcaption></figure>\n",
        name, escaped(picture), escaped(caption(picture)));
  }
  text += "</div>\n<p>Replays:";
  for (const Entry& entry : entries) {
    if (entry.scene == plan.name) text += fmt::format(" <a href=\"{0}/{1}.csv\">{1}</a>", name, escaped(entry.solver));
  }
  return text + "</p>\n";
}

}  // namespace

std::string page(const std::vector<ScenePlan>& plans, const std::vector<Entry>& entries,
                 const std::vector<std::string>& verdicts, const std::filesystem::path& folder) {
  std::string text = kHead;
  text += table_html(entries);
  text += "<h2>What the paper claims</h2>\n" + list(verdicts);
  for (const ScenePlan& plan : plans) text += scene_html(plan, entries, folder);
  return text + "</body></html>\n";
}

}  // namespace godobject::figures
