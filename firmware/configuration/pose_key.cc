#include "firmware/configuration/pose_key.h"

#include <cmath>
#include <vector>

namespace godobject::firmware {
namespace {

Quaternion unit(const files::TomlTable& table, std::string_view key, const double* n) {
  const Quaternion rotation(n[0], n[1], n[2], n[3]);
  if (std::fabs(rotation.norm() - 1.0) > 1e-3) {
    table.complain(key, "has a quaternion that is not of unit length; write it as qw, qx, qy, qz");
  }
  return rotation.normalized();
}

}  // namespace

Pose read_pose(const files::TomlTable& table, std::string_view key) {
  const std::vector<double> n = table.numbers(key, 7, {-1e3, 1e3});
  return {unit(table, key, n.data() + 3), Vector3(n[0], n[1], n[2])};
}

Quaternion read_rotation(const files::TomlTable& table, std::string_view key) {
  return unit(table, key, table.numbers(key, 4, {-1.1, 1.1}).data());
}

}  // namespace godobject::firmware
