#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <zlib.h>
#include <nlohmann/json.hpp>

namespace godobject::page {

/// Reads the data of a page as a browser does, without the code that wrote it.
class PageReader {
 public:
  /// `bytes`: as from page_data.
  explicit PageReader(const std::string& bytes) {
    std::size_t length = 0;
    for (int i = 3; i >= 0; --i)
      length = length << 8 | static_cast<std::uint8_t>(bytes.at(static_cast<std::size_t>(i)));
    header_ = nlohmann::json::parse(bytes.substr(4, length));
    columns_ = bytes.substr(4 + length);
  }

  const nlohmann::json& header() const { return header_; }

  /// Returns the numbers of a column of the header.
  std::vector<double> column(const nlohmann::json& entry) const {
    const auto offset = entry.at("offset").get<std::size_t>();
    const auto count = entry.at("count").get<std::size_t>();
    std::vector<double> numbers;
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < count; ++i) {
      std::uint32_t folded = 0;
      for (std::size_t plane = 0; plane < 4; ++plane) {
        const auto byte = static_cast<std::uint8_t>(columns_.at(offset + plane * count + i));
        folded += static_cast<std::uint32_t>(byte) << (8 * plane);
      }
      number += folded % 2 == 0 ? folded / 2 : ~(folded / 2);
      numbers.push_back(static_cast<std::int32_t>(number) * entry.at("step").get<double>());
    }
    return numbers;
  }

 private:
  nlohmann::json header_;
  std::string columns_;
};

inline std::string from_base64(std::string_view text) {
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    const std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const std::size_t digit = digits.find(c);
    if (digit == std::string_view::npos) throw std::runtime_error("not base64");
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    count += 6;
    if (count >= 8) {
      count -= 8;
      bytes += static_cast<char>(bits >> count & 0xffu);
    }
  }
  return bytes;
}

/// Returns the bytes of a text in the format of compressed_text. `most`: a bound of their number.
inline std::string inflated(std::string_view text, std::size_t most = std::size_t{64} << 20) {
  const std::string packed = from_base64(text);
  std::string bytes(most, '\0');
  uLongf size = most;
  if (uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size, reinterpret_cast<const Bytef*>(packed.data()),
                 packed.size()) != Z_OK)
    throw std::runtime_error("not a zlib stream");
  bytes.resize(size);
  return bytes;
}

}  // namespace godobject::page
