#include "toolchain/command/scene_file.h"

#include <fstream>
#include <system_error>

#include <fmt/format.h>

#include "toolchain/command/failure.h"

namespace godobject::command {
namespace {

constexpr std::uintmax_t kLargestImage = std::uintmax_t{8} << 30;

}  // namespace

SceneFile::SceneFile(const std::filesystem::path& file) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  std::ifstream stream(file, std::ios::binary);
  if (error || !stream)
    throw Failure(ExitCode::kNoInput, fmt::format("{}: cannot be read; make it with godobject-scenec", file.string()));
  if (size > kLargestImage)
    throw Failure(ExitCode::kBadData, fmt::format("{}: larger than any scene image", file.string()));
  size_ = static_cast<std::size_t>(size);
  blocks_.resize((size_ + sizeof(Block) - 1) / sizeof(Block));
  stream.read(reinterpret_cast<char*>(blocks_.data()), static_cast<std::streamsize>(size_));
  if (stream.gcount() != static_cast<std::streamsize>(size_)) {
    throw Failure(ExitCode::kIo, fmt::format("{}: could not be read to its end", file.string()));
  }
  const Status status = Scene::open(bytes(), scene_);
  if (status != Status::kOk) {
    throw Failure(ExitCode::kBadData,
                  fmt::format("{}: {}; compile it again with godobject-scenec", file.string(), describe(status)));
  }
}

std::span<const std::byte> SceneFile::bytes() const { return std::as_bytes(std::span(blocks_)).first(size_); }

}  // namespace godobject::command
