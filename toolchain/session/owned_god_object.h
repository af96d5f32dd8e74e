#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <utility>

#include "core/pipeline/compiled_session.h"
#include "core/scene/scene_view.h"
#include "godobject/god_object.h"
#include "toolchain/files/aligned_bytes.h"

namespace godobject {

/// A god object with memory of its own on the heap, for tools and tests.
class OwnedGodObject {
 public:
  /// As GodObject::start; `scene` is copied. `remembers`: with the memory by which `contact` skips what cannot be near.
  Status start(const SceneView& scene, Solver solver, bool friction, bool remembers = true) {
    const Scene compiled = Scene::of(scene);
    const std::size_t bytes = remembers ? GodObject::memory_size(compiled) : GodObject::least_memory_size();
    files::AlignedBytes memory(bytes);
    const Status status = god_object_->start(compiled, solver, friction, memory.span());
    if (status == Status::kOk)
      memory_ = std::move(memory);  // after a refusal the last session goes on in the old memory
    return status;
  }

  GodObject& operator*() noexcept { return *god_object_; }
  GodObject* operator->() noexcept { return god_object_.get(); }
  const GodObject* operator->() const noexcept { return god_object_.get(); }

  /// After `start` has succeeded.
  const Parameters& parameters() const noexcept { return god_object_->session()->parameters(); }
  const ProxyState& state() const noexcept { return god_object_->session()->state(); }

 private:
  std::optional<files::AlignedBytes> memory_;
  std::unique_ptr<GodObject> god_object_ = std::make_unique<GodObject>();
};

}  // namespace godobject
