#include "toolchain/report/work_precision/bounds.h"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

namespace godobject::report {
namespace {

struct Errors {
  const char* scene;
  const char* setting;
  bool friction;
  double force, torque;  ///< [%]
  double penetration;    ///< [mm]
};

/// A torque that is not rendered at all is an error of 100 %.
constexpr Errors kErrorsOf[] = {
    {"bunny-teapot", "as written", false, 35.0, 70.0, 0.5}, {"bunny-teapot", "as written", true, 60.0, 95.0, 0.5},
    {"bunny-teapot", "plain", false, 35.0, 70.0, 0.9},      {"bunny-teapot", "plain", true, 60.0, 95.0, 0.75},
    {"bunny-teapot", kRecommended, true, 60.0, 95.0, 1.0},  {"bunny-plate", "as written", false, 4.5, 20.0, 0.11},
    {"bunny-plate", "as written", true, 7.5, 30.0, 0.11},   {"bunny-plate", "plain", false, 4.5, 20.0, 0.11},
    {"bunny-plate", "plain", true, 7.5, 30.0, 0.11},        {"bunny-plate", kRecommended, true, 7.5, 30.0, 0.5},
    {"peg-hole", "as written", false, 95.0, 20.0, 0.03},    {"peg-hole", "as written", true, 95.0, 22.0, 0.03},
    {"peg-hole", "plain", false, 95.0, 20.0, 0.06},         {"peg-hole", "plain", true, 95.0, 22.0, 0.045},
    {"peg-hole", kRecommended, true, 95.0, 22.0, 0.1},
};

/// Largest error of `contact` over that of `paper`.
struct OfPaper {
  const char* scene;
  double most;
};
constexpr OfPaper kOfPaper[] = {{"bunny-teapot", 0.15}, {"bunny-plate", 0.25}, {"peg-hole", 0.5}};

ErrorBounds bounds_of(const Errors& errors) {
  const bool timed = std::string(errors.setting) == kRecommended;  // the clock chooses it
  const auto bound = [&](const char* what, const char* unit, double most) {
    return Bound{errors.scene,
                 fmt::format("{} setting, friction {}: {}", errors.setting, errors.friction ? "on" : "off", what), unit,
                 most, timed};
  };
  return {bound("force error", "%", errors.force), bound("torque error", "%", errors.torque),
          bound("deepest penetration", "mm", errors.penetration)};
}

}  // namespace

ErrorBounds error_bounds(const std::string& scene, const std::string& setting, bool friction) {
  return bounds_of(*std::find_if(std::begin(kErrorsOf), std::end(kErrorsOf), [&](const Errors& errors) {
    return errors.scene == scene && errors.setting == setting && errors.friction == friction;
  }));
}

Bound cost_bound(const std::string& scene) {
  return {scene, "p99 of the recommended setting, measured again", "us", kBudget_us, true};
}

Bound paper_bound(const std::string& scene) {
  const OfPaper& found =
      *std::find_if(std::begin(kOfPaper), std::end(kOfPaper), [&](const OfPaper& each) { return each.scene == scene; });
  return {scene, "wrench error of contact over that of paper at the same cost or less", "", found.most, true};
}

std::vector<Bound> precision_bounds() {
  std::vector<Bound> bounds;
  for (const Errors& errors : kErrorsOf) {
    const ErrorBounds of_setting = bounds_of(errors);
    bounds.insert(bounds.end(), {of_setting.force, of_setting.torque, of_setting.penetration});
  }
  for (const OfPaper& each : kOfPaper) {
    bounds.push_back(cost_bound(each.scene));
    bounds.push_back(paper_bound(each.scene));
  }
  return bounds;
}

}  // namespace godobject::report
