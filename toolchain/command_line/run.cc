#include "toolchain/command_line/run.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "godobject/version.h"
#include "toolchain/command_line/failure.h"

namespace godobject::command {
namespace {

/// Prints the message as one line. Returns the exit code.
int fail(const CLI::App& app, ExitCode exit_code, std::string message) {
  for (char& c : message) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  std::fflush(stdout);  // earlier output comes first, also if both go to one file
  fmt::print(stderr, "{}: {}\n", app.get_name(), message);
  return static_cast<int>(exit_code);
}

}  // namespace

int run(CLI::App& app, int argc, char** argv, const std::function<void()>& body) {
  app.get_formatter()->column_width(38);  // an option, its value and its description fit in one line
  app.set_version_flag("--version", app.get_name() + " " GODOBJECT_VERSION);
  try {
    // The parser loops forever on an empty word before an unknown one if there is a group of options.
    if (std::any_of(argv, argv + argc, [](const char* word) { return std::string_view(word).empty(); })) {
      throw CLI::ParseError("an argument is empty", CLI::ExitCodes::ExtrasError);
    }
    app.parse(argc, argv);
    body();
    if (std::fflush(stdout) != 0) throw Failure(ExitCode::kIo, "standard output: cannot be written; check its target");
    return static_cast<int>(ExitCode::kOk);
  } catch (const CLI::Success& wanted) {  // --help, --version
    return app.exit(wanted);
  } catch (const CLI::ParseError& error) {
    return fail(app, ExitCode::kUsage, fmt::format("{}; see {} --help", error.what(), app.get_name()));
  } catch (const Failure& failure) {
    return fail(app, failure.exit_code(), failure.what());
  } catch (const std::bad_alloc&) {
    return fail(app, ExitCode::kBadData, "not enough memory for this scene; raise voxel_size or decimate the meshes");
  } catch (const std::exception& error) {
    return fail(app, ExitCode::kInternal, fmt::format("{}; please report this", error.what()));
  }
}

}  // namespace godobject::command
