#include "toolchain/report/study/runner.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <numeric>
#include <thread>

#include "toolchain/files/work_folder.h"

namespace godobject::report {
namespace {

bool is_done(const StudyCase& study_case, const std::filesystem::path& file) {
  try {
    const auto stored = read_result(file, study_case.name);
    return stored && stored->inputs == digest(study_case.inputs) && stored->program == program_digest();
  } catch (const std::exception&) {
    return false;  // it is written again
  }
}

void run_case(const StudyCase& study_case, const std::filesystem::path& file) {
  const files::WorkFolder work(file);
  const auto begin = std::chrono::steady_clock::now();
  StoredResult stored{digest(study_case.inputs), program_digest(), this_machine(), 0.0, study_case.run(work.path())};
  stored.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  write_result(file, study_case.name, stored);
}

/// State that the threads share.
struct Queue {
  std::span<const StudyCase* const> waiting;
  std::size_t next = 0;
  std::size_t finished = 0;
  double seconds_done = 0.0;  ///< expected duration of the completed cases
  std::exception_ptr failure;
  std::mutex mutex;
  std::condition_variable changed;

  bool is_over() const { return finished == next && (next == waiting.size() || failure); }
};

void work_off(Queue& queue, const std::filesystem::path& folder) {
  std::unique_lock lock(queue.mutex);
  while (queue.next < queue.waiting.size() && !queue.failure) {
    const StudyCase& study_case = *queue.waiting[queue.next++];
    lock.unlock();
    std::exception_ptr failure;
    try {
      run_case(study_case, result_path(folder, study_case.name));
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    if (failure && !queue.failure) queue.failure = failure;
    ++queue.finished;
    queue.seconds_done += study_case.seconds;
    queue.changed.notify_one();
  }
}

/// Returns the expected duration of cases [s].
double expected(std::span<const StudyCase* const> cases) {
  return std::accumulate(cases.begin(), cases.end(), 0.0,
                         [](double sum, const StudyCase* study_case) { return sum + study_case->seconds; });
}

/// Returns the progress, with an estimate by the pace so far.
class Pace {
 public:
  explicit Pace(double seconds_in_all) : in_all_(seconds_in_all) {}

  RunProgress progress(const StudyCase& last_begun, double seconds_done, int threads) const {
    const double gone = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    const double rest = in_all_ - seconds_done;
    return {.chapter = last_begun.name.substr(0, last_begun.name.find('.')),
            .done = in_all_ > 0.0 ? seconds_done / in_all_ : 1.0,
            .seconds_left = seconds_done > 0.0 ? gone * rest / seconds_done : rest / threads};
  }

 private:
  double in_all_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace

std::vector<const StudyCase*> in_running_order(std::span<const StudyCase* const> cases) {
  std::vector<const StudyCase*> order(cases.begin(), cases.end());
  std::stable_sort(order.begin(), order.end(), [](const StudyCase* a, const StudyCase* b) {
    return a->takes_times != b->takes_times ? b->takes_times : a->seconds > b->seconds;
  });
  return order;
}

std::vector<const StudyCase*> without_result(std::span<const StudyCase* const> cases,
                                             const std::filesystem::path& folder) {
  std::vector<const StudyCase*> missing = in_running_order(cases);
  std::erase_if(missing, [&](const StudyCase* study_case) {
    return is_done(*study_case, result_path(folder, study_case->name));
  });
  return missing;
}

void run_cases(std::span<const StudyCase* const> cases, const RunRequest& request) {
  const std::vector<const StudyCase*> waiting = without_result(cases, request.folder);
  const auto times = std::find_if(waiting.begin(), waiting.end(), [](const auto* it) { return it->takes_times; });
  const Pace pace(expected(waiting));
  double seconds_done = 0.0;
  const auto run_together = [&](std::span<const StudyCase* const> some, int threads) {
    Queue queue{.waiting = some, .failure = {}, .mutex = {}, .changed = {}};
    std::vector<std::jthread> workers;
    for (int i = 0; i < threads; ++i) workers.emplace_back([&] { work_off(queue, request.folder); });
    std::unique_lock lock(queue.mutex);
    while (!queue.is_over()) {
      if (request.progress && queue.next > 0) {
        const auto progress = pace.progress(*some[queue.next - 1], seconds_done + queue.seconds_done, threads);
        lock.unlock();
        request.progress(progress);
        lock.lock();
      }
      queue.changed.wait_for(lock, std::chrono::milliseconds(200));
    }
    lock.unlock();
    workers.clear();
    if (queue.failure) std::rethrow_exception(queue.failure);
    seconds_done += queue.seconds_done;
  };
  run_together({waiting.begin(), times}, request.threads);
  run_together({times, waiting.end()}, 1);
}

}  // namespace godobject::report
