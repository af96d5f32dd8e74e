#include "toolchain/scene_compiler/trimming/leaving_out.h"

namespace godobject::scene_compiler {
namespace {

std::uint64_t total_bytes(const LeavingOut::Sections& sections) {
  std::uint64_t sum = 0;
  for (const SectionBytes& section : sections) sum += section.bytes.size();
  return sum;
}

}  // namespace

void LeavingOut::step(const std::string& what, const std::function<std::uint64_t()>& work) {
  const auto keep = [this](const Sections& sections) {
    images_.emplace_back(make_image(sections), "what is left out");
  };
  std::uint64_t before = 0;
  {
    const Sections sections = lay_out_();
    before = total_bytes(sections);
    if (timed_ && images_.empty()) keep(sections);
  }
  const std::uint64_t count = work();
  if (count == 0) return;
  const Sections sections = lay_out_();
  items_.push_back({what, count, before - total_bytes(sections), {}});
  if (timed_) keep(sections);
}

std::optional<double> LeavingOut::time(const Progress& progress) {
  if (images_.size() < 2) return {};
  std::vector<const Scene*> scenes;
  for (const command::SceneImage& image : images_) scenes.push_back(&image.scene);
  const std::vector<Pose> motion = try_out_motion(*scenes.front());
  if (motion.empty()) return {};
  const CycleTimes times = time_cycles(scenes, motion, progress);
  for (std::size_t i = 0; i < items_.size(); ++i) items_[i].cycle = times.savings[i];
  return times.ns;
}

}  // namespace godobject::scene_compiler
