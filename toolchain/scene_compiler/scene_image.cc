#include "toolchain/scene_compiler/scene_image.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <new>

#include <fmt/format.h>

#include "toolchain/scene_compiler/failure.h"

namespace godobject::scene_compiler {
namespace {

std::size_t padded(std::size_t bytes) {
  return (bytes + format::kAlignment - 1) / format::kAlignment * format::kAlignment;
}

}  // namespace

AlignedBytes::AlignedBytes(std::size_t size)
    : bytes_(static_cast<std::byte*>(
          ::operator new (std::max<std::size_t>(size, 1), std::align_val_t{format::kAlignment}))),
      size_(size) {
  std::memset(bytes_.get(), 0, size);
}

void AlignedBytes::Free::operator()(std::byte* bytes) const noexcept {
  ::operator delete (bytes, std::align_val_t{format::kAlignment});
}

AlignedBytes make_image(const std::vector<SectionBytes>& sections) {
  const std::size_t header_bytes = padded(sizeof(format::Header) + sections.size() * sizeof(format::Section));
  std::size_t total = header_bytes;
  for (const SectionBytes& section : sections) total += padded(section.bytes.size());
  AlignedBytes image(total);
  std::byte* const data = image.span().data();

  std::size_t offset = header_bytes;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const std::vector<std::byte>& bytes = sections[i].bytes;
    std::copy(bytes.begin(), bytes.end(), data + offset);
    const format::Section entry{sections[i].id, 0, offset, bytes.size(),
                                format::checksum(data + offset, padded(bytes.size()))};
    std::memcpy(data + sizeof(format::Header) + i * sizeof(entry), &entry, sizeof(entry));
    offset += padded(bytes.size());
  }
  format::Header header{};
  std::memcpy(header.magic, format::kMagic, sizeof(header.magic));
  header.byte_order = format::kByteOrder;
  header.version = format::kVersion;
  header.header_bytes = static_cast<std::uint32_t>(header_bytes);
  header.section_count = static_cast<std::uint32_t>(sections.size());
  header.total_bytes = total;
  std::memcpy(data, &header, sizeof(header));
  header.checksum = format::checksum(data, header_bytes);
  std::memcpy(data, &header, sizeof(header));
  return image;
}

SceneImage::SceneImage(AlignedBytes image, const std::string& name) : bytes(std::move(image)) {
  const Status status = Scene::open(bytes.span(), scene);
  if (status != Status::kOk) {
    throw Failure(ExitCode::kBadData,
                  fmt::format("{}: {}; compile the scene again with godobject-scenec", name, describe(status)));
  }
}

SceneImage SceneImage::read(const std::filesystem::path& file) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  std::ifstream stream(file, std::ios::binary);
  if (error || !stream) {
    throw Failure(ExitCode::kNoInput,
                  fmt::format("{}: cannot be read; check the path and its permissions", file.string()));
  }
  AlignedBytes image(size);
  stream.read(reinterpret_cast<char*>(image.span().data()), static_cast<std::streamsize>(size));
  if (stream.gcount() != static_cast<std::streamsize>(size)) {
    throw Failure(ExitCode::kIo, fmt::format("{}: reading it failed; check the disk", file.string()));
  }
  return SceneImage(std::move(image), file.string());
}

}  // namespace godobject::scene_compiler
