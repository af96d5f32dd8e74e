#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <vector>

/// Writes a closed ball of 200 mm with waves of 4 mm, with about the given number of triangles, as binary PLY in
/// metres: the large mesh for timing the compiler. Usage: displaced_sphere OUT.ply TRIANGLES
int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: displaced_sphere OUT.ply TRIANGLES\n", stderr);
    return 64;
  }
  const auto rings = static_cast<std::int32_t>(std::sqrt(std::strtod(argv[2], nullptr) / 4.0));
  const std::int32_t around = 2 * rings;
  std::vector<float> vertices;
  const auto add = [&vertices](double polar, double azimuth) {
    const double waves = std::sin(polar) * std::sin(9.0 * polar) * std::cos(7.0 * azimuth);
    const double radius = 0.1 + 0.004 * waves;
    vertices.push_back(static_cast<float>(radius * std::sin(polar) * std::cos(azimuth)));
    vertices.push_back(static_cast<float>(radius * std::sin(polar) * std::sin(azimuth)));
    vertices.push_back(static_cast<float>(radius * std::cos(polar)));
  };
  add(0.0, 0.0);
  for (std::int32_t i = 1; i < rings; ++i) {
    for (std::int32_t j = 0; j < around; ++j) add(std::numbers::pi * i / rings, 2.0 * std::numbers::pi * j / around);
  }
  add(std::numbers::pi, 0.0);
  const auto last = static_cast<std::int32_t>(vertices.size() / 3 - 1);
  const auto at = [around](std::int32_t ring, std::int32_t j) { return 1 + (ring - 1) * around + j % around; };
  std::vector<std::int32_t> corners;
  for (std::int32_t j = 0; j < around; ++j) {
    corners.insert(corners.end(), {0, at(1, j), at(1, j + 1)});
    for (std::int32_t i = 1; i + 1 < rings; ++i) {
      corners.insert(corners.end(),
                     {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
    corners.insert(corners.end(), {at(rings - 1, j), last, at(rings - 1, j + 1)});
  }
  std::ofstream file(argv[1], std::ios::binary);
  file << "ply\nformat binary_little_endian 1.0\nelement vertex " << vertices.size() / 3
       << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << corners.size() / 3
       << "\nproperty list uchar int vertex_indices\nend_header\n";
  file.write(reinterpret_cast<const char*>(vertices.data()),
             static_cast<std::streamsize>(vertices.size() * sizeof(float)));
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    file.put(3);
    file.write(reinterpret_cast<const char*>(&corners[i]), 3 * sizeof(std::int32_t));
  }
  return file.good() ? 0 : 74;
}
