#pragma once

#include <fcntl.h>

#include <filesystem>

#include <gtest/gtest.h>

#include "firmware/records/log_file.h"

namespace godobject::firmware {

/// A log in any file, also in one that a controller refuses: a link to a full disk, or a pipe that stalls.
inline LogFile open_log(const std::filesystem::path& file) {
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0640);
  EXPECT_GE(descriptor, 0) << file;
  return LogFile(file, descriptor);
}

}  // namespace godobject::firmware
