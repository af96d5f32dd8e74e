#pragma once

#include <fcntl.h>
#include <linux/capability.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <vector>

namespace godobject::firmware {

struct ProcessSettings {
  rlim_t largest_file = RLIM_INFINITY;
  std::string library{};               ///< for LD_PRELOAD; empty: none
  std::filesystem::path interfaces{};  ///< folder of tests/support/fake_can.cc
  bool real_time_rights = true;        ///< false: neither limits nor capabilities permit real-time work
  const char* words = "log.txt";       ///< file for stdout and stderr
  bool may_pause = true;               ///< false: the kernel kills it with SIGSYS when it sleeps for a time
};

/// A program in a folder; killed with this.
class Process {
 public:
  static constexpr int kNoFilters = 99;  ///< exit code: this kernel cannot forbid system calls

  Process(const std::filesystem::path& folder, const std::string& program, const std::vector<std::string>& arguments,
          const ProcessSettings& settings = {}) {
    std::vector<std::string> words{program};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    pid_ = ::fork();
    if (pid_ != 0) return;
    const int log = ::open((folder / settings.words).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    const rlimit limit{settings.largest_file, settings.largest_file};
    const bool ready = log >= 0 && ::dup2(log, 1) == 1 && ::dup2(log, 2) == 2 && ::chdir(folder.c_str()) == 0 &&
                       ::setrlimit(RLIMIT_FSIZE, &limit) == 0;
    ::setenv("STATE_DIRECTORY", (folder / "state").c_str(), 1);  // not the state of the user who runs the test
    if (!settings.library.empty()) {
      ::setenv("LD_PRELOAD", settings.library.c_str(), 1);
      ::setenv("GODOBJECT_FAKE_CAN", settings.interfaces.c_str(), 1);
      ::setenv("ASAN_OPTIONS", "verify_asan_link_order=0", 1);
    }
    if (!settings.real_time_rights) give_up_rights();
    if (!settings.may_pause && !forbid_pauses()) ::_exit(kNoFilters);
    if (ready) ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  ~Process() {
    if (pid_ <= 0) return;
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  pid_t id() const { return pid_; }
  void send(int signal) const { ::kill(pid_, signal); }

  /// Exit code, or minus the signal that killed it.
  int wait() {
    int status = 0;
    ::waitpid(pid_, &status, 0);
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

  /// True if it has ended, or was killed; `wait` is still to come.
  bool has_ended() const {
    siginfo_t child{};
    return ::waitid(P_PID, static_cast<id_t>(pid_), &child, WEXITED | WNOHANG | WNOWAIT) == 0 && child.si_pid != 0;
  }

  /// Its open sockets.
  int sockets() const {
    int count = 0;
    for (const auto& file : std::filesystem::directory_iterator("/proc/" + std::to_string(pid_) + "/fd")) {
      std::error_code gone;
      count += std::filesystem::read_symlink(file, gone).string().starts_with("socket:") ? 1 : 0;
    }
    return count;
  }

  bool is_stopped() const {
    std::ifstream stat("/proc/" + std::to_string(pid_) + "/stat");
    std::string text((std::istreambuf_iterator<char>(stat)), {});
    const std::size_t end = text.rfind(") ");
    return end != std::string::npos && text[end + 2] == 'T';
  }

 private:
  /// Also root's: a program that root starts gets the capabilities of the bounding set.
  static void give_up_rights() {
    ::prctl(PR_CAPBSET_DROP, CAP_SYS_NICE, 0, 0, 0);
    ::prctl(PR_CAPBSET_DROP, CAP_SYS_RESOURCE, 0, 0, 0);
    ::prctl(PR_CAPBSET_DROP, CAP_IPC_LOCK, 0, 0, 0);
    const rlimit none{0, 0};
    ::setrlimit(RLIMIT_RTPRIO, &none);
    ::setrlimit(RLIMIT_MEMLOCK, &none);
  }

  /// The call behind nanosleep(3), clock_nanosleep(3), sleep(3) and usleep(3). ppoll(2) and the like stay.
  static bool forbid_pauses() {
    const sock_filter program[] = {
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_clock_nanosleep, 0, 1),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
    };
    const sock_fprog filter{static_cast<unsigned short>(std::size(program)), const_cast<sock_filter*>(program)};
    return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) == 0;
  }

  pid_t pid_;
};

}  // namespace godobject::firmware
