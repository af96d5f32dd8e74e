#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "firmware/configuration/controller_file.h"
#include "firmware/configuration/scene_file.h"
#include "firmware/controller/companion.h"
#include "firmware/controller/session.h"
#include "firmware/loop/run_requests.h"
#include "toolchain/live/hand_motion.h"
#include "toolchain/live/live_source.h"

namespace godobject::live {

/// A controller on a simulated arm, on a thread of its own: virtual time, slowed to real time once it renders. The hand
/// follows the requests of a page, or simulation.path again and again. It never reaches a real bus.
class SimulatedRun final : public LiveSource, private firmware::Companion {
 public:
  /// Connects and checks as godobject-controller does, and throws what it throws. `steered`: a page moves the hand.
  SimulatedRun(const firmware::ControllerConfig& config, bool steered);
  ~SimulatedRun() override;

  const SceneView& scene() const override { return scene_; }
  const firmware::Placement* placement() const override { return &placement_; }
  void take(std::vector<LiveSample>& samples) override;
  std::optional<LiveSettings> settings() const override;
  double speed() const override { return speed_.load(std::memory_order_relaxed); }
  std::uint64_t lost() const override { return lost_.load(std::memory_order_relaxed); }
  std::string failure() const override;
  std::string answer(const Request& request) override;

 private:
  void run(const std::stop_token& stop);
  void after_cycle(const firmware::CycleTimes& times, const firmware::CycleRecord& record, std::int64_t computed_ns,
                   firmware::SimulatedArm& arm, firmware::Session& session) override;
  void keep(LiveSample sample);
  void take_back(const firmware::Rendering& rendering);
  void move_hand(const firmware::CycleRecord& record, firmware::SimulatedArm& arm);
  void keep_to_real_time(std::int64_t now_ns, bool starts);
  void restart();
  std::string change(const ChangeRequest& request);
  /// Largest stiffness that the gain check allows [N/m]. Cost: some 50 ms, in which no state is sent.
  double boundary_of(const firmware::Rendering& rendering) const;

  const firmware::ControllerConfig config_;
  const bool steered_;
  const firmware::SceneFile image_;
  const SceneView scene_;  ///< with the gains of the controller file
  std::unique_ptr<firmware::Session> session_;
  const firmware::Placement placement_;
  const double delay_;
  firmware::RunRequests requests_;
  std::atomic<bool> begin_again_{false};  ///< after the end of the present run

  mutable std::mutex mutex_;  ///< guards what follows
  std::vector<LiveSample> samples_;
  std::optional<Pose> goal_;                   ///< of the hand, in the scene
  std::optional<firmware::Rendering> wanted_;  ///< to be taken by the next cycle
  LiveSettings settings_;
  std::string failure_;

  std::atomic<std::uint64_t> lost_{0};
  std::atomic<double> speed_{1.0};

  // of the thread of the run
  std::optional<HandMotion> hand_;
  std::int64_t wall_ahead_ns_ = 0;               ///< real time less the controller's
  std::int64_t wall_mark_ns_ = 0, mark_ns_ = 0;  ///< from which on the speed is measured

  std::jthread thread_;
};

}  // namespace godobject::live
