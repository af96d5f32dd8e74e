#pragma once

#include <cstdint>

namespace godobject {

/// Bounds of the loops of `contact`, shared by `contact_cycle` and `ball_cycle`. "Measured" is: by godobject-replay on
/// the demo's paths, with and without friction.

/// Most obstacles in a sub-step that become a row; after that the motion is shortened instead. Measured: 4 gives the
/// same replays; with 2 and with 10 only the handle's and the peg's change, by less than 1 % of the force.
inline constexpr int kMostSecondLooks = 6;
/// Most attempts at a motion in a sub-step; after the last one the god object stays. Measured: 10 and 24 change no
/// replay. Derived: six second looks and four times rows of bounded points leave eight attempts, whose shortening
/// leaves less than a thousandth of the motion.
inline constexpr int kMostAttempts = 18;
/// Most times in a sub-step that bounded points become rows and the motion is computed again; then they become second
/// looks. Chosen.
inline constexpr int kMostExtensions = 4;
/// Most sub-steps without a near point in one cycle. Measured: 8 changes no replay; with 1 the god object lags in up to
/// 143 cycles a path, and the peak force over the teapot rises from 8.9 to 16.4 N.
inline constexpr std::uint32_t kMostFreeSubsteps = 64;
/// Most free balls along one chord. Measured: with 16 a second sub-step follows in 33 instead of 25 cycles over the
/// teapot, with 4 in 87 instead of 36 in the handle; 256 changes only some 20 cycles in the handle and the hole.
inline constexpr int kMostBallsOfChord = 64;
/// Look-ups for free balls in one cycle. The remaining motion is dropped when they are used up. Without vectors a flat
/// face of a thousand points that slides by a millimetre a cycle takes 50000; with fewer the god object would fall
/// behind for good.
inline constexpr int kMostBallsOfCycle = 1 << 17;
/// Near points beyond this share of the search radius get a bound in place of an exact look-up, and become rows only
/// once they are in the way. ContactSubsteps::exact_radius has the lower bounds. Chosen: on the demo's paths
/// the times with 0.15, 0.3 and 0.5 differ by about a tenth, as those of two runs do.
inline constexpr double kExactShare = 0.15;
/// Most times in a sub-step that rows of left-out near points are added. Derived: each time adds the worst row of each
/// 64 neighbours, until the rows are full.
inline constexpr int kMostRefills = 8;
/// Most rounds in a sub-step of dropping implied rows and solving again; a round drops the rows that have a force.
/// Chosen.
inline constexpr int kMostImpliedRounds = 3;
/// Distance up to which edge pairs are remembered beyond the search radius, in longest search radii. Measured
/// (tests/bench/instructions): with 2 a sliding cycle takes 0.6 % more instructions, with 1 3 % more.
inline constexpr double kEdgeSlack = 3.0;
/// A motion that would raise the energy again beyond this share of its first decrease stops earlier
/// (`passes_lowest_energy`). At 1 the god object would swing in a valley of the field without end; 0.5 halves the swing
/// each cycle.
inline constexpr double kMostOvershoot = 0.5;
/// A further sub-step follows if the normal of a holding point has turned by more than this on the way [rad]: the force
/// is that of the normals before the motion. Measured: without it a nut of 48 facets resists with 17 % of its torque
/// though it has no friction, in both directions; with 0.02 1 %. That takes few more sub-steps in the demo's paths,
/// 0.01 twice as much time on the nut.
inline constexpr double kMostTurn = 0.02;
/// A motion that ends farther from the wanted one than rest may do so by this many times the largest required gain,
/// else its rows count as contradictory: a ball that fits tightly into a bore could regain its margins only by leaving
/// it. Chosen: rounding gives levers above 10^4; a flat box in a bore 0.07 % wider than the box regains its margin with
/// a lever of some 80 (way_out_test).
inline constexpr double kMostLever = 1000.0;
}  // namespace godobject
