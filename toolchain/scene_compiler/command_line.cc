#include "toolchain/scene_compiler/command_line.h"

#include <cstdio>
#include <new>
#include <string>

#include <fmt/format.h>
#include <unistd.h>

#include "toolchain/scene_compiler/failure.h"

namespace godobject::scene_compiler {
namespace {

/// One line whatever the text holds.
int end(const CLI::App& app, ExitCode code, std::string message) {
  for (char& c : message) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  fmt::print(stderr, "{}: {}\n", app.get_name(), message);
  return static_cast<int>(code);
}

}  // namespace

int run_command(CLI::App& app, int argc, const char* const* argv, const std::function<void()>& work) {
  try {
    app.parse(argc, argv);
    work();
    if (std::fflush(stdout) != 0) throw Failure(ExitCode::kIo, "standard output: writing failed; check where it goes");
    return static_cast<int>(ExitCode::kOk);
  } catch (const CLI::Success& success) {  // --help, --version
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    return end(app, ExitCode::kUsage, fmt::format("{}; see {} --help", error.what(), app.get_name()));
  } catch (const Failure& failure) {
    return end(app, failure.exit_code(), failure.what());
  } catch (const std::bad_alloc&) {
    return end(app, ExitCode::kBadData, "not enough memory for this scene; raise voxel_size or decimate the meshes");
  } catch (const std::exception& error) {
    return end(app, ExitCode::kInternal, fmt::format("{}; please report this", error.what()));
  }
}

ProgressLine::ProgressLine() : terminal_(::isatty(STDERR_FILENO) != 0) {}

ProgressLine::~ProgressLine() {
  if (phase_ != nullptr) std::fputs("\r\033[K", stderr);
}

void ProgressLine::show(const char* phase, double done) {
  const int percent = static_cast<int>(100.0 * done);
  if (!terminal_ || (phase_ == phase && percent_ == percent)) return;
  phase_ = phase;
  percent_ = percent;
  fmt::print(stderr, "\r\033[K{} {} %", phase, percent);
  std::fflush(stderr);
}

}  // namespace godobject::scene_compiler
