#pragma once

#include <functional>

#include <CLI/CLI.hpp>

namespace godobject::command {

/// Parses the command line into `app` (adding --version), runs `body` and returns the exit code for main(). Turns every
/// error into one line on stderr and an exit code of sysexits.h.
int run(CLI::App& app, int argc, char** argv, const std::function<void()>& body);

}  // namespace godobject::command
