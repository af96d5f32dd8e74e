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

constexpr const char* kMovingPicture = "replay.html";  // of godobject-page

const char* const kHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>God object: results of this run</title>
<style>
:root { --ink: #222; --soft: #555; --line: #ddd; --paper: #fff; --held: #1b7a3d; --missed: #b3261e; --link: #0b57d0 }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e4e4e4; --soft: #aaa; --line: #444; --paper: #16181c; --held: #6fd08c; --missed: #ff8a80; --link: #8ab4f8 }
}
body { font: 16px/1.5 sans-serif; color: var(--ink); background: var(--paper); max-width: 1200px; margin: 2em auto;
  padding: 0 1em }
a { color: var(--link) }
.lead { font-size: 20px; max-width: 45em }
.moving { width: 100%; height: min(95vh, 1000px); border: 1px solid var(--line); border-radius: 6px }
table { border-collapse: collapse; font-size: 13px }
th, td { padding: 2px 8px; border-bottom: 1px solid var(--line); text-align: right; white-space: nowrap }
th:nth-child(-n+2), td:nth-child(-n+2) { text-align: left }
.wide { overflow-x: auto }
img { max-width: 100%; height: auto }
.pictures { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(360px, 100%), 1fr)); gap: 12px }
.verdicts { list-style: none; padding: 0 } .verdicts li { margin: 6px 0 }
.verdicts b { color: var(--held) } .verdicts .missed b { color: var(--missed) }
dt { font-weight: bold } figure { margin: 0 } figcaption { font-size: 13px; color: var(--soft) }
@media (max-width: 700px) { .more { display: none } }
</style></head><body>
<h1>God object: results of this run</h1>
<p class="lead">A hand may push into a body, but what it holds does not go in: it stays on the surface, and a spring
pulls the hand back to it.</p>
)";

const char* const kComparison = R"(<h2 id="comparison">Comparison of solvers</h2>
<p>All solvers get the same device path.</p>
<dl>
<dt>contact</dt><dd>The default. It computes the least-constraint motion over all contact points at once, by a small
quadratic programme with Coulomb friction at each point, in sub-steps that are certified not to meet the surface. It
keeps all points a hundredth of a voxel off the surface.</dd>
<dt>corrected</dt><dd>One projection in closed form from one wrench for all contacts. It is exact for a single
contact, not for several.</dd>
<dt>paper</dt><dd>The published heuristic as printed, for comparison.</dd>
</dl>
)";

/// Returns an HTML table with a line for each of `rows`. A narrow screen shows the columns for which `on_phone` is
/// true.
template <class Column, class Row, class OnPhone>
std::string cells_html(const std::vector<Column>& columns, const std::vector<Row>& rows, const OnPhone& on_phone) {
  const auto hidden = [&](const Column& column) { return on_phone(column) ? "" : " class=\"more\""; };
  std::string text = "<div class=\"wide\"><table><tr>";
  for (const Column& column : columns) {
    text += fmt::format("<th{}>{}</th>", hidden(column), files::html_text(column.heading));
  }
  text += "</tr>\n";
  for (const Row& row : rows) {
    text += "<tr>";
    for (const Column& column : columns) {
      text += fmt::format("<td{}>{}</td>", hidden(column), files::html_text(column.value(row)));
    }
    text += "</tr>\n";
  }
  return text + "</table></div>\n";
}

std::string table_html(const std::vector<Entry>& entries) {
  return cells_html(columns(), entries, [](const Column& column) { return column.on_phone; }) +
         "<p>Depth: deepest sample point in contact, in the stored distances; below 0: none is inside, and the "
         "nearest is that far from the surface. Edges and faces between the points may overlap. Behind: distance "
         "behind the plate. Force step: largest change of the force from one cycle to the next. Points: colliding "
         "points (paper, corrected), or "
         "rows with a force (contact). Cut: cycles whose motion could not be finished. Overflow: cycles with more "
         "near points than the solver has room for. Infeasible: cycles whose constraints have no solution. #1: "
         "look-ups. #2-#7: the rest of a cycle. p50, p99: median and 99th percentile over the cycles in contact. A "
         "narrow screen shows some of the columns; <a href=\"statistics.csv\">statistics.csv</a> has all.</p>\n";
}

