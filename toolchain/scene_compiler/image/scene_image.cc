#include "toolchain/scene_compiler/image/scene_image.h"

#include <algorithm>
#include <cstring>

namespace godobject::scene_compiler {
namespace {

std::size_t padded(std::size_t bytes) {
  return (bytes + format::kAlignment - 1) / format::kAlignment * format::kAlignment;
}

}  // namespace

files::AlignedBytes make_image(const std::vector<SectionBytes>& sections) {
  const std::size_t header_bytes = padded(sizeof(format::Header) + sections.size() * sizeof(format::Section));
  std::size_t total = header_bytes;
  for (const SectionBytes& section : sections) total += padded(section.bytes.size());
  files::AlignedBytes image(total);
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

}  // namespace godobject::scene_compiler
