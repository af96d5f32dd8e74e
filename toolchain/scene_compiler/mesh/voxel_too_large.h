#pragma once

#include <string>

#include "toolchain/command_line/failure.h"

namespace godobject::scene_compiler {

/// A scene cannot be compiled with the voxel edge of one of its fields, but with a smaller one.
class VoxelTooLarge : public command::Failure {
 public:
  enum class Body { kStill, kMoving };

  /// `voxel_size`: an edge that will do, as far as is known [m].
  VoxelTooLarge(const std::string& message, Body body, double voxel_size)
      : Failure(command::ExitCode::kBadData, message), body_(body), voxel_size_(voxel_size) {}

  Body body() const noexcept { return body_; }
  double voxel_size() const noexcept { return voxel_size_; }

 private:
  Body body_;
  double voxel_size_;
};

}  // namespace godobject::scene_compiler
