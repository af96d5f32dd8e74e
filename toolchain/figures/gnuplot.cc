#include "toolchain/figures/gnuplot.h"

#include <fmt/format.h>

#include "toolchain/command_line/external_program.h"
#include "toolchain/files/work_folder.h"

namespace godobject::figures {

const char* const kTimeAxis = "set format x '%g'\nset xlabel 'time [s]'\n";

std::string quoted(const std::string& text) {
  std::string result = "'";  // single quotes are gnuplot's own escape
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result + "'";
}

std::string marker_text(const std::vector<Marker>& markers, bool named) {
  std::string text = "unset arrow\nunset label\n";
  for (const Marker& marker : markers) {
    text += fmt::format("set arrow from {0},graph 0 to {0},graph 1 nohead dt 2 lc rgb '#555555'\n", marker.t);
    if (named) text += fmt::format("set label {} at {},graph 1.08 center\n", quoted(marker.name), marker.t);
  }
  return text;
}

std::string sheet_head(const PanelSheet& sheet, const std::filesystem::path& svg) {
  return fmt::format(
             "set terminal svg size 1300,{} font 'DejaVu Sans,14' background rgb 'white' noenhanced\nset output {}\n",
             sheet.height, quoted(svg.string())) +
         fmt::format("set multiplot layout {},1 title {} margins 0.075,0.985,0.045,0.93 spacing 0.02,0.02\n",
                     sheet.panels, quoted(sheet.title)) +
         fmt::format(
             "set xrange [{}:{}]\nset grid lc rgb '#dddddd'\nset format x ''\nset tics nomirror\nset key at screen "
             "0.985,0.963 right horizontal samplen 3 width 1\n",
             sheet.begin, sheet.end);
}

void draw_with_gnuplot(const std::function<std::string(const std::filesystem::path&)>& text,
                       const std::filesystem::path& picture) {
  const files::WorkFolder folder(picture);
  const std::string drawn = "figure" + picture.extension().string();
  const auto program = folder.write("figure.gp", text(folder.path() / drawn));
  command::run_program({"gnuplot", program.string()}, "gnuplot-nox");
  folder.deliver(drawn.c_str(), picture);
}

}  // namespace godobject::figures
