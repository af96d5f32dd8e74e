#include "toolchain/bench/target.h"

#include <fmt/format.h>

namespace godobject::bench {

Table table_of(const std::vector<Target>& targets) {
  Table table{
      .name = "targets",
      .title = "Targets, for a server with two x86-64 cores",
      .columns = {"quantity", "unit", "target", "measured", "verdict"},
      .rows = {},
      .note = "A missed target does not change the exit code. own: the shortest time of a cycle of all passes."};
  for (const Target& target : targets) {
    table.rows.push_back({target.quantity, target.unit, (target.at_least ? ">= " : "<= ") + digits(target.wanted),
                          digits(target.measured), target.held() ? "held" : "missed"});
  }
  return table;
}

}  // namespace godobject::bench
