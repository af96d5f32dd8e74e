#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "toolchain/report/study/case.h"

namespace godobject::report {

/// A case's result as it stands in its file, with what it was made from.
struct StoredResult {
  std::string inputs;   ///< `digest` of the case's inputs
  std::string program;  ///< `digest` of the program that made it
  std::string machine;
  double seconds = 0.0;
  CaseResult result;
};

/// 64 bits in hexadecimal.
std::string digest(const std::string& bytes);

std::string file_digest(const std::filesystem::path& file);

/// Of the program that runs.
const std::string& program_digest();

/// "Linux 6.1.0, x86_64, AMD EPYC ..., 2 processors"
const std::string& this_machine();

/// FOLDER/NAME.json
std::filesystem::path result_path(const std::filesystem::path& folder, const std::string& name);

/// Appears under its name only when it is complete. Throws Failure (kIo, kNoPermission).
void write_result(const std::filesystem::path& file, const std::string& name, const StoredResult& stored);

/// Nothing where there is no file. Throws Failure (kBadData) naming the file if it is no result of the case `name`.
std::optional<StoredResult> read_result(const std::filesystem::path& file, const std::string& name);

}  // namespace godobject::report
