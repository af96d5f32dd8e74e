#include "toolchain/bench/micro.h"

#include <memory>

#include <benchmark/benchmark.h>

#include "core/pipeline/contact/qp/least_constraint.h"
#include "core/pipeline/corrected/projection.h"
#include "core/pipeline/cycle/parameters.h"
#include "core/pipeline/paper/constrained_motion.h"
#include "core/pipeline/paper/correction.h"
#include "core/pipeline/paper/proxy_filter.h"
#include "core/pipeline/penalty/penalty_contacts.h"
#include "toolchain/bench/brute_force.h"
#include "toolchain/bench/cycle_times.h"
#include "toolchain/bench/peers.h"
#include "toolchain/bench/workload.h"
#include "toolchain/command_line/failure.h"

namespace godobject::bench {
namespace {

/// Collects the results of Google Benchmark in a table, for each benchmark its fastest repetition.
class TableReporter : public benchmark::BenchmarkReporter {
 public:
  explicit TableReporter(Table& table) : table_(table) {}

  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    const Run* least = nullptr;
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration || run.iterations == 0) continue;
      if (least == nullptr || run.GetAdjustedCPUTime() < least->GetAdjustedCPUTime()) least = &run;
    }
    if (least == nullptr) return;
    table_.rows.push_back(
        {least->run_name.str(), digits(least->GetAdjustedCPUTime()), std::to_string(least->iterations)});
  }

 private:
  Table& table_;
};

/// The scene in which the bunny slides on the teapot, and the recorded poses.
struct Sliding {
  Sliding(const BenchRequest& request, const Workload& workload)
      : image(SceneCache(request.cache).image(request.scenes / (workload.scene + ".toml"), request.progress)),
        device(device_poses(workload, request.scenes)),
        recording(record(image.scene, {Solver::kContact, true}, device)),
        parameters(Parameters::make(image.scene)),
        brute(image.scene, kLeastReach * image.scene.grid.voxel_size) {
    for (const Phase& phase : workload.phases) {
      if (phase.name == "sliding") cycles = phase.cycles;
    }
  }

  /// Returns the next pose of the phase; after the last one follows the first.
  const Pose& H_WS() { return recording.H_WS[cycles[next++ % cycles.size()]]; }

  files::SceneImage image;
  std::vector<Pose> device;
  Recording recording;
  Parameters parameters;
  BruteForce brute;
  std::vector<std::size_t> cycles;
  std::size_t next = 0;
};

/// Returns positions of sample points along the path with a stored distance between `low` and `high` [m]. Successive
/// positions are far apart in memory.
std::vector<Vector3> places(const Sliding& sliding, double low, double high) {
  constexpr std::size_t kMost = 4096;
  const SceneView& scene = sliding.image.scene;
  std::vector<Vector3> found;
  for (std::size_t i = 0; i < 200 * scene.pointshell.size && found.size() < kMost; ++i) {
    const Pose& H_WS = sliding.recording.H_WS[sliding.cycles[i * 7 % sliding.cycles.size()]];
    const Vector3 p_W = H_WS * scene.pointshell.point(i * 4099 % scene.pointshell.size);
    const double distance = scene.voxelmap.sample(p_W).distance;
    if (distance >= low && distance < high) found.push_back(p_W);
  }
  return found;
}

void add_look_ups(Sliding& sliding) {
  const Voxelmap& map = sliding.image.scene.voxelmap;
  const double s = map.voxel_size();
  struct Kind {
    const char* name;
    double low, high;
  };
  for (const Kind& kind :
       {Kind{"look-up, nearer than half a voxel", 0.0, 0.5 * s}, Kind{"look-up, in the band", 0.5 * s, map.band()},
        Kind{"look-up, beyond the band", map.band(), 2.0 * map.band()}}) {
    const std::vector<Vector3> at = places(sliding, kind.low, kind.high);
    if (at.empty()) continue;
    benchmark::RegisterBenchmark(kind.name, [&map, at](benchmark::State& state) {
      std::size_t i = 0;
      for (auto _ : state) {
        benchmark::DoNotOptimize(map.sample(at[i]));
        i = i + 1 == at.size() ? 0 : i + 1;
      }
    });
  }
  const std::vector<Vector3> at = places(sliding, -1.0, 1.0);
  benchmark::RegisterBenchmark("bound of a sphere of two voxels", [&map, at, s](benchmark::State& state) {
    std::size_t i = 0;
    for (auto _ : state) {
      benchmark::DoNotOptimize(map.lower_bound(at[i], 2.0 * s));
      i = i + 1 == at.size() ? 0 : i + 1;
    }
  });
}

void add_searches(Sliding& sliding) {
  const SceneView& scene = sliding.image.scene;
  benchmark::RegisterBenchmark("#1 of corrected: tree, distances", [&](benchmark::State& state) {
    for (auto _ : state) {
      benchmark::DoNotOptimize(penalty_contacts<DistancePenetration>(scene.voxelmap, scene.pointshell, sliding.H_WS(),
                                                                     sliding.parameters.safety_distance, 0.0));
    }
  });
  if (scene.pointshell.normal_x != nullptr) {
    benchmark::RegisterBenchmark("#1 of paper: tree, layers", [&](benchmark::State& state) {
      for (auto _ : state) {
        benchmark::DoNotOptimize(penalty_contacts<LayerPenetration>(scene.voxelmap, scene.pointshell, sliding.H_WS(),
                                                                    sliding.parameters.safety_distance, 0.0));
      }
    });
  }
  benchmark::RegisterBenchmark("smallest distance of all points", [&](benchmark::State& state) {
    for (auto _ : state) {
      benchmark::DoNotOptimize(smallest_distance(scene.voxelmap, scene.pointshell, sliding.H_WS()));
    }
  });
  for (const NamedScan& scan : runnable_scans()) {
    benchmark::RegisterBenchmark((std::string("brute force, ") + scan.name).c_str(),
                                 [&sliding, scan](benchmark::State& state) {
                                   for (auto _ : state) {
                                     benchmark::DoNotOptimize(sliding.brute.scan(scan.scan, sliding.H_WS()).count);
                                   }
                                 });
  }
}

