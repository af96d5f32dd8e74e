#pragma once

#include <filesystem>
#include <string>

namespace godobject::viewer {

/// Renders a POV-Ray scene to a PNG file, without a display. The file appears when it is complete. Takes seconds.
/// Throws Failure if POV-Ray is not installed or fails, or the file cannot be written.
void render(const std::string& pov_text, int width, int height, const std::filesystem::path& png);

}  // namespace godobject::viewer
