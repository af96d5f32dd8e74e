#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "toolchain/files/scene_image.h"
#include "toolchain/parallel/parallel.h"
#include "toolchain/scene_compiler/image/scene_image.h"
#include "toolchain/scene_compiler/trimming/try_out.h"

namespace godobject::scene_compiler {

/// Data that the scene does not need.
struct LeftOut {
  std::string what;
  std::uint64_t count = 0;
  std::uint64_t bytes = 0;      ///< of the image
  std::optional<Saving> cycle;  ///< of the scene's own solver, on this machine; if it was timed
};

/// Leaves data of an image out step by step, and keeps the images before and after each step where they are to be
/// timed.
class LeavingOut {
 public:
  using Sections = std::vector<SectionBytes>;

  /// `lay_out` gives what would go into the image now.
  LeavingOut(std::function<Sections()> lay_out, bool timed) : lay_out_(std::move(lay_out)), timed_(timed) {}

  /// `work` leaves things out and returns how many; if none, it has changed nothing.
  void step(const std::string& what, const std::function<std::uint64_t()>& work);

  /// What a cycle takes less by each step, along try_out_motion of the scene with everything; returns what it takes
  /// there in all [ns]. Nothing where no step left anything out, nothing is timed, or no motion was found.
  std::optional<double> time(const Progress& progress);

  const std::vector<LeftOut>& items() const { return items_; }

 private:
  std::function<Sections()> lay_out_;
  bool timed_;
  std::vector<LeftOut> items_;
  std::vector<command::SceneImage> images_;  ///< before all, then after each of the items
};

}  // namespace godobject::scene_compiler
