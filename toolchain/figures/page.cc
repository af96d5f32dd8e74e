#include "toolchain/figures/page.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <tuple>

#include <fmt/format.h>

#include "toolchain/figures/table.h"
#include "toolchain/files/html_text.h"

namespace godobject::figures {
namespace {

const char* const kHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>God object: results of this run</title>
<style>
body { font: 16px/1.5 sans-serif; color: #222; max-width: 1200px; margin: 2em auto; padding: 0 1em }
table { border-collapse: collapse; font-size: 13px }
th, td { padding: 2px 8px; border-bottom: 1px solid #ddd; text-align: right; white-space: nowrap }
th:nth-child(-n+2), td:nth-child(-n+2) { text-align: left }
.wide { overflow-x: auto }
img { max-width: 100%; height: auto }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(360px, 1fr)); gap: 12px }
dt { font-weight: bold } figure { margin: 0 } figcaption { font-size: 13px; color: #555 }
</style></head><body>
<h1>God object: results of this run</h1>
<p>In the pictures the voxelised object is green. The moving object is red at the device pose and blue at the pose of
the god object. Depths are those of the sample points of the god object. Times are those of this run, over the cycles in contact. All
solvers get the same device path:</p>
<dl>
<dt>contact</dt><dd>The default. It computes the least-constraint motion over all contact points at once, by a small
quadratic programme with Coulomb friction at each point, in sub-steps that are certified not to meet the surface. It
keeps all points a hundredth of a voxel off the surface.</dd>
<dt>corrected</dt><dd>One projection in closed form from one wrench for all contacts. It is exact for a single
contact, not for several.</dd>
<dt>paper</dt><dd>The published heuristic as printed, for comparison.</dd>
</dl>
)";

/// Returns an HTML table with a line for each of `rows`.
template <class Column, class Row>
std::string cells_html(const std::vector<Column>& columns, const std::vector<Row>& rows) {
  std::string text = "<div class=\"wide\"><table><tr>";
  for (const Column& column : columns) text += fmt::format("<th>{}</th>", files::html_text(column.heading));
  text += "</tr>\n";
  for (const Row& row : rows) {
    text += "<tr>";
    for (const Column& column : columns) text += fmt::format("<td>{}</td>", files::html_text(column.value(row)));
    text += "</tr>\n";
  }
  return text + "</table></div>\n";
}

std::string table_html(const std::vector<Entry>& entries) {
  return cells_html(columns(), entries) +
         "<p>Depth: deepest sample point in contact, in the stored distances; below 0: none is inside, and the "
         "nearest is that far from the surface. Edges and faces between the points may overlap. Behind: distance "
         "behind the plate. Force step: largest change of the force from one cycle to the next. Points: colliding "
         "points (paper, corrected), or "
         "rows with a force (contact). Cut: cycles whose motion could not be finished. Overflow: cycles with more "
         "near points than the solver has room for. Infeasible: cycles whose constraints have no solution. #1: "
         "look-ups. #2-#7: the rest of a cycle. p50, p99: median and 99th percentile over the cycles in contact. The "
         "table as <a href=\"statistics.csv\">CSV</a>.</p>\n";
}

std::string list(const std::vector<std::string>& sentences) {
  std::string text = "<ul>\n";
  for (const std::string& sentence : sentences) text += fmt::format("<li>{}</li>\n", files::html_text(sentence));
  return text + "</ul>\n";
}

/// A picture of a scene's folder: "corrected_1.200.png".
struct Picture {
  std::string name;
  std::string solver;
  std::string moment;
};

Picture picture_of(const std::filesystem::path& file) {
  const std::string stem = file.stem().string();
  const std::size_t line = std::min(stem.rfind('_'), stem.size());
  return {file.filename().string(), stem.substr(0, line), line < stem.size() ? stem.substr(line + 1) : ""};
}

/// Returns the pictures in a scene's folder without the figure, by moment, then by solver.
std::vector<Picture> pictures(const std::filesystem::path& folder) {
  std::vector<Picture> found;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const auto& file = entry.path();
    if (file.extension() == ".png" && file.stem() != "figure") found.push_back(picture_of(file));
  }
  std::sort(found.begin(), found.end(), [](const Picture& a, const Picture& b) {
    return std::tie(a.moment, a.solver, a.name) < std::tie(b.moment, b.solver, b.name);
  });
  return found;
}

/// Returns a caption such as "corrected, 1.200 s: depth 0.123 mm, force 4.5 N", or the name of the file if the picture
/// does not belong to a replay.
std::string caption(const Picture& picture, const std::vector<Figure::Series>& all) {
  std::vector<const ReplayLog*> logs;
  for (const auto& series : all) logs.push_back(&series.log);
  const auto own =
      std::find_if(all.begin(), all.end(), [&](const auto& series) { return series.solver == picture.solver; });
  const std::optional<double> t = moment(picture.moment, logs);
  if (own == all.end() || !t) return picture.name;
  const ReplayRow& row = row_at(own->log, *t, picture.name);
  return fmt::format("{}, {:.3f} s{}: depth {:.3f} mm, force {:.1f} N", picture.solver, row.t,
                     picture.moment == "deepest" ? " (largest depth of all solvers)" : "", 1e3 * row.depth,
                     row.wrench.force.norm());
}

/// Returns the section of a scene: figure and pictures.
std::string scene_html(const ScenePlan& plan, const std::string& facts, const std::vector<Figure::Series>& series,
                       const std::filesystem::path& folder) {
  const std::string name = files::html_text(plan.name);
  std::string text = fmt::format(
      "<h2 id=\"{0}\">{1}</h2>\n<p>{2}</p>\n<p>{3}</p>\n<p><a href=\"{0}/figure.png\"><img src=\"{0}/figure.png\" "
      "alt=\"{1}\"></a></p>\n",
      name, files::html_text(plan.title), files::html_text(plan.text), files::html_text(facts));
  text += "<div class=\"pictures\">\n";
  for (const Picture& picture : pictures(folder / plan.name)) {
    text += fmt::format(
        "<figure><a href=\"{0}/{1}\"><img src=\"{0}/{1}\" alt=\"{2}\"></a><figcaption>{2}</figcaption></figure>\n",
        name, files::html_text(picture.name), files::html_text(caption(picture, series)));
  }
  return text + "</div>\n";
}

std::string replays_html(const std::string& scene, const std::vector<Entry>& entries) {
  std::string text = "<p>Replays:";
  for (const Entry& entry : entries) {
    if (entry.scene == scene)
      text += fmt::format(" <a href=\"{0}/{1}.csv\">{1}</a>", files::html_text(scene), files::html_text(entry.solver));
  }
  return text + "</p>\n";
}

const char* const kArmHead = R"(<h1 id="closed-loop">Closed loop: the controller on a simulated arm</h1>
<p>The controller runs from boot to end, in virtual time. Once a millisecond it reads the joints of a simulated arm,
computes the god object and sends torques to the joints, which act a millisecond later. A hand holds the tool by a
spring and follows the path as far as arm and force allow. So the device pose is where hand and force balance, not the
pose of the path. The solver is contact. In the pictures the moving object is red at the device pose and blue at the
pose of the god object. For times see the replays.</p>
)";

