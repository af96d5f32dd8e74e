#include "toolchain/scene_compiler/trimming/leaving_out.h"

namespace godobject::scene_compiler {
namespace {

std::uint64_t total_bytes(const std::vector<SectionBytes>& sections) {
  std::uint64_t sum = 0;
  for (const SectionBytes& section : sections) sum += section.bytes.size();
  return sum;
}

}  // namespace

void TrimmingSteps::store_image(const std::vector<SectionBytes>& sections) {
  images_.emplace_back(make_image(sections), "image under trimming");
}

void TrimmingSteps::step(const std::string& what, const SceneParts& parts, const std::function<std::uint64_t()>& work) {
  std::uint64_t before = 0;
  {
    const std::vector<SectionBytes> sections = lay_out(parts);
    before = total_bytes(sections);
    if (timed_ && images_.empty()) store_image(sections);
  }
  const std::uint64_t count = work();
  if (count == 0) return;
  const std::vector<SectionBytes> sections = lay_out(parts);
  items_.push_back({what, count, before - total_bytes(sections), {}});
  if (timed_) store_image(sections);
}

std::optional<CycleTimes> TrimmingSteps::time(const parallel::Progress& progress) const {
  if (images_.size() < 2) return {};
  std::vector<const SceneView*> scenes;
  for (const files::SceneImage& image : images_) scenes.push_back(&image.scene);
  const std::vector<Pose> motion = try_out_motion(*scenes.front());
  if (motion.empty()) return {};
  return time_cycles(scenes, motion, progress);
}

}  // namespace godobject::scene_compiler
