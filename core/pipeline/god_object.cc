#include "godobject/god_object.h"

#include <algorithm>
#include <cstdint>
#include <new>
#include <type_traits>

#include "core/pipeline/compiled_session.h"
#include "core/pipeline/cycle/work.h"

namespace godobject {
namespace {

constexpr std::size_t kAlignment = 64;
static_assert(GodObject::kNoBudget == WorkMeter::kUnlimited);
static_assert(alignof(CompiledSession) <= kAlignment);
static_assert(std::is_trivially_destructible_v<CompiledSession>);
static_assert(sizeof(CompiledSession) < 1792 * 1024);

}  // namespace

std::size_t GodObject::memory_size(const Scene& scene) noexcept {
  return sizeof(CompiledSession) + sizeof(std::uint32_t) * CompiledSession::search_words(scene.view());
}

std::size_t GodObject::least_memory_size() noexcept { return sizeof(CompiledSession); }

std::size_t GodObject::memory_alignment() noexcept { return kAlignment; }

Status GodObject::start(const Scene& scene, Solver solver, bool friction, std::span<std::byte> memory) noexcept {
  const SceneView& view = scene.view();
  if (!view.holds(solver) || (friction && view.settings.friction == 0)) return Status::kNotInImage;
  if (missing_part(view, solver, friction) != Part::kNone) return Status::kNotInBuild;
  const bool is_aligned = reinterpret_cast<std::uintptr_t>(memory.data()) % kAlignment == 0;
  if (memory.size() < sizeof(CompiledSession) || !is_aligned) return Status::kMemory;
  session_ = new (memory.data()) CompiledSession;
  std::span<std::uint32_t> words;
  if (memory.size() >= memory_size(scene)) {
    words = {reinterpret_cast<std::uint32_t*>(memory.data() + sizeof(CompiledSession)),
             CompiledSession::search_words(view)};
  }
  session_->start(view, solver, friction, words);
  return Status::kOk;
}

void GodObject::reset() noexcept {
  if (session_ != nullptr) session_->reset();
}

Status GodObject::follow(const Pose& H_WM, CycleReport& report) noexcept {
  if (session_ == nullptr) return Status::kNotStarted;
  return session_->follow(H_WM, report);
}

Status GodObject::update(const Input& input, CycleReport& report, StepTimes* times) noexcept {
  if (session_ == nullptr) return Status::kNotStarted;
  return session_->update(input, report, times);
}

void GodObject::set_work_budget(std::uint64_t units) noexcept {
  if (session_ != nullptr) session_->set_work_budget(units);
}

Pose GodObject::mesh_pose() const noexcept { return session_ == nullptr ? Pose{} : session_->mesh_pose(); }

}  // namespace godobject
