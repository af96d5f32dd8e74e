#include <algorithm>

#include <fmt/format.h>

#include "toolchain/bench/brute_force.h"
#include "toolchain/bench/chapters.h"
#include "toolchain/bench/cycle_times.h"
#include "toolchain/bench/mesh_peers.h"
#include "toolchain/bench/peers.h"
#include "toolchain/bench/workload.h"
#include "toolchain/scene_compiler/mesh/mesh_import.h"
#include "toolchain/scene_compiler/scene_config.h"

namespace godobject::bench {
namespace {

std::string us(double ns) { return digits(1e-3 * ns); }

/// Measures all peers on one workload.
class PeersOnWorkload {
 public:
  PeersOnWorkload(const BenchRequest& request, const Workload& workload, const SceneCache& cache)
      : request_(request),
        workload_(workload),
        scene_file_(request.scenes / (workload.scene + ".toml")),
        image_(cache.image(scene_file_, request.progress)),
        device_(device_poses(workload, request.scenes)),
        friction_(image_.scene.settings.friction != 0),
        recording_(record(image_.scene, {Solver::kContact, friction_}, device_)),
        brute_(image_.scene, kLeastReach * image_.scene.grid.voxel_size) {}

  void run(Table& times, Table& ratios, Chapter& chapter) {
    const PassBudget budget{
        .least_passes = request_.full ? 2u : 1u, .most_passes = 40, .seconds = request_.full ? 3.0 : 0.4};
    show(0.0);
    const CycleTimes plain = time_cycles(image_.scene, {Solver::kContact, false}, device_, budget);
    const CycleTimes own = time_cycles(image_.scene, {Solver::kContact, friction_}, device_, budget);
    add_cycles(times, friction_ ? "godobject, contact, friction, #1-#7" : "godobject, contact, #1-#7", own.whole);
    add_cycles(times, "godobject, contact, #1", own.step1);

    const std::vector<NamedScan> scans = runnable_scans();
    std::vector<PassSamples> scanned;
    for (std::size_t i = 0; i < scans.size(); ++i) {
      show(0.2 + 0.3 * static_cast<double>(i) / static_cast<double>(scans.size()));
      scanned.push_back(time_scan(brute_, scans[i].scan, recording_.H_WS, budget));
      add_cycles(times, fmt::format("brute force, {}", scans[i].name), scanned.back());
    }
    const auto config = scene_compiler::read_scene_config(scene_file_);
    scene_compiler::MeshReport report;
    const MeshPeers meshes = mesh_peers(scene_compiler::import_mesh(config.still.file, config.still.scale, report),
                                        scene_compiler::import_mesh(config.moving.file, config.moving.scale, report));
    for (const MissingPeer& missing : meshes.missing) {
      const std::string remark = fmt::format("not measured: {} is not in this build; {}", missing.name, missing.cure);
      auto& remarks = chapter.remarks;
      if (std::find(remarks.begin(), remarks.end(), remark) == remarks.end()) remarks.push_back(remark);
    }
    const Pose H_BM = image_.scene.H_MB.inverse();
    for (std::size_t i = 0; i < workload_.phases.size(); ++i) {
      const Phase& phase = workload_.phases[i];
      show(0.5 + 0.5 * static_cast<double>(i) / static_cast<double>(workload_.phases.size()));
      std::size_t best = 0;
      for (std::size_t k = 1; k < scans.size(); ++k) {
        if (scanned[k].all(phase.cycles).p50 < scanned[best].all(phase.cycles).p50) best = k;
      }
      const std::vector<std::size_t> cold_cycles = thinned(phase.cycles, request_.full ? 200 : 25);
      const Distribution cold = distribution(time_cold_scan(brute_, scans[best].scan, recording_.H_WS, cold_cycles));
      const double cycle_ns = own.whole.all(phase.cycles).p50;
      const double plain_ns = plain.whole.all(phase.cycles).p50;
      const double step1_ns = own.step1.all(phase.cycles).p50;
      const double brute_ns = scanned[best].all(phase.cycles).p50;
      double collide_ns = 0.0;
      for (const MeshPeer& peer : meshes.peers) {
        const std::vector<std::size_t> cycles = thinned(phase.cycles, request_.full ? 2000 : 20);
        const Distribution at_device = time_query(peer, H_BM, recording_.H_WD, cycles);
        add(times, phase, peer.name + ", device poses", at_device);
        const Distribution at_god_object = time_query(peer, H_BM, recording_.H_WS, cycles);
        add(times, phase, peer.name + ", god-object poses", at_god_object);
        if (collide_ns == 0.0) collide_ns = at_device.p50;
      }
      if (workload_.name == "bunny-teapot" && phase.name == "sliding") {
        const auto at_least = [&](const char* quantity, double wanted, double measured) {
          chapter.targets.push_back({quantity, "1", wanted, measured, true});
        };
        at_least("sliding, p50: best brute force over #1", 4.0, brute_ns / step1_ns);
        if (collide_ns > 0.0) {
          at_least("sliding, p50: FCL collide over the cycle", 100.0, collide_ns / plain_ns);
          at_least("sliding, p50: FCL collide over the cycle with friction", 100.0, collide_ns / cycle_ns);
        }
      }
      ratios.rows.push_back({workload_.name + ", " + phase.name, scans[best].name, us(brute_ns), us(cold.p50),
                             us(step1_ns), digits(brute_ns / step1_ns), us(plain_ns), us(cycle_ns), us(collide_ns),
                             digits(collide_ns / plain_ns), digits(collide_ns / cycle_ns)});
    }
    compare(chapter.remarks);
  }

