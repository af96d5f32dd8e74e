#include "toolchain/command/run.h"

#include <cstdio>
#include <exception>
#include <new>

#include <fmt/format.h>

#include "toolchain/command/failure.h"

namespace godobject::command {
namespace {

int fail(const CLI::App& app, const char* message, ExitCode exit_code) {
  fmt::print(stderr, "{}: {}\n", app.get_name(), message);
  return static_cast<int>(exit_code);
}

}  // namespace

int run(CLI::App& app, int argc, char** argv, const std::function<int()>& body) {
  app.set_version_flag("--version", app.get_name() + " " GODOBJECT_VERSION);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& wanted) {  // --help, --version
    return app.exit(wanted);
  } catch (const CLI::ParseError& error) {
    return fail(app, fmt::format("{} (see {} --help)", error.what(), app.get_name()).c_str(), ExitCode::kUsage);
  }
  try {
    return body();
  } catch (const Failure& failure) {
    return fail(app, failure.what(), failure.exit_code());
  } catch (const std::bad_alloc&) {
    return fail(app, "out of memory: free some, or make the scene smaller (voxel_size, points)", ExitCode::kInternal);
  } catch (const std::exception& error) {
    return fail(app, error.what(), ExitCode::kInternal);
  }
}

}  // namespace godobject::command
