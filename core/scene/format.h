#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

/// The scene image on disk: one file that is read in place, without pointers or parsing.
///
///   Header | Section table | sections in ascending order, each at a multiple of 64; only padding lies between them
///
/// A checksum covers every byte of the file. The header's checksum covers the header (the checksum itself counts as 0)
/// and the table, up to the first section. A section's checksum covers its bytes and the zero padding after them.
/// Numbers are little-endian, IEEE 754 or two's complement. Lengths are in metres, in W (the still mesh's frame).
namespace godobject {
enum class Solver : std::uint32_t;  // defined in godobject/scene.h, which kernels with compiler options of their own
                                    // must not include
}

namespace godobject::format {

inline constexpr char kMagic[8] = {'G', 'O', 'D', 'O', 'B', 'J', '\r', '\n'};
inline constexpr std::uint32_t kByteOrder = 0x01020304;
inline constexpr std::uint32_t kVersion = 11;
inline constexpr std::size_t kAlignment = 64;
inline constexpr std::size_t kMaxSections = 32;

inline constexpr std::int32_t kMaxBricksPerAxis = 4096;
inline constexpr std::uint32_t kMaxPoints = 1u << 22;
inline constexpr std::uint32_t kMaxLevels = 16;
inline constexpr std::uint32_t kMaxSharpEdges = (1u << 15) - 1;  ///< of a body
inline constexpr std::uint32_t kMaxSharpEdgeLevels = 24;         ///< depth of their tree

static_assert(std::endian::native == std::endian::little, "scene images are little-endian");

enum class SectionId : std::uint32_t {
  kSettings = 1,    ///< one Settings
  kGrid = 2,        ///< one Grid
  kBrickIndex = 3,  ///< one std::uint32_t for each brick position, x fastest: see index_entry
  kBricks = 4,      ///< Brick[]
  kBody = 5,        ///< one Body
  kPoints = 6,      ///< float x[n], y[n], z[n]: sample points in the body frame B, in tree order
  kNormals = 7,     ///< float x[n], y[n], z[n]: unit normals that point into the body; only if the image has `paper`
  kNodes = 8,       ///< Node[]: sphere tree in pre-order
  kProvenance = 9,  ///< UTF-8 JSON: findings of the compiler; the core never reads it
  kRefined = 10,    ///< Refined[]; missing if no brick is refined

  // The second direction: feature points of the still body in the moving body's field. Only `contact` reads it. It is
  // missing if the sample points alone suffice.
  kBodyGrid = 11,        ///< one Grid, in the body frame B
  kBodyBrickIndex = 12,  ///< as kBrickIndex
  kBodyBricks = 13,      ///< Brick[]
  kBodyRefined = 14,     ///< Refined[]; missing if no brick is refined
  kFeatures = 15,        ///< one Features
  kFeaturePoints = 16,   ///< float x[n], y[n], z[n]: of the still body, relative to Features::origin, in tree order
  kFeatureNodes = 17,    ///< Node[]: their sphere tree, centres relative to Features::origin

  kFacets = 18,      ///< Facet[]: of the still body, in W; missing if no brick is exact
  kBodyFacets = 19,  ///< Facet[]: of the moving body, in B

  kWorkspace = 20,  ///< one Workspace; missing if the moving body may be everywhere

  // Edge against edge. Only `contact` reads it. It is missing if the scene does not ask for it, or if one of the bodies
  // has no sharp edge.
  kSharpEdges = 21,      ///< SharpEdge[]: of the still body, in W, in tree order
  kSharpEdgeNodes = 22,  ///< Node[]: their sphere tree in pre-order; a node's points are edges, `level` is the depth
  kBodySharpEdges = 23,  ///< SharpEdge[]: of the moving body, in B, in tree order
  kBodySharpEdgeNodes = 24,  ///< Node[]

  kExactBricks = 25,      ///< ExactBrick[]: of the still body; missing if no brick is exact
  kBodyExactBricks = 26,  ///< ExactBrick[]: of the moving body

