#include "toolchain/scene_compiler/mesh/mesh_import.h"

#include <bit>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "tests/scene_compiler/simple_meshes.h"
#include "tests/scene_compiler/test_meshes.h"
#include "toolchain/command_line/failure.h"
#include "toolchain/scene_compiler/mesh/polygon.h"

namespace godobject::scene_compiler::mesh_import_test {
namespace {

using Eigen::Vector3d;

std::string ascii_ply(const std::string& vertices, int vertex_count, const std::string& faces, int face_count) {
  return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(vertex_count) +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + std::to_string(face_count) +
         "\nproperty list uchar int vertex_indices\nend_header\n" + vertices + faces;
}

/// Imports text as a file. Returns the error message.
std::pair<command::ExitCode, std::string> refusal(const std::string& name, const std::string& text) {
  const ScratchFolder folder;
  MeshReport report;
  try {
    import_mesh(folder.write(name, text), 1.0, report);
  } catch (const command::Failure& failure) {
    return {failure.exit_code(), failure.what()};
  }
  return {command::ExitCode::kOk, ""};
}

constexpr const char* kTetrahedronVertices = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
constexpr const char* kTetrahedronFaces = "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";

TEST(MeshImport, ReadsAndScalesTheCube) {
  MeshReport report;
  const TriangleMesh mesh = import_mesh(mesh_file("cube_100mm"), 2.0, report);
  EXPECT_EQ(mesh.vertices.size(), 8u);
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_EQ(report.euler, 2);
  EXPECT_EQ(report.components, 1u);
  EXPECT_EQ(report.boundary_edges + report.nonmanifold_edges + report.misoriented_edges, 0u);
  EXPECT_NEAR((report.high - report.low).minCoeff(), 0.2, 1e-7);
}

struct KnownMesh {
  const char* name;
  std::uint64_t vertices, triangles, boundary_edges;
  std::int64_t euler;
};

class MeshCounts : public testing::TestWithParam<KnownMesh> {};

TEST_P(MeshCounts, AreThoseOfTheMeshTable) {
  MeshReport report;
  import_mesh(mesh_file(GetParam().name), 1.0, report);
  EXPECT_EQ(report.vertices, GetParam().vertices);
  EXPECT_EQ(report.triangles, GetParam().triangles);
  EXPECT_EQ(report.boundary_edges, GetParam().boundary_edges);
  EXPECT_EQ(report.euler, GetParam().euler);
  EXPECT_EQ(report.misoriented_edges, 0u);
}

INSTANTIATE_TEST_SUITE_P(
    Meshes, MeshCounts,
    testing::Values(KnownMesh{"bunny_npm", 1839, 3674, 0, 2}, KnownMesh{"teapot", 3241, 6320, 160, 1},
                    KnownMesh{"dragon_clean", 24891, 49998, 0, -108}, KnownMesh{"anchor_part", 3793, 7598, 0, -6},
                    KnownMesh{"gear", 2246, 4512, 0, -10}, KnownMesh{"bracket", 538, 1088, 0, -6},
                    KnownMesh{"peg_square", 1538, 3072, 0, 2}, KnownMesh{"sheet_open", 1681, 3200, 160, 1}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(MeshImport, ReadsTheSameTetrahedronFromPlyStlAndObj) {
  const ScratchFolder folder;
  const auto ply = folder.write("t.ply", ascii_ply(kTetrahedronVertices, 4, kTetrahedronFaces, 4));
  const auto obj = folder.write("t.OBJ", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  std::string facets = "solid t\n";
  const auto facet = [&facets](const char* a, const char* b, const char* c) {
    facets += "facet normal 0 0 0\nouter loop\nvertex " + std::string(a) + "\nvertex " + b + "\nvertex " + c +
              "\nendloop\nendfacet\n";
  };
  facet("0 0 0", "0 1 0", "1 0 0");
  facet("0 0 0", "1 0 0", "0 0 1");
  facet("1 0 0", "0 1 0", "0 0 1");
  facet("0 0 0", "0 0 1", "0 1 0");
  const auto stl = folder.write("t.stl", facets + "endsolid t\n");
  for (const auto& file : {ply, obj, stl}) {
    MeshReport report;
    const TriangleMesh mesh = import_mesh(file, 1.0, report);
    EXPECT_EQ(mesh.vertices.size(), 4u) << file;
    EXPECT_EQ(mesh.triangles.size(), 4u) << file;
    EXPECT_EQ(report.euler, 2) << file;
    EXPECT_EQ(report.boundary_edges + report.misoriented_edges, 0u) << file;
  }
}

TEST(MeshImport, ReadsBigEndianDoublesAndSkipsOtherProperties) {
  std::string text =
      "ply\r\nformat binary_big_endian 1.0\r\nelement vertex 3\r\nproperty double x\r\nproperty uchar red\r\n"
      "property double y\r\nproperty double z\r\nelement face 1\r\nproperty list uchar uint "
      "vertex_index\r\nend_header\r\n";
  const auto put_double = [&text](double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    for (int shift = 56; shift >= 0; shift -= 8) text.push_back(static_cast<char>(bits >> shift & 0xff));
  };
  for (const Vector3d& v : {Vector3d(0.1, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0)}) {
    put_double(v.x());
    text += '\n';
    put_double(v.y());
    put_double(v.z());
  }
  text += '\3';
  for (const char index : {'\0', '\1', '\2'}) text += std::string(3, '\0') + index;
  const ScratchFolder folder;
  MeshReport report;
  const TriangleMesh mesh = import_mesh(folder.write("b.ply", text), 1.0, report);
  ASSERT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.vertices[0].x(), 0.1);
}

TEST(MeshImport, CutsPolygonsConvexOrNot) {
  // an L of area 3: a fan from corner 0 would leave it
  const std::vector<Vector3d> corners = {{1, 1, 0}, {1, 2, 0}, {0, 2, 0}, {0, 0, 0}, {2, 0, 0}, {2, 1, 0}};
  const std::array<std::uint32_t, 6> order = {0, 1, 2, 3, 4, 5};
  std::vector<std::array<std::uint32_t, 3>> triangles;
  triangulate(corners, order, triangles);
  ASSERT_EQ(triangles.size(), 4u);
  double area = 0.0;
  for (const auto& t : triangles) {
    const double signed_area = 0.5 * (corners[t[1]] - corners[t[0]]).cross(corners[t[2]] - corners[t[0]]).z();
    EXPECT_GT(signed_area, 0.0);
    area += signed_area;
  }
  EXPECT_NEAR(area, 3.0, 1e-12);
}

TEST(MeshImport, CountsAndDropsDefects) {
  // a tetrahedron; vertex 4 beside vertex 1, vertex 5 loose; faces: one via the twin, one repeated, one degenerate
  const std::string vertices = std::string(kTetrahedronVertices) + "1.0000001 0 0\n5 5 5\n";
  const std::string faces = "3 0 2 4\n3 0 1 3\n3 1 2 3\n3 0 3 2\n3 2 3 1\n3 1 4 2\n";
  const ScratchFolder folder;
  MeshReport report;
  const TriangleMesh mesh = import_mesh(folder.write("d.ply", ascii_ply(vertices, 6, faces, 6)), 1.0, report);
  EXPECT_EQ(mesh.triangles.size(), 4u);
  EXPECT_EQ(mesh.vertices.size(), 4u);
  EXPECT_EQ(report.welded_vertices, 1u);
  EXPECT_EQ(report.degenerate_triangles, 1u);
  EXPECT_EQ(report.duplicate_triangles, 1u);
  EXPECT_EQ(report.unreferenced_vertices, 1u);
  EXPECT_EQ(report.boundary_edges, 0u);
}

TEST(MeshImport, KeepsAFoldInPairs) {
  TriangleMesh mesh = box(Vector3d::Zero(), Vector3d::Ones());
  mesh.vertices.emplace_back(2.0, 0.0, 0.0);
  mesh.triangles.push_back({1, 8, 3});  // a fin of both senses
  mesh.triangles.push_back({8, 1, 3});
  MeshReport report;
  const TriangleMesh cleaned = clean_mesh(mesh, "fin", report);
  EXPECT_EQ(cleaned.triangles.size(), 14u);
  EXPECT_EQ(report.folded_triangles, 2u);
  EXPECT_EQ(report.duplicate_triangles, 0u);
}

TEST(MeshImport, TurnsATriangleThatDisagreesWithItsNeighbours) {
  TriangleMesh mesh = box(Vector3d::Zero(), Vector3d::Ones());
  const TriangleMesh original = mesh;
  std::swap(mesh.triangles[0][1], mesh.triangles[0][2]);
  MeshReport report;
  EXPECT_EQ(clean_mesh(mesh, "box", report).triangles, original.triangles);
  EXPECT_EQ(report.turned_triangles, 1u);
  EXPECT_EQ(report.misoriented_edges, 0u);
}

/// Six times the signed volume that the triangles enclose [m^3].
double six_volumes(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles) sum += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]]));
  return sum;
}

