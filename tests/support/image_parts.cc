#include "tests/support/image_parts.h"

#include <algorithm>

namespace godobject::test {

using format::SectionId;

ImageParts::ImageParts(SceneImage image) {
  const std::byte* const begin = image.bytes().data();
  const auto& header = *reinterpret_cast<const format::Header*>(begin);
  const auto* sections = reinterpret_cast<const format::Section*>(begin + sizeof(format::Header));
  for (const format::Section& section : std::span(sections, header.section_count)) {
    const auto bytes = image.bytes().subspan(section.offset, section.bytes);
    sections_.push_back({section.id, {bytes.begin(), bytes.end()}});
  }
}

std::vector<std::byte>& ImageParts::operator[](SectionId id) {
  for (ImageSection& section : sections_) {
    if (section.id == id) return section.bytes;
  }
  return sections_.emplace_back(ImageSection{id, {}}).bytes;
}

bool ImageParts::has(SectionId id) const {
  return std::any_of(sections_.begin(), sections_.end(), [id](const ImageSection& s) { return s.id == id; });
}

void ImageParts::leave_out(SectionId id) {
  std::erase_if(sections_, [id](const ImageSection& section) { return section.id == id; });
}

void ImageParts::rename(SectionId from, SectionId to) {
  for (ImageSection& section : sections_) {
    if (section.id == from) section.id = to;
  }
}

SceneImage ImageParts::assemble() const { return assemble_image(sections_); }

}  // namespace godobject::test
