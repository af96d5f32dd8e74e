#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "toolchain/report/study/case.h"

namespace godobject::report {

/// The content of a result file: a case's result and its origin.
struct StoredResult {
  std::string inputs;   ///< digest of the case's inputs
  std::string program;  ///< digest of the program that made it
  std::string machine;
  double seconds = 0.0;
  CaseResult result;
};

/// Returns a digest of 64 bits in hexadecimal.
std::string digest(const std::string& bytes);

std::string file_digest(const std::filesystem::path& file);

/// Returns the digest of the running program.
const std::string& program_digest();

/// Returns a description such as "Linux 6.1.0, x86_64, AMD EPYC ..., 2 processors".
const std::string& this_machine();

/// Returns FOLDER/NAME.json.
std::filesystem::path result_path(const std::filesystem::path& folder, const std::string& name);

/// Writes a result file, which appears under its name only when it is complete. Throws Failure (kIo, kNoPermission).
void write_result(const std::filesystem::path& file, const std::string& name, const StoredResult& stored);

/// Reads a result file; nullopt if it is missing. Throws Failure (kBadData) naming the file if it is not a result of
/// the case `name`.
std::optional<StoredResult> read_result(const std::filesystem::path& file, const std::string& name);

}  // namespace godobject::report