/// Any quarter of the faces turned: what comes out is the mesh before, whichever way that was, in each of its parts.
TEST(MeshImport, TurnsAnyQuarterOfTheFacesBack) {
  std::mt19937 random(8);
  const TriangleMesh block = joined(box(Vector3d::Zero(), Vector3d::Ones()), test::ball_mesh(0.3, 12));
  TriangleMesh cavity = turned_inside_out(test::ball_mesh(0.2, 9));
  for (Vector3d& vertex : cavity.vertices) vertex += Vector3d(0.5, 0.5, 0.5);
  for (const TriangleMesh& original :
       {test::ball_mesh(1.0, 20), turned_inside_out(test::ball_mesh(1.0, 20)), joined(block, cavity)}) {
    for (int round = 0; round < 5; ++round) {
      TriangleMesh mesh = original;
      std::uint64_t turned = 0;
      for (auto& t : mesh.triangles) {
        if (random() % 4 != 0) continue;
        std::swap(t[1], t[2]);
        ++turned;
      }
      MeshReport report;
      const TriangleMesh cleaned = clean_mesh(mesh, "turned", report);
      ASSERT_EQ(cleaned.triangles.size(), original.triangles.size());
      EXPECT_EQ(report.turned_triangles, turned);
      EXPECT_EQ(report.misoriented_edges, 0u);
      EXPECT_NEAR(six_volumes(cleaned), six_volumes(original), 1e-12);
    }
  }
}

