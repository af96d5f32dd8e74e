#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace godobject::figures {

/// A line across all panels.
struct Marker {
  std::string name;
  double t = 0.0;  ///< [s]
};

/// Text as gnuplot takes it.
std::string quoted(const std::string& text);

/// The lines of a panel, with their names above it if it is the first.
std::string marker_text(const std::vector<Marker>& markers, bool named);

/// A picture of panels one below the other over the time from `begin` to `end` [s]; keys stand above the first.
struct PanelSheet {
  std::string title;
  std::size_t panels = 0;
  int height = 1500;  ///< [pixels]
  double begin = 0.0;
  double end = 0.0;
};

std::string sheet_head(const PanelSheet& sheet, const std::filesystem::path& png);

/// Before the last panel: the axis of time gets its numbers.
extern const char* const kTimeAxis;

/// Runs the program for gnuplot that `text` makes for the file that it is to write, and puts that at `png`. Throws
/// Failure if gnuplot is not installed or fails, or the file cannot be written.
void draw_with_gnuplot(const std::function<std::string(const std::filesystem::path&)>& text,
                       const std::filesystem::path& png);

}  // namespace godobject::figures
