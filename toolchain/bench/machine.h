#pragma once

#include <string>
#include <utility>
#include <vector>

namespace godobject::bench {

/// Returns the facts of this machine and build: processor, caches, kernel, compiler, commit, load, cost of the clock.
std::vector<std::pair<std::string, std::string>> machine_facts();

}  // namespace godobject::bench