/// Returns verdicts as a list, their first word in a colour of its own.
std::string list(const std::vector<std::string>& verdicts) {
  std::string text = "<ul class=\"verdicts\">\n";
  for (const std::string& verdict : verdicts) {
    const std::size_t word = std::min(verdict.find(' '), verdict.size());
    text += fmt::format("<li{}><b>{}</b>{}</li>\n", verdict.rfind("MISSED", 0) == 0 ? " class=\"missed\"" : "",
                        files::html_text(verdict.substr(0, word)), files::html_text(verdict.substr(word)));
  }
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

/// Returns the pictures in a scene's folder, by moment, then by solver.
std::vector<Picture> pictures(const std::filesystem::path& folder) {
  std::vector<Picture> found;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const auto& file = entry.path();
    if (file.extension() == ".png") found.push_back(picture_of(file));
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

/// Returns the section of a scene: pictures and figure.
std::string scene_html(const ScenePlan& plan, const std::string& facts, const std::vector<Figure::Series>& series,
                       const std::filesystem::path& folder) {
  const std::string name = files::html_text(plan.name);
  std::string text = fmt::format("<h3 id=\"{}\">{}</h3>\n<p>{}</p>\n<p>{}</p>\n<div class=\"pictures\">\n", name,
                                 files::html_text(plan.title), files::html_text(plan.text), files::html_text(facts));
  for (const Picture& picture : pictures(folder / plan.name)) {
    text += fmt::format(
        "<figure><a href=\"{0}/{1}\"><img src=\"{0}/{1}\" alt=\"{2}\"></a><figcaption>{2}</figcaption></figure>\n",
        name, files::html_text(picture.name), files::html_text(caption(picture, series)));
  }
  return text + fmt::format("</div>\n<p><a href=\"{0}/figure.svg\"><img src=\"{0}/figure.svg\" alt=\"{1}\"></a></p>\n",
                            name, files::html_text(plan.title));
}

bool moves(const ScenePlan& plan, const std::filesystem::path& folder) {
  return std::filesystem::exists(folder / plan.name / kMovingPicture);
}

/// Returns a link to the moving picture of a scene or a run; empty if its folder has none.
std::string moving_link(const ScenePlan& plan, const std::filesystem::path& folder) {
  if (!moves(plan, folder)) return "";
  return fmt::format("<a href=\"{}/{}\">Moving picture</a>. ", files::html_text(plan.name), kMovingPicture);
}

/// Returns the address of a replay or a log from the page in `folder`.
std::string log_link(const PageContent& content, const ScenePlan& plan, const std::string& name,
                     const std::filesystem::path& folder) {
  const std::filesystem::path logs =
      content.logs.empty() ? std::filesystem::path() : std::filesystem::proximate(content.logs, folder);
  return files::html_text((logs / plan.name / (name + ".csv")).generic_string());
}

std::string replays_html(const ScenePlan& plan, const PageContent& content, const std::filesystem::path& folder) {
  std::string text = "<p>" + moving_link(plan, folder) + "Replays:";
  for (const Entry& entry : content.entries) {
    if (entry.scene == plan.name)
      text += fmt::format(" <a href=\"{}\">{}</a>", log_link(content, plan, entry.solver, folder),
                          files::html_text(entry.solver));
  }
  return text + "</p>\n";
}

const char* const kArmHead = R"(<h2 id="closed-loop">Closed loop: the controller on a simulated arm</h2>
<p>The controller runs from boot to end, in virtual time. Once a millisecond it reads the joints of a simulated arm,
computes the god object and sends torques to the joints, which act a millisecond later. A hand holds the tool by a
spring and follows the path as far as arm and force allow. So the device pose is where hand and force balance, not the
pose of the path. The solver is contact.</p>
)";

const char* const kScenes = R"(<h2 id="scenes">Scenes</h2>
<p>In the pictures the voxelised object is green. The moving object is red at the device pose and blue at the pose of
the god object. Depths are those of the sample points of the god object.</p>
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
  const auto on_phone = [](const ArmColumn& column) { return column.on_phone; };
  std::string text = kArmHead + cells_html(arm_columns(), content.runs, on_phone) + kArmColumns;
  for (std::size_t i = 0; i < content.plan.runs.size(); ++i) {
    const ScenePlan& plan = content.plan.runs[i].scene;
    const ArmFigure& figure = content.arm_figures[i];
    text += scene_html(plan, figure.facts, {{"telemetry", rendered(figure.log.cycles)}}, folder);
    text += "<p>" + moving_link(plan, folder);
    text += fmt::format("Logs of the run: <a href=\"{}\">telemetry</a>, <a href=\"{}\">work of the hand</a></p>\n",
                        log_link(content, plan, "telemetry", folder), log_link(content, plan, "hand", folder));
  }
  return text;
}

/// Returns the moving picture of the scene, if its folder has one.
std::string moving_html(const ScenePlan& plan, const std::filesystem::path& folder) {
  if (!moves(plan, folder)) return "";
  return fmt::format(
      "<iframe class=\"moving\" src=\"{0}/{1}\" title=\"{2}\"></iframe>\n<p>{2}. <a "
      "href=\"{0}/{1}\">Open it alone</a>; the file works without this page.</p>\n",
      files::html_text(plan.name), kMovingPicture, files::html_text(plan.title));
}

/// Returns links to the parts of the page.
std::string contents_html(const PageContent& content) {
  std::string text = "<p>";
  if (!content.runs.empty()) text += "<a href=\"#closed-loop\">Closed loop with an arm</a> | ";
  text += "<a href=\"#scenes\">Scenes</a>:";
  for (const ScenePlan& plan : content.plan.scenes) {
    text += fmt::format(" <a href=\"#{}\">{}</a>,", files::html_text(plan.name), files::html_text(plan.title));
  }
  text.back() = ' ';
  for (const StudyPlan& study : content.plan.studies) {
    text += fmt::format("| <a href=\"#{}\">{}</a> ", files::html_text(study.name), files::html_text(study.title));
  }
  return text + "| <a href=\"#comparison\">Comparison of solvers</a> | <a href=\"#times\">Times</a></p>\n";
}

}  // namespace

std::string page(const PageContent& content, const std::filesystem::path& folder) {
  std::string text = kHead + moving_html(content.plan.scenes.front(), folder);
  text += "<h2>What holds</h2>\n" + list(content.verdicts.contact) + list(content.run_verdicts);
  text += contents_html(content);
  if (!content.runs.empty()) text += arm_html(content, folder);
  text += kScenes;
  for (std::size_t i = 0; i < content.plan.scenes.size(); ++i) {
    const ScenePlan& plan = content.plan.scenes[i];
    text += scene_html(plan, content.figures[i].facts, content.figures[i].series, folder);
    text += replays_html(plan, content, folder);
  }
  for (const StudyPlan& study : content.plan.studies) text += study_html(study);
  text += kComparison + list(content.verdicts.compared) + table_html(content.entries);
  text +=
      "<h2 id=\"times\">Times</h2>\n<p>Times are those of this run, over the cycles in contact. A busy machine "
      "makes them longer, so that they tell more about the machine than about a solver.</p>\n" +
      list(content.verdicts.times);
  return text + "</body></html>\n";
}

}  // namespace godobject::figures
