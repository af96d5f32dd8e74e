#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace godobject::figures {

/// A named time, drawn as a line across all panels.
struct Marker {
  std::string name;
  double t = 0.0;  ///< [s]
};

/// Returns the text as a string of gnuplot.
std::string quoted(const std::string& text);

/// Returns gnuplot commands for the markers of a panel; `named`: with their names above it.
std::string marker_text(const std::vector<Marker>& markers, bool named);

/// A picture of panels, one below the other, over the time from `begin` to `end` [s]. The keys are above the first.
struct PanelSheet {
  std::string title;
  std::size_t panels = 0;
  int height = 1500;  ///< [pixels]
  double begin = 0.0;
  double end = 0.0;
};

/// Returns gnuplot commands that begin the picture in the SVG file `svg`.
std::string sheet_head(const PanelSheet& sheet, const std::filesystem::path& svg);

/// Gnuplot command before the last panel: it labels the axis of time.
extern const char* const kTimeAxis;

/// Draws a picture into the file `picture`. `text` returns the gnuplot program for a given output file. Throws Failure
/// if gnuplot is not installed or fails, or the file cannot be written.
void draw_with_gnuplot(const std::function<std::string(const std::filesystem::path&)>& text,
                       const std::filesystem::path& picture);

}  // namespace godobject::figures
