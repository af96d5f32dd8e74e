#pragma once

#include <filesystem>
#include <string>

namespace godobject::report {

/// Pairs of generated parts, which compile in seconds. Each function writes meshes and a scene file to `folder` and
/// returns the scene file.
std::filesystem::path write_cavity(double half_edge, double clearance, double voxel_size,
                                   const std::filesystem::path& folder);
std::filesystem::path write_round_peg(const std::filesystem::path& folder);
std::filesystem::path write_rectangular_peg(const std::filesystem::path& folder);
std::filesystem::path write_nut(const std::filesystem::path& folder);

/// A cross with four arms between eight posts.
std::filesystem::path write_turnstile(const std::filesystem::path& folder);

}  // namespace godobject::report
