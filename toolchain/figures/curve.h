#pragma once

#include <string>
#include <vector>

namespace godobject::figures {

/// A point of a curve over time.
struct Sample {
  double t = 0.0;      ///< [s]
  double value = 0.0;  ///< in the unit of its axis; NaN: a gap in the curve
};

/// Returns a curve with fewer samples that looks the same: the samples are divided into 650 parts of equal length, and
/// of each part the first, the lowest, the highest and the last sample stay, and the first one of a gap. So no peak is
/// lost.
std::vector<Sample> thinned(const std::vector<Sample>& curve);

/// Returns the curve, thinned, as gnuplot data block with this name ("$name"): a line "t value" for each sample.
std::string curve_block(const std::string& name, const std::vector<Sample>& curve);

}  // namespace godobject::figures