 private:
  void show(double share) const { request_.progress("peers, " + workload_.name, share); }

  void add(Table& times, const Phase& phase, const std::string& what, const Distribution& d) const {
    times.rows.push_back({workload_.name + ", " + phase.name, what, us(d.p50), us(d.p99), us(d.p999), us(d.max),
                          std::to_string(d.count)});
  }

  void add_cycles(Table& times, const std::string& what, const PassSamples& samples) const {
    for (const Phase& phase : workload_.phases) add(times, phase, what, samples.all(phase.cycles));
  }

  /// Compares the penetrating points at the device poses; at the poses of the god object no point penetrates.
  void compare(std::vector<std::string>& remarks) const {
    std::vector<std::size_t> cycles;
    for (std::size_t i = 0; i < recording_.H_WD.size(); ++i) cycles.push_back(i);
    const Agreement found = agreement(image_.scene, recording_.H_WD, thinned(cycles, 100));
    const double s = image_.scene.grid.voxel_size;
    remarks.push_back(fmt::format(
        "{}: penetrating points at {} device poses: the tree finds {}. {} are found by only one of tree and brute "
        "force, at most {:.3f} voxels from the surface. The distances of the others differ by up to {:.3f} voxels, "
        "because the dense grid has neither refined bricks nor exact edges. The nearest cull misses {}. Grid {} x {} x "
        "{}, {:.1f} MB",
        workload_.name, found.poses, found.points, found.differing, found.worst / s, found.worst_distance / s,
        found.missed_by_cull, brute_.nodes()[0], brute_.nodes()[1], brute_.nodes()[2],
        1e-6 * static_cast<double>(brute_.grid_bytes())));
  }

  const BenchRequest& request_;
  const Workload& workload_;
  std::filesystem::path scene_file_;
  files::SceneImage image_;
  std::vector<Pose> device_;
  bool friction_;
  Recording recording_;
  BruteForce brute_;
};

}  // namespace

Chapter peers_chapter(const BenchRequest& request) {
  const SceneCache cache(request.cache);
  Table times{.name = "peers",
              .title = "Peers at the poses of contact with friction [us]",
              .columns = {"path, phase", "what", "p50", "p99", "p99.9", "max", "samples"},
              .rows = {},
              .note =
                  "Brute force looks up all sample points at the god object's pose before the cycle. FCL tests the "
                  "meshes, with up to 1000 contacts."};
  Table ratios{.name = "ratios",
               .title = "Comparison with peers, medians [us]",
               .columns = {"path, phase", "best brute force", "brute", "brute, cold", "our #1", "brute / #1", "cycle",
                           "with friction", "FCL collide", "FCL / cycle", "FCL / with friction"},
               .rows = {},
               .note =
                   "Our #1 finds near points in both directions and certifies the motion. Brute force only finds the "
                   "sample points nearer than an eighth of a voxel. FCL runs at the device poses."};
  Chapter chapter;
  for (const Workload& workload : workloads()) {
    PeersOnWorkload(request, workload, cache).run(times, ratios, chapter);
  }
  chapter.tables.push_back(std::move(ratios));
  chapter.details.push_back(std::move(times));
  return chapter;
}

}  // namespace godobject::bench
