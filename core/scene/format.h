#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

/// The scene image on disk: one file, read in place, no pointers, no parsing.
///
///   Header | Section table | sections, each starting at a multiple of 64, ascending, without holes but padding
///
/// Every byte of the file is covered by a checksum: the header's covers header and table (itself taken as 0) up to the
/// first section, a section's covers its bytes and the zero padding behind them up to the next section or the end.
/// Numbers are little-endian IEEE 754 / two's complement; lengths are metres in W (the still mesh's frame).
namespace godobject {
enum class Solver : std::uint32_t;  // godobject/scene.h, which kernels with flags of their own must not include
}

namespace godobject::format {

inline constexpr char kMagic[8] = {'G', 'O', 'D', 'O', 'B', 'J', '\r', '\n'};
inline constexpr std::uint32_t kByteOrder = 0x01020304;
inline constexpr std::uint32_t kVersion = 8;
inline constexpr std::size_t kAlignment = 64;
inline constexpr std::size_t kMaxSections = 24;

inline constexpr std::int32_t kMaxBricksPerAxis = 4096;
inline constexpr std::uint32_t kMaxPoints = 1u << 22;
inline constexpr std::uint32_t kMaxLevels = 16;

static_assert(std::endian::native == std::endian::little, "scene images are little-endian");

enum class SectionId : std::uint32_t {
  kSettings = 1,    ///< one Settings
  kGrid = 2,        ///< one Grid
  kBrickIndex = 3,  ///< one std::uint32_t a brick position, x fastest: see IndexEntry
  kBricks = 4,      ///< Brick[]
  kBody = 5,        ///< one Body
  kPoints = 6,      ///< float x[n], y[n], z[n]: sample points in the body frame B, in tree order
  kNormals = 7,     ///< float x[n], y[n], z[n]: unit normals pointing into the body; left out unless `paper` may run
  kNodes = 8,       ///< Node[]: sphere tree in pre-order
  kProvenance = 9,  ///< UTF-8 JSON: what the compiler found and measured; the core never reads it
  kRefined = 10,    ///< Refined[]; left out where no brick is refined

  // The other direction, read by `contact` only; left out where the sample points alone are good enough:
  // feature points of the still body against the moving body's distance.
  kBodyGrid = 11,        ///< one Grid, in the body frame B
  kBodyBrickIndex = 12,  ///< as kBrickIndex
  kBodyBricks = 13,      ///< Brick[]
  kBodyRefined = 14,     ///< Refined[]; left out where no brick is refined
  kFeatures = 15,        ///< one Features
  kFeaturePoints = 16,   ///< float x[n], y[n], z[n]: of the still body, relative to Features::origin, in tree order
  kFeatureNodes = 17,    ///< Node[]: their sphere tree, centres relative to Features::origin

  kEdges = 18,      ///< Edge[]: of the still body; left out where no brick has one
  kBodyEdges = 19,  ///< Edge[]: of the moving body, in B

