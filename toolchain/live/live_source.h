#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/scene_view.h"
#include "firmware/configuration/controller_file.h"
#include "toolchain/live/live_sample.h"
#include "toolchain/live/request.h"
#include "toolchain/live/state_message.h"

namespace godobject::live {

/// A controller that a live page shows. All functions are for one thread, that of the server.
class LiveSource {
 public:
  virtual ~LiveSource() = default;
  LiveSource(const LiveSource&) = delete;
  LiveSource& operator=(const LiveSource&) = delete;

  virtual const SceneView& scene() const = 0;
  /// Returns the arm in the scene; null: none is shown, and wrenches are along the axes of W.
  virtual const firmware::Placement* placement() const = 0;

  /// Appends the cycles since the last call.
  virtual void take(std::vector<LiveSample>& samples) = 0;
  /// Returns the rendering that a page may change; nullopt: a page only looks.
  virtual std::optional<LiveSettings> settings() const = 0;
  virtual double speed() const = 0;         ///< time of the controller over real time [1]
  virtual std::uint64_t lost() const = 0;   ///< cycles that were not taken in time
  virtual std::string failure() const = 0;  ///< why there will be no more cycles; empty: there will

  /// Does what a page asks for. Returns why it does not; empty: done.
  virtual std::string answer(const Request& request) = 0;

 protected:
  LiveSource() = default;
};

}  // namespace godobject::live
