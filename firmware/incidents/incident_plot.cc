#include "firmware/incidents/incident_plot.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "firmware/incidents/hand_motion.h"
#include "toolchain/files/html_text.h"

namespace godobject::firmware {
namespace {

constexpr double kBefore = 2.0;  // [s]
constexpr double kAfter = 0.5;   // [s]
constexpr double kLeft = 70.0;   // all lengths in pixels
constexpr double kWidth = 700.0;
constexpr double kTop = 50.0;
constexpr double kHeight = 120.0;
constexpr double kGap = 40.0;

/// A curve over the rows.
struct Panel {
  const char* title;
  std::function<double(std::size_t)> value;  ///< of a row
  double bound;                              ///< not above zero: none
};

std::vector<Panel> panels(const Incident& incident) {
  const IncidentBounds bounds = incident.bounds.value_or(IncidentBounds{});
  const bool known = incident.bounds.has_value();
  const auto torque = [&incident, known](std::size_t k) {
    double largest = 0.0;
    for (int i = 0; i < incident.joint_count; ++i) {
      const double limit = known ? incident.bounds->joints[static_cast<std::size_t>(i)].torque : 1.0;
      largest = std::max(largest, std::fabs(incident.rows[k].torque[i]) / limit);
    }
    return known ? 100.0 * largest : largest;
  };
  return {
      {"force at the hand [N]", [&incident](std::size_t k) { return incident.rows[k].force.norm(); }, bounds.force},
      {known ? "largest torque of a joint [% of its limit]" : "largest torque of a joint [Nm]", torque,
       known ? 100.0 : 0.0},
      {"speed of the hand [m/s]", [&incident](std::size_t k) { return hand_speed(incident, k); }, bounds.speed_stop},
      {"lateness of waking [us]", [&incident](std::size_t k) { return 1e6 * incident.rows[k].late; }, 0.0}};
}

double x_of(double t) { return kLeft + kWidth * (t + kBefore) / (kBefore + kAfter); }

std::string line(double x1, double y1, double x2, double y2, const char* style) {
  return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", x1, y1, x2, y2, style);
}

std::string words(double x, double y, const char* anchor, const std::string& text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor,
                     files::html_text(text));
}

std::string draw_panel(const Incident& incident, const Panel& panel, double top) {
  const double stop_t = incident.rows[*incident.stop].t;
  std::vector<std::pair<double, double>> points;
  double highest = 0.0;
  for (std::size_t k = 0; k < incident.rows.size(); ++k) {
    const double t = incident.rows[k].t - stop_t;
    if (t < -kBefore || t > kAfter) continue;
    const double value = panel.value(k);
    points.emplace_back(t, std::isfinite(value) ? value : 0.0);
    highest = std::max(highest, points.back().second);
  }
  const bool shows_bound = panel.bound > 0.0 && panel.bound < 4.0 * highest;  // else the curve would be flat
  if (shows_bound) highest = std::max(highest, panel.bound);
  if (!(highest > 0.0)) highest = 1.0;
  const auto y_of = [&](double value) { return top + kHeight * (1.0 - std::max(value, 0.0) / highest); };
  std::string svg = fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" stroke=\"#999\"/>\n", kLeft,
      top, kWidth, kHeight);
  svg += words(kLeft, top - 6.0, "start", panel.title);
  svg += words(kLeft - 6.0, top + 10.0, "end", fmt::format("{:.3g}", highest));
  svg += words(kLeft - 6.0, top + kHeight, "end", "0");
  if (shows_bound) {
    svg +=
        line(kLeft, y_of(panel.bound), kLeft + kWidth, y_of(panel.bound), "stroke=\"#c60\" stroke-dasharray=\"6 4\"");
  }
  svg += "<polyline fill=\"none\" stroke=\"#06c\" stroke-width=\"1.2\" points=\"";
  for (const auto& [t, value] : points) svg += fmt::format("{:.1f},{:.1f} ", x_of(t), y_of(value));
  svg += "\"/>\n";
  return svg + line(x_of(0.0), top, x_of(0.0), top + kHeight, "stroke=\"#c00\" stroke-width=\"1.5\"");
}

}  // namespace

std::string draw(const Incident& incident) {
  const IncidentRow& stop = incident.rows[*incident.stop];
  const std::string what = describe(stop.fault);  // then a semicolon and the cure
  const std::vector<Panel> all = panels(incident);
  const double bottom = kTop + static_cast<double>(all.size()) * (kHeight + kGap);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
      "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      kLeft + kWidth + 30.0, bottom + 10.0);
  svg += words(kLeft, 20.0, "start",
               fmt::format("fault {}: {}", static_cast<int>(stop.fault), what.substr(0, what.find(';'))));
  double top = kTop;
  for (const Panel& panel : all) {
    svg += draw_panel(incident, panel, top);
    top += kHeight + kGap;
  }
  for (double t = -kBefore; t < kAfter + 1e-9; t += 0.5) {
    svg += words(x_of(t), bottom - kGap + 16.0, "middle", std::fabs(t) < 1e-9 ? "stop" : fmt::format("{:+.1f} s", t));
  }
  return svg + "</svg>\n";
}

}  // namespace godobject::firmware