TEST(MeshImport, LeavesASurfaceWithOneSideAsItIs) {
  constexpr std::uint32_t kSegments = 21;
  TriangleMesh strip;
  for (std::uint32_t i = 0; i < kSegments; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / kSegments;
    const Vector3d along(std::cos(turn), std::sin(turn), 0.0);
    const Vector3d across = std::cos(0.5 * turn) * along + std::sin(0.5 * turn) * Vector3d::UnitZ();
    strip.vertices.push_back(along - 0.2 * across);
    strip.vertices.push_back(along + 0.2 * across);
  }
  for (std::uint32_t i = 0; i < kSegments; ++i) {
    const bool last = i + 1 == kSegments;  // where the strip meets itself half a turn on
    const std::uint32_t low = last ? 1 : 2 * i + 2;
    const std::uint32_t high = last ? 0 : 2 * i + 3;
    strip.triangles.push_back({2 * i, low, high});
    strip.triangles.push_back({2 * i, high, 2 * i + 1});
  }
  MeshReport report;
  EXPECT_EQ(clean_mesh(strip, "strip", report).triangles, strip.triangles);
  EXPECT_EQ(report.turned_triangles, 0u);
  EXPECT_EQ(report.misoriented_edges, 1u);
}

TEST(MeshImport, RefusesWhatIsNoMeshWithFileAndCure) {
  const auto expect = [](const std::pair<command::ExitCode, std::string>& refused, command::ExitCode code,
                         const char* word) {
    EXPECT_EQ(refused.first, code) << refused.second;
    EXPECT_NE(refused.second.find(word), std::string::npos) << refused.second;
    EXPECT_NE(refused.second.find(';'), std::string::npos) << "no cure: " << refused.second;
  };
  expect(refusal("empty.ply", ""), command::ExitCode::kBadData, "empty");
  expect(refusal("no_faces.ply", ascii_ply(kTetrahedronVertices, 4, "", 0)), command::ExitCode::kBadData,
         "no triangles");
  expect(refusal("nan.ply", ascii_ply("nan 0 0\n1 0 0\n0 1 0\n", 3, "3 0 1 2\n", 1)), command::ExitCode::kBadData,
         "finite");
  expect(refusal("inf.ply", ascii_ply("1e999 0 0\n1 0 0\n0 1 0\n", 3, "3 0 1 2\n", 1)), command::ExitCode::kBadData,
         "finite");
  expect(refusal("index.ply", ascii_ply(kTetrahedronVertices, 4, "3 0 1 9\n", 1)), command::ExitCode::kBadData,
         "refers to vertex 9");
  expect(refusal("short.ply", ascii_ply(kTetrahedronVertices, 4, "3 0 1 2\n", 9)), command::ExitCode::kBadData,
         "ends before");
  expect(refusal("word.ply", ascii_ply("a b c\n", 1, "3 0 1 2\n", 1)), command::ExitCode::kBadData, "number");
  expect(refusal("header.ply", "ply\nformat ascii 1.0\nelement vertex 3\n"), command::ExitCode::kBadData, "header");
  expect(refusal("huge.ply", ascii_ply("1e9 0 0\n1 0 0\n0 1 0\n", 3, "3 0 1 2\n", 1)), command::ExitCode::kBadData,
         "beyond the limit");
  expect(refusal("point.ply", ascii_ply("1 0 0\n1 0 0\n1 0 0\n", 3, "3 0 1 2\n", 1)), command::ExitCode::kBadData,
         "one point");
  expect(refusal("line.ply", ascii_ply("0 0 0\n1 0 0\n2 0 0\n", 3, "3 0 1 2\n", 1)), command::ExitCode::kBadData,
         "degenerate");
  expect(refusal("mesh.off", "OFF\n"), command::ExitCode::kBadData, "PLY, STL or OBJ");
  expect(refusal("noise.stl", "this is no mesh"), command::ExitCode::kBadData, "noise.stl");
  expect(refusal("noise.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n"), command::ExitCode::kBadData, "noise.obj");
  for (const char* name : {"sparse.ply", "sparse.stl", "sparse.obj"}) {
    const ScratchFolder folder;
    std::filesystem::resize_file(folder.write(name, "ply\n"), std::uintmax_t{1} << 36);
    MeshReport report;
    try {
      import_mesh(folder.file(name), 1.0, report);
      FAIL() << "read 64 GiB";
    } catch (const command::Failure& failure) {
      expect({failure.exit_code(), failure.what()}, command::ExitCode::kBadData, "is larger than 4 GiB");
    }
  }
  MeshReport report;
  try {
    import_mesh("/nowhere/a.ply", 1.0, report);
    FAIL() << "took a file that is not there";
  } catch (const command::Failure& failure) {
    EXPECT_EQ(failure.exit_code(), command::ExitCode::kNoInput);
  }
}

}  // namespace
}  // namespace godobject::scene_compiler::mesh_import_test