  kFacetSets = 27,         ///< FacetSet[]: of the still body; missing if no brick is exact
  kBodyFacetSets = 28,     ///< FacetSet[]: of the moving body
  kFacetNumbers = 29,      ///< std::uint32_t[]: numbers of Facets, which FacetSets name; of the still body
  kBodyFacetNumbers = 30,  ///< std::uint32_t[]: of the moving body
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
  std::uint64_t offset;    ///< from the begin of the file, a multiple of kAlignment
  std::uint64_t bytes;     ///< without padding
  std::uint64_t checksum;  ///< over bytes and padding
};
static_assert(sizeof(Section) == 32);

using Solver = godobject::Solver;
inline constexpr std::uint32_t kSolverCount = 3;
inline constexpr const char* kSolverNames[kSolverCount] = {"paper", "corrected", "contact"};

/// Settings of the scene file for the pipeline. SI units.
struct Settings {
  std::uint32_t default_solver;  ///< format::Solver
  std::uint32_t solvers;         ///< bit (1 << Solver) set: the image has the data of that solver
  std::uint32_t friction;        ///< 1: the scene has a friction table
  std::uint32_t
      point_budget;  ///< largest number of near points that a sub-step of `contact` looks up in each direction; 0: all
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
  double period;                  ///< T: time from one cycle to the next [s], 1.25e-4 to 1e-2
};
static_assert(sizeof(Settings) == 120);

inline constexpr double kShortestPeriod = 1.25e-4;  ///< of Settings::period [s]
inline constexpr double kLongestPeriod = 1e-2;      ///< of Settings::period [s]

/// The box that the origin of B, the moving body's centre of mass, does not leave, along the axes of W [m]; low <=
/// high. The image may leave out data that no pose in the box needs. A brick position that no look-up of a cycle meets
/// is stored as far and inside, so a point that came there would count as inside. Points that can touch nothing are
/// left out.
struct Workspace {
  double low[3];
  double high[3];
};
static_assert(sizeof(Workspace) == 48);

/// A body's signed distance field: nodes on a lattice of edge `voxel_size`, stored in bricks of kBrickCells^3 cells.
/// Node (i, j, k) is at origin + voxel_size * (i, j, k). The grid of the still body is in W, that of the moving body in
/// B.
struct Grid {
  double origin[3];
  double voxel_size;      ///< s [m]
  double band;            ///< |distance| < band is stored [m]
  double surface_min[3];  ///< bounding box of the surface (of shells: thickened)
  double surface_max[3];
  double lipschitz;        ///< bound of the field's gradient norm without seams (see Brick) [1]
  double lipschitz_seam;   ///< the bound with seams, rounded as by encode_lipschitz [1]
  double clearance_slope;  ///< >= 1: largest ratio of Brick::lipschitz at neighbouring positions; see index_entry [1]
  double quantum;          ///< unit of Brick::value in unrefined bricks [m]
  double outside_loss;     ///< a point outside the grid, at distance D from the surface's box, has the far clearance
                           ///< (see index_entry) D - outside_loss, less the error of the stored field [m]
  double facet_offset;     ///< see ExactBrick [m]
  std::int32_t bricks[3];  ///< brick positions along x, y, z
  std::uint32_t brick_count;  ///< stored bricks, including those of refinements
};
static_assert(sizeof(Grid) == 152);

inline constexpr int kBrickCells = 4;                ///< cells along an edge of a brick
inline constexpr int kBrickNodes = kBrickCells + 1;  ///< nodes along an edge: neighbours share a face of nodes
inline constexpr int kBrickValues = kBrickNodes * kBrickNodes * kBrickNodes;

/// Distances at the nodes of one brick, x fastest: value[x + 5 (y + 5 z)]. The unit is Grid::quantum, halved once for
/// each level of refinement. A value is the exact distance, rounded; on the border to a coarser brick it is
/// interpolated instead (see Refined). Values are clamped at kKeptBeyondBand voxels beyond the band. Only on a seam
/// does a cell that reaches into the band have a clamped node.
///
/// A brick position is stored if one of its nodes is nearer than the band, or if its nodes differ in sign. So stored
/// bricks contain all points within the band and all changes of sign. In the field of an open mesh the sign may jump
/// without a surface (winding number 1/2 across a hole): there neighbouring nodes differ by more than the lattice edge.
/// Such a place is a *seam*.
///
/// Nodes are rounded to the unit. A node that a brick k levels finer shares is rounded to a multiple of 2^k units. So
/// the finer brick's interpolated values are whole numbers of its own units, and the field is continuous in spite of
/// rounding.
struct alignas(64) Brick {
  std::int16_t value[kBrickValues];
  /// Bound of the gradient's norm in this brick's position and its 26 neighbours, >= 1, coded by encode_lipschitz. From
  /// a position to its neighbour it changes at most by a factor of clearance_slope.
  std::uint16_t lipschitz;
  /// Largest difference in this position between the field (refined or exact) and the trilinear interpolation of the
  /// position's own nodes [quanta]; 0 in octants.
  std::uint16_t deviation;
  std::uint16_t exact;  ///< 0: not exact; else 1 + the number of an ExactBrick
};
static_assert(sizeof(Brick) == 256);

inline constexpr int kLargestValue = 32767;      ///< largest |Brick::value|
inline constexpr double kLargestQuantum = 1e-2;  ///< [voxels]
inline constexpr double kMostRoundedOff = 8.0;   ///< largest rounding of a node [quanta]: half of 2^kMaxRefinement
inline constexpr double kKeptBeyondBand = 4.0;   ///< largest distance of a node beyond the band [voxels]
inline constexpr int kLargestUnsigned = 65535;   ///< largest Brick::deviation and Brick::exact
inline constexpr int kLipschitzShift = 11;       ///< see decode_lipschitz
inline constexpr std::uint32_t kLipschitzOne = std::bit_cast<std::uint32_t>(1.0f);

/// Returns a bound of 1 .. 65528. The code is the upper bits of a float, minus those of 1.
constexpr float decode_lipschitz(std::uint16_t code) noexcept {
  return std::bit_cast<float>((static_cast<std::uint32_t>(code) << kLipschitzShift) + kLipschitzOne);
}
inline constexpr float kLargestLipschitz = decode_lipschitz(0xffff);

/// Returns the code of a bound, 1 <= lipschitz <= kLargestLipschitz, rounded up by at most one part in 4096.
constexpr std::uint16_t encode_lipschitz(float lipschitz) noexcept {
  const std::uint32_t above = std::bit_cast<std::uint32_t>(lipschitz) - kLipschitzOne;
  return static_cast<std::uint16_t>((above + (1u << kLipschitzShift) - 1) >> kLipschitzShift);
}

/// A triangle of the mesh with unit normals out of the body. The signed distance of a point is its distance to the
/// nearest facet. It is positive if the point lies on the side to which the normal of the nearest face, edge or vertex
/// points (Baerentzen and Aanaes, Signed Distance Computation Using the Angle Weighted Pseudonormal, IEEE TVCG 2005).
struct Facet {
  double vertex[3][3];  ///< counter-clockwise from outside [m]
  /// Planes n x + c = 0 with unit normals n: of the face, and through its edges at right angles to it, out of the
  /// triangle. plane[0 .. 2][i] are the components of n, plane[3][i] is c [m]; i = 0 the face, i = 1 + k the edge from
  /// vertex k to vertex k + 1.
  double plane[4][4];
  float edge_normal[3][3];    ///< of the edge from vertex k to vertex k + 1: mean of the two faces' normals
  float vertex_normal[3][3];  ///< mean of the normals of the faces at the vertex, weighted by their angles there
};
static_assert(sizeof(Facet) == 272);

/// Facets that are nearest to any point of a cell, for all cells that have the same ones. Their numbers stand in
/// kFacetNumbers, in two parts, each ascending. The first part is empty unless the free space about the cell is convex.
/// Then the distance of a point is its least height above the faces of the first part, if none is negative.
struct FacetSet {
  std::uint32_t first;        ///< of the numbers
  std::uint16_t count;        ///< of the numbers, 1 .. kMostFacets
  std::uint16_t plane_count;  ///< of the first part
};
static_assert(sizeof(FacetSet) == 8);

inline constexpr int kCellsPerBrick = kBrickCells * kBrickCells * kBrickCells;
inline constexpr int kMostFacets = 64;                 ///< of a FacetSet; chosen: a look-up may compare them all
inline constexpr std::uint16_t kOneWeight = 1u << 14;  ///< ExactBrick::weight that stands for 1

/// A brick in which the field is exact about edges, corners and narrow places, where trilinear interpolation would
/// ripple. There the field is
///
///   phi(x) = (1 - I[w](x)) I[phi](x) + I[w](x) (g(x) + facet_offset),
///
/// with the trilinear interpolation I of the nodes' distances and weights w, and the signed distance g to the facets of
/// the cell's set. A cell has a set if and only if one of its nodes has a weight. Weights are 0 or 1. On the border to
/// a coarser brick they are interpolated, as values are. So the field is continuous.
struct alignas(64) ExactBrick {
  std::uint32_t cell[kCellsPerBrick];  ///< of each cell, x fastest: see cell_facets
  std::uint16_t weight[kBrickValues];  ///< of the nodes, in units of 1 / kOneWeight
  std::uint16_t reserved[3];           ///< 0
};
static_assert(sizeof(ExactBrick) == 512);

/// One word of ExactBrick::cell: 0 without facets.
namespace cell_facets {
inline constexpr std::uint32_t kWhole = 1u << 31;  ///< all nodes of the cell have the weight 1
inline constexpr std::uint32_t kSet = kWhole - 1;  ///< 1 + the number of a FacetSet
}  // namespace cell_facets

/// A convex sharp edge between two vertices of the mesh: for contacts of edges with edges. Where the body is a
/// thickened sheet, its surface lies `radius` from the edge.
struct SharpEdge {
  double end[2][3];        ///< [m]
  float normal[2][3];      ///< unit normals of the two faces, out of the body; 0 on a sheet
  float radius;            ///< 0 on a solid [m]
  std::uint32_t reserved;  ///< 0
};
static_assert(sizeof(SharpEdge) == 80);

/// One entry of the brick index, or of a refinement.
///
/// - bit 31 = 0: stored, and bit 30 = 0
///   - bit 29 = 0: bits 0-27 are the brick's number; bit 28 = 1: the brick is exact
///   - bit 29 = 1: refined; bits 0-27 are the number of a Refined
/// - bit 31 = 1: far, that is not stored; bit 30 is 1 inside and 0 outside; bits 0-29 are the far clearance E, a
/// float's
///   bits shifted right by one
///
/// E holds outside only. For every point x at a distance r <= E from the centre of the brick position, the stored field
/// at x is at least E - r, and min(field, band) is at least L (E - r) / clearance_slope, with Brick::lipschitz L at x.
namespace index_entry {
inline constexpr std::uint32_t kFar = 1u << 31;
inline constexpr std::uint32_t kInside = 1u << 30;    // with kFar
inline constexpr std::uint32_t kLow = kInside - 1;    // with kFar: the clearance
inline constexpr std::uint32_t kRefined = 1u << 29;   // without kFar
inline constexpr std::uint32_t kExact = 1u << 28;     // without kFar and kRefined
inline constexpr std::uint32_t kNumber = kExact - 1;  // without kFar: the number of a brick or a Refined

/// Returns the entry of a far position. `clearance` >= 0 [m]; decoding returns at most one part in 4e6 less.
constexpr std::uint32_t encode_far(bool inside, float clearance) noexcept {
  return kFar | (inside ? kInside : 0u) | (std::bit_cast<std::uint32_t>(clearance) >> 1);
}
/// An entry of Refined::child without a brick of its own; with kExact if the parent's brick is exact.
inline constexpr std::uint32_t kCoarse = kFar;

constexpr float far_clearance(std::uint32_t entry) noexcept { return std::bit_cast<float>((entry & kLow) << 1); }
}  // namespace index_entry

/// The finest refinement halves the voxel edge kMaxRefinement times.
inline constexpr int kMaxRefinement = 4;
static_assert(2.0 * kMostRoundedOff == 1 << kMaxRefinement);

/// A brick in which trilinear interpolation between its own nodes is not exact enough everywhere. Each octant of it (x
/// fastest: ox + 2 oy + 4 oz) is one of two kinds. A fine octant is a brick of kBrickCells^3 cells of half the edge,
/// which may be refined again. A coarse octant is looked up in the brick's own nodes.
///
/// The field is continuous across octants. A node that an octant shares with a coarser brick has the coarser brick's
/// interpolated value. A node that it shares with a position that is not stored has the value that its own position's
/// nodes interpolate.
///
/// Refinements are numbered in the order of a walk: index entries ascending, each refinement before those of its
/// children, children ascending. The walk meets each refinement once.
struct Refined {
  /// Number of the brick with the own nodes. A position always has it, for clearances and the paper's layers. An octant
  /// has it only if one of its children is coarse, else kNoBrick.
  std::uint32_t brick;
  std::uint32_t child[8];  ///< index entries; kCoarse: looked up in `brick`
};
inline constexpr std::uint32_t kNoBrick = ~0u;
static_assert(sizeof(Refined) == 36);

/// Feature points of the still body. They lie where sample points of the moving body alone could miss it: at vertices,
/// sharp edges and spikes.
struct Features {
  double origin[3];  ///< in W [m]
  double radius;     ///< largest distance of a feature point from the origin [m], > 0
  std::uint32_t point_count;
  std::uint32_t node_count;
  std::uint32_t level_count;
  std::uint32_t reserved;  ///< 0
};
static_assert(sizeof(Features) == 48);

/// The moving body and its sample points. B: centre of mass and principal axes. M: the mesh's frame, scaled to metres.
struct Body {
  double rotation_MB[4];     ///< quaternion w, x, y, z
  double translation_MB[3];  ///< centre of mass in M [m]
  double inertia[3];         ///< principal moments of J_B / m [m^2], ascending, >= 0 (not floored)
  double radius;             ///< R_max: largest distance of a sample point from the centre of mass [m], > 0
  double sphere_center[3];   ///< centre of a sphere around all sample points, also those that were left out, in B [m]
  double sphere_radius;      ///< [m], > 0
  double volume;             ///< [m^3]; 0 if the mesh encloses none
  std::uint32_t inertia_from_points;  ///< 1: the mass is spread over the surface points; 0: over the closed volume
  std::uint32_t point_count;
  std::uint32_t node_count;
  std::uint32_t level_count;
};
static_assert(sizeof(Body) == 144);

/// A node of the sphere tree over the sample points, in pre-order. The children of node i begin at i + 1; `skip` is the
/// node after the subtree of i. Node 0 (level 0) contains all points. Points are in tree order: those of a subtree are
/// contiguous.
///
/// The compiler samples level by level. The nodes of level k = 1 .. level_count - 1 are a sampling of the whole surface
/// that contains the previous level, and the first point of a subtree is its node's own sample. The points themselves
/// are level level_count. Afterwards the compiler may leave out points that touch nothing, and levels that save no
/// look-up; then these two properties need not hold.
struct Node {
  float center[3];  ///< centre of the smallest sphere around all points of the subtree, in B; rounding never makes it
                    ///< too small
  float radius;
  std::uint32_t skip;         ///< > own index, <= node_count
  std::uint32_t first_point;  ///< first point of the subtree; the node's own sample
  std::uint32_t point_count;  ///< points of the subtree, >= 1
  std::uint16_t level;        ///< depth: 0 for node 0, parent's + 1 otherwise
  std::uint16_t leaf;         ///< 1: the node has points instead of child nodes
};
static_assert(sizeof(Node) == 32);

/// Returns the checksum of a section or header: a multiplicative hash over 64-bit words. Each step is a bijection of
/// the state, so every change within one word changes the checksum. `bytes` must be a multiple of 8.
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
