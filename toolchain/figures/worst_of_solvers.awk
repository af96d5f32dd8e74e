# From the demo's statistics.csv: for each solver the worst of all paths, `contact` first. The times are the largest
# medians; cycles over 1 ms are summed.
# usage: awk -f worst_of_solvers.awk statistics.csv
BEGIN { FS = "," }
NR == 1 {
  for (i = 1; i <= NF; i++) at[$i] = i
  print "solver,deepest point [mm],behind the plate [mm],force step [N],look-ups [us],solver [us],cycles over 1 ms"
  next
}
{
  solver = $at["solver"]
  if (!(solver in over)) order[++solvers] = solver
  keep(deepest, "penetration_max_mm")
  keep(behind, "furthest_behind_barrier_mm")
  keep(step, "largest_force_step_n")
  keep(step1, "step1_p50_us")
  keep(solve, "solve_p50_us")
  over[solver] += $at["cycles_over_1ms"]
}
END {
  for (i = solvers; i > 0; i--) {
    s = order[i]
    print s "," deepest[s] "," behind[s] "," step[s] "," step1[s] "," solve[s] "," over[s]
  }
}
# The largest value of a column; "-" stands for no value.
function keep(worst, column,    value) {
  value = $at[column]
  if (value != "-" && (!(solver in worst) || value + 0 > worst[solver] + 0)) worst[solver] = value
}
