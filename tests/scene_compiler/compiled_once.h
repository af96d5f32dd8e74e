#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "tests/scene_compiler/test_meshes.h"
#include "toolchain/scene_compiler/compile_scene.h"

namespace godobject::scene_compiler {

inline std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// Compiles the scene file `text` to `output` in `folder`.
inline CompileReport compile_anew(const std::string& text, const ScratchFolder& folder, const char* output,
                                  std::optional<format::Solver> only = {}, bool times_left_out = false) {
  CompileRequest request;
  request.scene_file = folder.write("scene.toml", text);
  request.output = folder.file(output);
  request.only_solver = only;
  request.times_left_out = times_left_out;
  return compile_scene(request);
}

/// As compile_anew, but compiles equal requests once in a process: each takes seconds.
inline CompileReport compile_once(const std::string& text, const ScratchFolder& folder, const char* output,
                                  std::optional<format::Solver> only = {}, bool times_left_out = false) {
  static std::map<std::tuple<std::string, std::optional<format::Solver>, bool>, std::pair<CompileReport, std::string>>
      compiled;
  const std::tuple request(text, only, times_left_out);
  const auto found = compiled.find(request);
  if (found != compiled.end()) {
    folder.write(output, found->second.second);
    return found->second.first;
  }
  CompileReport report = compile_anew(text, folder, output, only, times_left_out);
  compiled.emplace(request, std::pair(report, bytes_of(folder.file(output))));
  return report;
}

}  // namespace godobject::scene_compiler
