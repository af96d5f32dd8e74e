#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include <unistd.h>

#include <gtest/gtest.h>

#include "toolchain/files/atomic_file.h"
#include "toolchain/files/text_file.h"
#include "toolchain/mcap/mcap_writer.h"

namespace godobject::mcap {

/// Returns the bytes of the file that `write` writes.
inline std::string written_file(const std::function<void(McapWriter&)>& write) {
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / ("mcap_test_" + std::to_string(::getpid()) + ".mcap");
  {
    files::AtomicFile out(file);
    McapWriter writer(out);
    write(writer);
    out.commit();
  }
  const std::string bytes = files::read_text(file, std::size_t{1} << 30);
  std::filesystem::remove(file);
  return bytes;
}

}  // namespace godobject::mcap
