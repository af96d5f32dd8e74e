#include "toolchain/bench/page.h"

#include <fmt/format.h>

#include "toolchain/figures/gnuplot.h"
#include "toolchain/files/atomic_file.h"
#include "toolchain/files/html_text.h"

namespace godobject::bench {
namespace {

const char* const kHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Run times of the god object</title>
<style>
body { font: 16px/1.5 sans-serif; color: #222; max-width: 1200px; margin: 2em auto; padding: 0 1em }
table { border-collapse: collapse; font-size: 13px }
th, td { padding: 2px 8px; border-bottom: 1px solid #ddd; text-align: right; white-space: nowrap }
th:nth-child(-n+2), td:nth-child(-n+2) { text-align: left }
.wide { overflow-x: auto }
img { max-width: 100%; height: auto }
</style></head><body>
<h1>Run times of the god object</h1>
)";

void write(const std::filesystem::path& file, const std::string& text) {
  files::AtomicFile out(file);
  out.write(text);
  out.commit();
}

/// Returns a gnuplot program that draws the plot into `png`.
std::string plot_text(const Plot& plot, const std::filesystem::path& png) {
  using figures::quoted;
  std::string text = fmt::format(
      "set terminal pngcairo size 1000,600 font 'DejaVu Sans,11' background rgb 'white' noenhanced\nset output {}\n"
      "set title {}\nset xlabel {}\nset ylabel {}\nset logscale xy\nset grid lc rgb '#dddddd'\nset key left top\n",
      quoted(png.string()), quoted(plot.title), quoted(plot.x_label), quoted(plot.y_label));
  std::string curves;
  for (std::size_t c = 0; c < plot.curves.size(); ++c) {
    const Curve& curve = plot.curves[c];
    if (curve.x.empty()) continue;
    text += fmt::format("$curve{} << END\n", c);
    for (std::size_t i = 0; i < curve.x.size(); ++i) text += fmt::format("{} {}\n", curve.x[i], curve.y[i]);
    text += "END\n";
    curves += fmt::format("{}$curve{} using 1:2 with linespoints pt 7 lw 2 title {}", curves.empty() ? "" : ", ", c,
                          quoted(curve.name));
  }
  return text + "plot " + curves + "\n";
}

}  // namespace

void write_page(const Chapter& found, const std::vector<std::pair<std::string, std::string>>& machine,
                const std::filesystem::path& folder) {
  std::string html = kHead;
  std::string facts = "what,value\n";
  html += "<table>";
  for (const auto& [key, value] : machine) {
    html += fmt::format("<tr><td>{}</td><td>{}</td></tr>\n", files::html_text(key), files::html_text(value));
    facts += fmt::format("{},\"{}\"\n", key, value);
  }
  html += "</table>\n";
  write(folder / "machine.csv", facts);
  for (const auto* tables : {&found.tables, &found.details}) {
    for (const Table& table : *tables) {
      write(folder / (table.name + ".csv"), csv_of(table));
      html += html_of(table);
    }
  }
  for (const Plot& plot : found.plots) {
    figures::draw_with_gnuplot([&](const std::filesystem::path& png) { return plot_text(plot, png); },
                               folder / (plot.name + ".png"));
    html += fmt::format("<p><img src=\"{}.png\" alt=\"{}\"></p>\n", plot.name, files::html_text(plot.title));
  }
  html += "<ul>\n";
  for (const std::string& remark : found.remarks) html += fmt::format("<li>{}</li>\n", files::html_text(remark));
  html += "</ul>\n</body></html>\n";
  write(folder / "index.html", html);
}

}  // namespace godobject::bench
