#pragma once

#include <string>
#include <utility>
#include <vector>

namespace godobject::bench {

/// What a figure was measured on: processor, caches, kernel, compiler, commit, load, the clock's cost.
std::vector<std::pair<std::string, std::string>> machine_facts();

}  // namespace godobject::bench