/// The solver's input in a cycle of the phase: rows of the points that brute force finds, and the wanted motion.
struct RecordedRows {
  ContactRows rows;
  Motion wanted;
};

std::vector<std::unique_ptr<RecordedRows>> recorded_rows(Sliding& sliding) {
  constexpr std::size_t kCycles = 64;
  const SceneView& scene = sliding.image.scene;
  std::vector<std::unique_ptr<RecordedRows>> recorded;
  for (const std::size_t cycle : thinned(sliding.cycles, kCycles)) {
    const Pose& H_WS = sliding.recording.H_WS[cycle];
    auto one = std::make_unique<RecordedRows>();
    one->wanted = unconstrained_motion(H_WS, sliding.recording.H_WD[cycle]);
    const NearList& near = sliding.brute.scan(&scan_cull_float, H_WS);
    for (std::size_t k = 0; k < near.count && !one->rows.full(); ++k) {
      const Vector3 gradient_W(static_cast<double>(near.gradient_x[k]), static_cast<double>(near.gradient_y[k]),
                               static_cast<double>(near.gradient_z[k]));
      const Vector3 normal_S = H_WS.rotation.conjugate()._transformVector(gradient_W).normalized();
      one->rows.push(near.index[k], normal_S, scene.pointshell.point(near.index[k]),
                     sliding.parameters.margin - static_cast<double>(near.distance[k]));
    }
    recorded.push_back(std::move(one));
  }
  return recorded;
}

void add_solvers(Sliding& sliding) {
  const auto recorded = std::make_shared<std::vector<std::unique_ptr<RecordedRows>>>(recorded_rows(sliding));
  const Parameters& q = sliding.parameters;
  CouplingMetric metric;
  metric.gyration = std::sqrt(q.coupling_rotation / q.coupling_translation);
  for (const bool with_friction : {false, true}) {
    benchmark::RegisterBenchmark(
        with_friction ? "#2-#4 of contact, friction, from cold" : "#2-#4 of contact, from cold",
        [recorded, metric, with_friction, &q](benchmark::State& state) {
          const ContactFriction friction{q.friction.static_ratio, q.friction.kinetic_ratio, 0.0};
          std::size_t i = 0;
          for (auto _ : state) {
            RecordedRows& one = *(*recorded)[i];
            ConstrainedStep step;
            WorkMeter work;
            least_constraint(one.rows, one.wanted, metric, with_friction ? &friction : nullptr, Motion{}, work, step);
            benchmark::DoNotOptimize(step);
            i = i + 1 == recorded->size() ? 0 : i + 1;
          }
        });
  }
  const std::size_t cycle = sliding.cycles[sliding.cycles.size() / 2];
  const Pose H_WS = sliding.recording.H_WS[cycle];
  const Pose H_WD = sliding.recording.H_WD[cycle];
  const PenaltyContacts contacts = penalty_contacts<DistancePenetration>(
      sliding.image.scene.voxelmap, sliding.image.scene.pointshell, H_WS, q.safety_distance, 0.0);
  benchmark::RegisterBenchmark("#2 of paper", [contacts, &q](benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(correction(contacts, q.safety_distance, q.mass));
  });
  benchmark::RegisterBenchmark("#2-#4 of corrected, friction", [contacts, H_WS, H_WD, &q](benchmark::State& state) {
    const ProjectionFriction friction{q.friction.static_ratio, q.friction.kinetic_ratio, 0.0};
    const Motion free = unconstrained_motion(H_WS, H_WD);
    for (auto _ : state) {
      benchmark::DoNotOptimize(project(free, contacts, q.safety_distance, q.correction_gain, q.mass, &friction, {}));
    }
  });
  benchmark::RegisterBenchmark("#5", [H_WS, H_WD, &q](benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(filter_proxy(H_WS, H_WD, H_WD, q.period));
  });
}

}  // namespace

void start_google_benchmark(bool full, const std::vector<std::string>& arguments) {
  std::vector<std::string> words = {"godobject-bench", "--benchmark_repetitions=5",
                                    full ? "--benchmark_min_time=0.2" : "--benchmark_min_time=0.03"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  int argc = static_cast<int>(argv.size());
  benchmark::Initialize(&argc, argv.data());
  if (argc > 1) {
    throw command::Failure(command::ExitCode::kUsage,
                           std::string(argv[1]) + ": Google Benchmark has no such option; see its documentation");
  }
}

Chapter micro_chapter(const BenchRequest& request) {
  Sliding sliding(request, workloads().front());
  add_look_ups(sliding);
  add_searches(sliding);
  add_solvers(sliding);
  request.progress("parts", 0.0);
  Chapter chapter;
  Table table{.name = "parts",
              .title = "Parts, mean over the poses of the sliding bunny, warm, fastest of five repetitions [ns]",
              .columns = {"part", "time", "iterations"},
              .rows = {},
              .note = "By Google Benchmark. The solver starts without the contacts of the last cycle."};
  TableReporter reporter(table);
  benchmark::RunSpecifiedBenchmarks(&reporter);
  benchmark::Shutdown();
  chapter.tables.push_back(std::move(table));
  return chapter;
}

}  // namespace godobject::bench
