#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "toolchain/files/scene_image.h"
#include "toolchain/parallel/parallel.h"
#include "toolchain/scene_compiler/image/scene_parts.h"
#include "toolchain/scene_compiler/trimming/try_out.h"

namespace godobject::scene_compiler {

/// Data that one step of the trimming left out of the image.
struct LeftOut {
  std::string what;
  std::uint64_t count = 0;
  std::uint64_t bytes = 0;      ///< by which the image is smaller
  std::optional<Saving> cycle;  ///< time that a cycle of the scene's own solver saves on this machine, if measured
};

/// The steps of the trimming: what each left out and, where the steps are to be timed, the image before and after it.
class TrimmingSteps {
 public:
  explicit TrimmingSteps(bool timed) : timed_(timed) {}

  /// Records one step. `work` leaves data out of `parts` and returns how many items; if none, it changes nothing.
  void step(const std::string& what, const SceneParts& parts, const std::function<std::uint64_t()>& work);

  const std::vector<LeftOut>& items() const { return items_; }

  /// Times a cycle on each image along try_out_motion() of the untrimmed scene. Returns the time of a cycle on the
  /// untrimmed image and the saving of each item. Empty if nothing was left out, the steps are not timed or no motion
  /// was found. Takes some seconds.
  std::optional<CycleTimes> time(const parallel::Progress& progress) const;

 private:
  void store_image(const std::vector<SectionBytes>& sections);

  bool timed_;
  std::vector<LeftOut> items_;
  std::vector<files::SceneImage> images_;  ///< the untrimmed one, then one after each item
};

}  // namespace godobject::scene_compiler
