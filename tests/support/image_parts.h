#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/scene/format.h"
#include "tests/support/scene_image_builder.h"

namespace godobject::test {

/// The sections of a scene image, each of which a test can change, resize, rename or leave out.
class ImageParts {
 public:
  explicit ImageParts(SceneImage image);

  /// Returns the bytes of a section, without padding; adds an empty one if the image has none.
  std::vector<std::byte>& operator[](format::SectionId id);
  bool has(format::SectionId id) const;
  void leave_out(format::SectionId id);
  void rename(format::SectionId from, format::SectionId to);

  /// Returns the number of items of type T in a section.
  template <class T>
  std::size_t count(format::SectionId id) {
    return (*this)[id].size() / sizeof(T);
  }
  /// Returns the i-th T of a section.
  template <class T>
  T& item(format::SectionId id, std::size_t i = 0) {
    return reinterpret_cast<T*>((*this)[id].data())[i];
  }
  /// Replaces a section by these items.
  template <class T>
  void set(format::SectionId id, const std::vector<T>& items) {
    const auto bytes = std::as_bytes(std::span(items));
    (*this)[id].assign(bytes.begin(), bytes.end());
  }

  /// Returns the image of these sections, in the order in which they were added, with checksums.
  SceneImage assemble() const;

 private:
  std::vector<ImageSection> sections_;
};

}  // namespace godobject::test
