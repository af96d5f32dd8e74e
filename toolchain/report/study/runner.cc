#include "toolchain/report/study/runner.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "toolchain/command/work_folder.h"

namespace godobject::report {
namespace {

bool is_done(const StudyCase& study_case, const std::filesystem::path& file) {
  try {
    const auto stored = read_result(file, study_case.name);
    return stored && stored->inputs == digest(study_case.inputs) && stored->program == program_digest();
  } catch (const std::exception&) {
    return false;  // it is written anew
  }
}

void run_case(const StudyCase& study_case, const std::filesystem::path& file) {
  const command::WorkFolder work(file);
  const auto begin = std::chrono::steady_clock::now();
  StoredResult stored{digest(study_case.inputs), program_digest(), this_machine(), 0.0, study_case.run(work.path())};
  stored.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  write_result(file, study_case.name, stored);
}

/// What the threads share.
struct Queue {
  std::vector<const StudyCase*> waiting;
  std::size_t next = 0;
  std::size_t finished = 0;
  std::exception_ptr failure;
  std::mutex mutex;
  std::condition_variable changed;
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
    queue.changed.notify_one();
  }
}

}  // namespace

void run_cases(std::span<const StudyCase* const> cases, const RunRequest& request) {
  Queue queue;
  for (const StudyCase* study_case : cases) {
    if (!is_done(*study_case, result_path(request.folder, study_case->name))) queue.waiting.push_back(study_case);
  }
  std::vector<std::jthread> threads;
  for (int i = 0; i < request.threads; ++i) threads.emplace_back([&] { work_off(queue, request.folder); });
  std::unique_lock lock(queue.mutex);
  while (queue.finished < queue.next || (queue.next < queue.waiting.size() && !queue.failure)) {
    if (request.progress && queue.next > 0) {
      const std::string& name = queue.waiting[queue.next - 1]->name;
      const std::size_t finished = queue.finished;
      lock.unlock();
      request.progress(name.substr(0, name.find('.')),
                       static_cast<double>(finished) / static_cast<double>(queue.waiting.size()));
      lock.lock();
    }
    queue.changed.wait_for(lock, std::chrono::milliseconds(200));
  }
  lock.unlock();
  threads.clear();
  if (queue.failure) std::rethrow_exception(queue.failure);
}

}  // namespace godobject::report
