#include "toolchain/files/scene_image.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <new>

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/files/input_file.h"

namespace godobject::files {

using command::ExitCode;
using command::Failure;

AlignedBytes::AlignedBytes(std::size_t size)
    : bytes_(static_cast<std::byte*>(
          ::operator new (std::max<std::size_t>(size, 1), std::align_val_t{format::kAlignment}))),
      size_(size) {
  std::memset(bytes_.get(), 0, size);
}

void AlignedBytes::Free::operator()(std::byte* bytes) const noexcept {
  ::operator delete (bytes, std::align_val_t{format::kAlignment});
}

SceneImage::SceneImage(AlignedBytes image, const std::string& name) : bytes(std::move(image)) {
  const std::span<const std::byte> whole = bytes.span();
  if (whole.size() < sizeof(format::kMagic) || std::memcmp(whole.data(), format::kMagic, sizeof(format::kMagic)) != 0) {
    throw Failure(ExitCode::kBadData,
                  fmt::format("{}: is not a scene image (X.scene, made by godobject-scenec); compile one, or check the "
                              "order of the arguments",
                              name));
  }
  const Status status = Scene::open(whole, scene);
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
