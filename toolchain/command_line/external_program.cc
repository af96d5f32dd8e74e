#include "toolchain/command_line/external_program.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "toolchain/command_line/failure.h"

extern char** environ;

namespace godobject::command {
namespace {

/// Reads until the other side closes.
std::string drain(int descriptor) {
  std::string text;
  char buffer[4096];
  for (;;) {
    const ssize_t count = ::read(descriptor, buffer, sizeof(buffer));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(buffer, static_cast<std::size_t>(count));
  }
}

/// Returns the last lines of the text on one line, because an error message is one line.
std::string ending(const std::string& text) {
  constexpr std::size_t kLongest = 400;
  std::string end = text.size() > kLongest ? text.substr(text.size() - kLongest) : text;
  for (char& c : end) {
    if (c == '\n' || c == '\r' || c == '\t') c = ' ';
  }
  return end;
}

int wait_for(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

}  // namespace

std::optional<std::filesystem::path> find_program(const std::string& name) {
  const char* const path = std::getenv("PATH");
  std::string_view folders = path != nullptr ? path : "/usr/bin:/bin";
  while (!folders.empty()) {
    const std::size_t colon = folders.find(':');
    const std::filesystem::path candidate = std::filesystem::path(folders.substr(0, colon)) / name;
    if (::access(candidate.c_str(), X_OK) == 0) return candidate;
    folders = colon == std::string_view::npos ? std::string_view() : folders.substr(colon + 1);
  }
  return std::nullopt;
}

void run_program(const std::vector<std::string>& arguments, const std::string& package) {
  const std::string& name = arguments.front();
  const auto program = find_program(name);
  if (!program) throw Failure(ExitCode::kInternal, fmt::format("{}: not installed; apt-get install {}", name, package));

  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0)
    throw Failure(ExitCode::kInternal, fmt::format("{}: cannot create a pipe ({})", name, std::strerror(errno)));
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  pid_t child = 0;
  const int error = ::posix_spawn(&child, program->c_str(), &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  const std::string output = error == 0 ? drain(ends[0]) : std::string();
  ::close(ends[0]);
  if (error != 0)
    throw Failure(ExitCode::kInternal, fmt::format("{}: cannot be started ({})", name, std::strerror(error)));
  const int status = wait_for(child);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw Failure(ExitCode::kInternal, fmt::format("{}: failed: {}", name, ending(output)));
  }
}

}  // namespace godobject::command