const char* const kArmColumns =
    R"(<p>In contact: number of cycles. Depth: deepest sample point in contact, in the stored distances; below
0: none is inside, and the nearest is that far from the surface. Edges and faces between the points may overlap. Behind:
distance behind the plate. Device: largest distance of the god object from the device. Force: largest force at the hand. Step:
largest change of that force from one cycle to the next. Cut: cycles whose motion could not be finished. Ovf: cycles
with more near points than the solver has room for. Torque: largest share of a joint's limit; most of it holds the
arm. Work: work of the hand on the tool from the first to the last cycle that rendered; friction and dampers absorb
it. In the figures the torque at the hand is about the mesh's origin, depths below -100 um are drawn at -100 um, and
cycles without rendering are blank.</p>
)";

std::string study_html(const StudyPlan& study) {
  return fmt::format("<h2 id=\"{0}\">{1}</h2>\n<p>{2}</p>\n<p>See the <a href=\"{0}/report.html\">report</a>.</p>\n",
                     files::html_text(study.name), files::html_text(study.title), files::html_text(study.text));
}

std::string arm_html(const PageContent& content, const std::filesystem::path& folder) {
  std::string text = kArmHead + cells_html(arm_columns(), content.runs) + kArmColumns;
  text += list(content.run_verdicts);
  for (std::size_t i = 0; i < content.plan.runs.size(); ++i) {
    const ScenePlan& plan = content.plan.runs[i].scene;
    const ArmFigure& figure = content.arm_figures[i];
    text += scene_html(plan, figure.facts, {{"telemetry", rendered(figure.log.cycles)}}, folder);
    text += fmt::format(
        "<p>Logs of the run: <a href=\"{0}/telemetry.csv\">telemetry</a>, <a href=\"{0}/hand.csv\">work of the "
        "hand</a></p>\n",
        files::html_text(plan.name));
  }
  return text;
}

}  // namespace

std::string page(const PageContent& content, const std::filesystem::path& folder) {
  std::string text = kHead;
  text += table_html(content.entries);
  text += "<h2>Verdicts</h2>\n" + list(content.verdicts);
  if (!content.runs.empty()) text += "<p>See also the <a href=\"#closed-loop\">closed loop</a> with an arm.</p>\n";
  for (std::size_t i = 0; i < content.plan.scenes.size(); ++i) {
    const ScenePlan& plan = content.plan.scenes[i];
    text += scene_html(plan, content.figures[i].facts, content.figures[i].series, folder);
    text += replays_html(plan.name, content.entries);
  }
  for (const StudyPlan& study : content.plan.studies) text += study_html(study);
  if (!content.runs.empty()) text += arm_html(content, folder);
  return text + "</body></html>\n";
}

}  // namespace godobject::figures