  kWorkspace = 20,  ///< one Workspace; left out where the moving body may be everywhere
};

struct Header {
  char magic[8];
  std::uint32_t byte_order;
  std::uint32_t version;
  std::uint32_t header_bytes;  ///< sizeof(Header) + section_count * sizeof(Section), rounded up to kAlignment
  std::uint32_t section_count;
  std::uint64_t total_bytes;  ///< the file's size
  std::uint64_t checksum;
  std::uint64_t reserved[3];  ///< 0
};
static_assert(sizeof(Header) == 64);

struct Section {
  SectionId id;
  std::uint32_t reserved;  ///< 0
  std::uint64_t offset;    ///< from the file's begin, multiple of kAlignment
  std::uint64_t bytes;     ///< without padding
  std::uint64_t checksum;  ///< over bytes and padding
};
static_assert(sizeof(Section) == 32);

using Solver = godobject::Solver;
inline constexpr std::uint32_t kSolverCount = 3;
inline constexpr const char* kSolverNames[kSolverCount] = {"paper", "corrected", "contact"};

/// Settings of the scene file for the pipeline. SI units.
struct Settings {
  std::uint32_t default_solver;   ///< format::Solver
  std::uint32_t solvers;          ///< bit (1 << Solver) set: this image holds what that solver reads
  std::uint32_t friction;         ///< 1: the scene has a friction table
  std::uint32_t point_budget;     ///< near points that a sub-step of `contact` looks up, of each direction; 0: all
  double safety_distance;         ///< d [m], > 0
  double margin;                  ///< m of the contact solver [m], > 0
  double stiffness;               ///< k_D [N/m], > 0
  double damping;                 ///< b_D [Ns/m], >= 0
  double coupling_translation;    ///< k_VC,x [1], > 0
  double coupling_rotation;       ///< k_VC,r [m^2], > 0
  double friction_static;         ///< mu_s [1], >= friction_kinetic
  double friction_kinetic;        ///< mu_k [1], >= 0
  double friction_viscous;        ///< mu_v [Ns/m] of slip at the contact, >= 0
  double paper_rotation_static;   ///< mu_r,s of Algorithm 1 [1]
  double paper_rotation_kinetic;  ///< mu_r,k of Algorithm 1 [1]
  double paper_viscous;           ///< mu_v of Algorithm 1, per cycle [1]: x and r alike
};
static_assert(sizeof(Settings) == 112);

/// The box that the origin of B, the moving body's centre of mass, does not leave, along the axes of W [m]; low <=
/// high. The image may leave out data that no pose in the box needs. A brick position that no look-up of a cycle meets
/// is stored as far and inside, so a point that came there would count as inside. Points that can touch nothing are
/// left out.
struct Workspace {
  double low[3];
  double high[3];
};
static_assert(sizeof(Workspace) == 48);

/// A body's signed distance: nodes on a lattice of edge `voxel_size`, kept in bricks of kBrickCells^3 cells.
/// Node (i, j, k) stands at origin + voxel_size * (i, j, k). The still body's stands in W, the moving body's in B.
struct Grid {
  double origin[3];
  double voxel_size;      ///< s [m]
  double band;            ///< |distance| < band is stored [m]
  double surface_min[3];  ///< bounding box of the surface (of shells: thickened)
  double surface_max[3];
  double lipschitz;        ///< bound of the field's gradient norm, seams (see Brick) left out [1]
  double lipschitz_seam;   ///< the same with seams, as encode_lipschitz has it [1]
  double clearance_slope;  ///< >= 1: of Brick::lipschitz and of far clearances, see there [1]
  double quantum;          ///< of Brick::value where nothing is refined [m]
  double outside_loss;     ///< of a point outside the grid, at D from the surface's box, E = D - outside_loss is what
                           ///< a far clearance E about it would be (see index_entry), but for what the stored field
                           ///< is off the exact one [m]
  std::int32_t bricks[3];  ///< brick positions along x, y, z
  std::uint32_t brick_count;  ///< stored bricks, those of refinements included
};
static_assert(sizeof(Grid) == 144);

inline constexpr int kBrickCells = 4;                ///< cells along an edge of a brick
inline constexpr int kBrickNodes = kBrickCells + 1;  ///< nodes along an edge: neighbours share a face of nodes
inline constexpr int kBrickValues = kBrickNodes * kBrickNodes * kBrickNodes;

/// Distances at the nodes of one brick, x fastest: value[x + 5 (y + 5 z)], in units of Grid::quantum, halved as often
/// as the brick is: each the exact one, rounded, but where a refinement meets what is coarser (see Refined); clamped at
/// kKeptBeyondBand voxels beyond the band, which no cell that reaches into the band notices but on a seam. A brick
/// position is stored when a node is nearer than the band or its nodes differ in sign, so whatever lies within the band
/// lies in a stored brick, and every change of sign does. Where an open mesh's sign jumps without a surface (winding
/// number 1/2 across a hole) neighbouring nodes differ by more than the lattice edge: a *seam*.
///
/// Nodes are rounded to the unit, but where a brick k levels finer meets them to a multiple of 2^k units, and more
/// where finer ones meet that: so what is interpolated between them is a whole number of the finer units, and the field
/// continuous in spite of rounding.
struct alignas(64) Brick {
  std::int16_t value[kBrickValues];
  std::uint16_t lipschitz;  ///< bound of the gradient's norm in this brick's position and the 26 about it, >= 1, as
                            ///< encode_lipschitz has it; from a position to its neighbour it changes by a factor of
                            ///< clearance_slope at most
  std::uint16_t
      deviation;       ///< of a position's own nodes: the field, refined or with an edge, is nowhere in the position
                       ///< farther than this from the trilinear interpolation of them [quanta]; 0 of octants
  std::uint16_t edge;  ///< 0: none; else 1 + the number of an Edge
};
static_assert(sizeof(Brick) == 256);

inline constexpr int kLargestValue = 32767;      ///< of |Brick::value|
inline constexpr double kLargestQuantum = 1e-2;  ///< [voxels]
inline constexpr double kMostRoundedOff = 8.0;   ///< a node, in quanta: half of 2^kMaxRefinement
inline constexpr double kKeptBeyondBand = 4.0;   ///< no node is farther beyond the band [voxels]
inline constexpr int kLargestUnsigned = 65535;   ///< of Brick::deviation and Brick::edge
inline constexpr int kLipschitzShift = 11;       ///< see decode_lipschitz
inline constexpr std::uint32_t kLipschitzOne = std::bit_cast<std::uint32_t>(1.0f);

/// 1 .. 65528: a float's upper bits, counted from those of 1.
constexpr float decode_lipschitz(std::uint16_t code) noexcept {
  return std::bit_cast<float>((static_cast<std::uint32_t>(code) << kLipschitzShift) + kLipschitzOne);
}
inline constexpr float kLargestLipschitz = decode_lipschitz(0xffff);

/// Rounds up, by one part in 4096 at most. 1 <= lipschitz <= kLargestLipschitz.
constexpr std::uint16_t encode_lipschitz(float lipschitz) noexcept {
  const std::uint32_t above = std::bit_cast<std::uint32_t>(lipschitz) - kLipschitzOne;
  return static_cast<std::uint16_t>((above + (1u << kLipschitzShift) - 1) >> kLipschitzShift);
}

/// A straight edge of the body, along which trilinear interpolation would ripple. In bricks that name it the field is
///
///   phi(x) = (1 - w(x)) I[phi](x) + w(x) g(x),
///
/// I the trilinear interpolation of the nodes and g the exact signed distance to the infinite wedge whose edge it is,
/// plus `offset`. With t the place along the edge and r the distance from it,
///
///   w = min(2 (1 - r / R(t)), (t - begin) / ramp, (end - t) / ramp) within 0 .. 1,
///   R = min(radius, end_radius + slope (t - begin), end_radius + slope (end - t)).
///
/// Every brick that is looked up and in which w > 0 somewhere names the edge, and none two: the field is continuous.
struct Edge {
  double point[3];      ///< on the edge, t = 0
  double along[3];      ///< unit
  double normal[2][3];  ///< of the faces, unit: out of the body if the edge is convex, into it if it is re-entrant
  double face[2][3];    ///< unit, in the faces, across the edge and away from it
  double side;          ///< +1 convex, -1 re-entrant
  double offset;        ///< [m]
  double begin, end;    ///< [m]
  double ramp;          ///< [m], > 0
  double radius;        ///< [m], >= end_radius
  double end_radius;    ///< [m], > 0
  double slope;         ///< [1], >= 0
  double reserved[6];   ///< 0
};
static_assert(sizeof(Edge) == 256);

/// One entry of the brick index, or of a refinement.
///   bit 31 = 0: stored; bit 30 is 0;
///               bit 29 = 0: bits 0-27 are the brick's number, bit 28: it has an edge;
///               bit 29 = 1: refined, bits 0-27 are the number of a Refined.
///   bit 31 = 1: not stored; bit 30: 1 inside, 0 outside; bits 0-29: `clearance`, the float's bits shifted right by
///   one:
///               for every x within r <= `clearance` of this brick position's centre (outside), whatever brick x lies
///               in, the stored field at x is at least clearance - r, and min(field, band) at least
///               lipschitz (clearance - r) / clearance_slope, lipschitz that of x. Inside it is not read.
namespace index_entry {
inline constexpr std::uint32_t kFar = 1u << 31;
inline constexpr std::uint32_t kInside = 1u << 30;    // with kFar
inline constexpr std::uint32_t kLow = kInside - 1;    // with kFar: the clearance
inline constexpr std::uint32_t kRefined = 1u << 29;   // without kFar
inline constexpr std::uint32_t kEdged = 1u << 28;     // without kFar and kRefined
inline constexpr std::uint32_t kNumber = kEdged - 1;  // without kFar: of a brick or a Refined

/// `clearance` >= 0 [m]; what is decoded is at most one part in 4e6 smaller.
constexpr std::uint32_t encode_far(bool inside, float clearance) noexcept {
  return kFar | (inside ? kInside : 0u) | (std::bit_cast<std::uint32_t>(clearance) >> 1);
}
/// Of Refined::child, with kEdged where the brick that holds it has an edge.
inline constexpr std::uint32_t kCoarse = kFar;

constexpr float far_clearance(std::uint32_t entry) noexcept { return std::bit_cast<float>((entry & kLow) << 1); }
}  // namespace index_entry

/// Finest refinement: kMaxRefinement times halved.
inline constexpr int kMaxRefinement = 4;
static_assert(2.0 * kMostRoundedOff == 1 << kMaxRefinement);

/// A brick where trilinear interpolation between its own nodes is not good enough everywhere. An octant of it (x
/// fastest: ox + 2 oy + 4 oz) is either a brick of kBrickCells^3 cells of half the edge, which may be refined again, or
/// coarse: looked up in the brick's own nodes. Where an octant touches a coarser brick its nodes on the common face,
/// edge or corner carry the coarser brick's interpolated value, and where it touches a position that is not stored that
/// of its own position's nodes, so that the field is continuous.
///
/// Refinements are numbered in the order in which a walk meets them: index entries ascending, each refinement before
/// those of its children, children ascending. None is met twice, none is left out.
struct Refined {
  std::uint32_t brick;     ///< number of the own nodes. Of a position always: clearances and the paper's layers read
                           ///< them. Of an octant only where a child is coarse, else kNoBrick
  std::uint32_t child[8];  ///< index entries; kCoarse: looked up in `brick`
};
inline constexpr std::uint32_t kNoBrick = ~0u;
static_assert(sizeof(Refined) == 36);

/// Of the still body's feature points, what Body is for the sample points: where the sample points of the moving body
/// alone could miss it (vertices, sharp edges, spikes).
struct Features {
  double origin[3];  ///< in W [m]
  double radius;     ///< largest distance of a feature point from the origin [m], > 0
  std::uint32_t point_count;
  std::uint32_t node_count;
  std::uint32_t level_count;
  std::uint32_t reserved;  ///< 0
};
static_assert(sizeof(Features) == 48);

/// Of the moving body. Body frame B: centre of mass, principal axes. Moving mesh frame M (scaled to metres).
struct Body {
  double rotation_MB[4];              ///< quaternion w, x, y, z
  double translation_MB[3];           ///< centre of mass in M [m]
  double inertia[3];                  ///< principal moments of J_B / m [m^2], ascending, >= 0 (not floored)
  double radius;                      ///< R_max: largest distance of a sample point from the centre of mass [m], > 0
  double sphere_center[3];            ///< of a sphere about all sample points, those that are left out too, in B [m]
  double sphere_radius;               ///< [m], > 0
  double volume;                      ///< [m^3]; 0 where the mesh encloses none
  std::uint32_t inertia_from_points;  ///< 1: mass spread over the surface points, 0: over the closed volume
  std::uint32_t point_count;
  std::uint32_t node_count;
  std::uint32_t level_count;
};
static_assert(sizeof(Body) == 144);

/// Sphere tree over the sample points, in pre-order: the children of node i start at i + 1; `skip` is the next node
/// once the subtree of i is left out. Node 0 (level 0) holds all points, which are in tree order: a subtree's are
/// contiguous. As it is sampled the nodes of level k = 1 .. level_count - 1 are hierarchy level k, each level a
/// sampling of the whole surface that holds the one before, and a subtree's first point is the node's own sample; the
/// points themselves are level level_count. Points that can touch nothing, and levels that make nothing quicker, are
/// left out afterwards: then neither need be.
struct Node {
  float center[3];  ///< of a sphere around all points of the subtree, in B; minimal up to rounding, never too small
  float radius;
  std::uint32_t skip;         ///< > own index, <= node_count
  std::uint32_t first_point;  ///< of the subtree; the node's sample
  std::uint32_t point_count;  ///< of the subtree, >= 1
  std::uint16_t level;        ///< depth: 0 for node 0, parent's + 1 otherwise
  std::uint16_t leaf;         ///< 1: no child nodes, look at the points
};
static_assert(sizeof(Node) == 32);

/// Checksum of a section or header: a multiplicative hash over 64-bit words, each step a bijection of the state,
/// so any change within one word is seen. `bytes` must be a multiple of 8.
constexpr std::uint64_t kChecksumSeed = 0xcbf29ce484222325u;
inline std::uint64_t checksum(const std::byte* data, std::size_t bytes, std::uint64_t hash = kChecksumSeed) noexcept {
  for (std::size_t i = 0; i + 8 <= bytes; i += 8) {
    std::uint64_t word = 0;
    for (int b = 0; b < 8; ++b) word |= static_cast<std::uint64_t>(data[i + static_cast<std::size_t>(b)]) << (8 * b);
    hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 32;
  }
  return hash;
}

}  // namespace godobject::format
