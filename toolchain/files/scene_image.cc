#include "toolchain/files/scene_image.h"

#include <cstring>
#include <fstream>

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/files/input_file.h"

namespace godobject::files {

using command::ExitCode;
using command::Failure;

SceneImage::SceneImage(AlignedBytes image, const std::string& name) : bytes(std::move(image)) {
  const std::span<const std::byte> whole = bytes.span();
  if (whole.size() < sizeof(format::kMagic) || std::memcmp(whole.data(), format::kMagic, sizeof(format::kMagic)) != 0) {
    throw Failure(ExitCode::kBadData,
                  fmt::format("{}: is not a scene image (X.scene, made by godobject-scenec); compile one, or check the "
                              "order of the arguments",
                              name));
  }
  const Status status = SceneView::open(whole, scene);
  if (status != Status::kOk) {
    throw Failure(ExitCode::kBadData,
                  fmt::format("{}: {}; compile the scene again with godobject-scenec", name, describe(status)));
  }
}

SceneImage SceneImage::read(const std::filesystem::path& file) {
  require_regular_input(file, "make it with godobject-scenec, or check the path");
  const std::uintmax_t size = std::filesystem::file_size(file);
  std::ifstream stream(file, std::ios::binary);
  constexpr std::uintmax_t kLargest = std::uintmax_t{8} << 30;
  if (size > kLargest)
    throw Failure(
        ExitCode::kBadData,
        fmt::format(
            "{}: is not a scene image (X.scene, made by godobject-scenec): it is larger than 8 GiB; check the path",
            file.string()));
  AlignedBytes image(size);
  stream.read(reinterpret_cast<char*>(image.span().data()), static_cast<std::streamsize>(size));
  if (stream.gcount() != static_cast<std::streamsize>(size)) {
    throw Failure(ExitCode::kIo, fmt::format("{}: cannot be read completely; check the disk", file.string()));
  }
  return SceneImage(std::move(image), file.string());
}

}  // namespace godobject::files
