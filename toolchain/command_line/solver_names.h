#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/scene/format.h"

namespace godobject::command {

/// Returns the names of the solvers in files and on command lines.
inline std::vector<std::string> solver_names() {
  return {std::begin(format::kSolverNames), std::end(format::kSolverNames)};
}

/// Returns the solver of that name; nothing if there is none.
inline std::optional<format::Solver> solver_of(std::string_view name) {
  const auto* found = std::find(std::begin(format::kSolverNames), std::end(format::kSolverNames), name);
  if (found == std::end(format::kSolverNames)) return std::nullopt;
  return static_cast<format::Solver>(found - std::begin(format::kSolverNames));
}

}  // namespace godobject::command
