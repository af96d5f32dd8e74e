#pragma once

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <span>
#include <vector>

/// Bytes at a multiple of 64, as a scene image and the memory of a god object must be.
class AlignedBytes {
 public:
  explicit AlignedBytes(std::size_t size = 0) : lines_(size / sizeof(Line) + 1), size_(size) {}
  std::span<std::byte> span() { return std::as_writable_bytes(std::span(lines_)).first(size_); }

 private:
  struct alignas(64) Line {
    std::byte bytes[64];
  };
  std::vector<Line> lines_;
  std::size_t size_;
};

/// Returns a whole file. Ends the program with code 66 if it cannot be read.
inline AlignedBytes read_file(const char* path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) {
    std::fprintf(stderr, "%s: cannot be read; check the path\n", path);
    std::exit(66);
  }
  AlignedBytes bytes(static_cast<std::size_t>(file.tellg()));
  file.seekg(0).read(reinterpret_cast<char*>(bytes.span().data()), static_cast<std::streamsize>(bytes.span().size()));
  return bytes;
}
