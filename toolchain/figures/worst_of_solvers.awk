# From the demo's statistics.csv: for each solver the worst of all paths with loose parts, and of those with tight parts;
# `contact` first. The times are the largest medians; cycles over 1 ms are summed.
# usage: awk -f worst_of_solvers.awk statistics.csv
BEGIN {
  FS = ","
  tight["round-peg"] = tight["rectangular-peg"] = tight["nut-m16"] = tight["gears"] = 1
}
NR == 1 {
  for (i = 1; i <= NF; i++) at[$i] = i
  print "solver,parts,deepest point [mm],behind the plate [mm],force step [N],look-ups [us],solver [us],cycles over 1 ms"
  next
}
{
  group = $at["solver"] "," ($at["scene"] in tight ? "tight" : "loose")
  if (!(group in over)) order[++groups] = group
  keep(deepest, "penetration_max_mm")
  keep(behind, "furthest_behind_barrier_mm")
  keep(step, "largest_force_step_n")
  keep(step1, "step1_p50_us")
  keep(solve, "solve_p50_us")
  over[group] += $at["cycles_over_1ms"]
}
END {
  for (fit = 0; fit < 2; fit++) {
    for (i = groups; i > 0; i--) {
      g = order[i]
      if ((g ~ /tight$/) != fit) continue
      print g "," deepest[g] "," (g in behind ? behind[g] : "-") "," step[g] "," step1[g] "," solve[g] "," over[g]
    }
  }
}
# The largest value of a column; "-" stands for no value.
function keep(worst, column,    value) {
  value = $at[column]
  if (value != "-" && (!(group in worst) || value + 0 > worst[group] + 0)) worst[group] = value
}
