#include "toolchain/scene_compiler/mesh/ply_reader.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "toolchain/scene_compiler/mesh/polygon.h"

namespace godobject::scene_compiler {
namespace {

enum class Encoding { kAscii, kLittle, kBig };
enum class Number { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

struct Property {
  std::string name;
  Number type{};
  bool list = false;
  Number count_type{};
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

struct PlyHeader {
  Encoding encoding{};
  std::vector<Element> elements;
  std::size_t bytes = 0;
};

Number number_type(const std::string& name) {
  static constexpr std::pair<std::string_view, Number> kNames[] = {
      {"char", Number::kInt8},     {"int8", Number::kInt8},     {"uchar", Number::kUint8},
      {"uint8", Number::kUint8},   {"short", Number::kInt16},   {"int16", Number::kInt16},
      {"ushort", Number::kUint16}, {"uint16", Number::kUint16}, {"int", Number::kInt32},
      {"int32", Number::kInt32},   {"uint", Number::kUint32},   {"uint32", Number::kUint32},
      {"float", Number::kFloat},   {"float32", Number::kFloat}, {"double", Number::kDouble},
      {"float64", Number::kDouble}};
  for (const auto& [known, type] : kNames) {
    if (name == known) return type;
  }
  throw std::runtime_error(fmt::format("unknown number type \"{}\" in its header", name));
}

Encoding encoding(const std::string& name) {
  if (name == "ascii") return Encoding::kAscii;
  if (name == "binary_little_endian") return Encoding::kLittle;
  if (name == "binary_big_endian") return Encoding::kBig;
  throw std::runtime_error(fmt::format("unknown format \"{}\" in its header", name));
}

Property property(std::istringstream& words) {
  Property property;
  std::string type;
  words >> type;
  if (type == "list") {
    property.list = true;
    words >> type;
    property.count_type = number_type(type);
    words >> type;
  }
  property.type = number_type(type);
  words >> property.name;
  return property;
}

PlyHeader read_header(std::string_view data) {
  PlyHeader header;
  bool has_format = false;
  for (std::size_t begin = 0; begin < data.size();) {
    const std::size_t end = data.find('\n', begin);
    if (end == std::string_view::npos) break;
    std::istringstream words{std::string(data.substr(begin, end - begin))};
    std::string keyword;
    words >> keyword;
    if (begin == 0 && keyword != "ply") break;
    begin = end + 1;
    std::string word;
    if (keyword == "end_header") {
      if (!has_format) break;
      header.bytes = begin;
      return header;
    }
    if (keyword == "format") {
      words >> word;
      header.encoding = encoding(word);
      has_format = true;
    } else if (keyword == "element") {
      Element element;
      if (!(words >> element.name >> element.count))
        throw std::runtime_error("an element without a count in its header");
      header.elements.push_back(element);
    } else if (keyword == "property") {
      if (header.elements.empty()) throw std::runtime_error("a property before the first element in its header");
      header.elements.back().properties.push_back(property(words));
    }
  }
  throw std::runtime_error("no complete PLY header");
}

/// Reads the numbers after the header, one after the other.
class Body {
 public:
  Body(std::string_view data, Encoding encoding) : data_(data), encoding_(encoding) {}

  double next(Number type) {
    if (encoding_ == Encoding::kAscii) return next_word();
    switch (type) {
      case Number::kInt8: return next_as<std::int8_t>();
      case Number::kUint8: return next_as<std::uint8_t>();
      case Number::kInt16: return next_as<std::int16_t>();
      case Number::kUint16: return next_as<std::uint16_t>();
      case Number::kInt32: return next_as<std::int32_t>();
      case Number::kUint32: return next_as<std::uint32_t>();
      case Number::kFloat: return static_cast<double>(next_as<float>());
      case Number::kDouble: return next_as<double>();
    }
    return 0.0;
  }

  std::uint64_t next_count(Number type) {
    const double value = next(type);
    if (!(value >= 0.0 && value <= static_cast<double>(data_.size()) && value == std::floor(value))) {
      throw std::runtime_error(fmt::format("a list with {} entries", value));
    }
    return static_cast<std::uint64_t>(value);
  }

 private:
  template <class T>
  T next_as() {
    if (data_.size() - at_ < sizeof(T)) throw_short();
    char bytes[sizeof(T)];
    std::memcpy(bytes, data_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    if (encoding_ == Encoding::kBig) std::reverse(bytes, bytes + sizeof(T));
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return value;
  }

  double next_word() {
    while (at_ < data_.size() && std::isspace(static_cast<unsigned char>(data_[at_])) != 0) ++at_;
    if (at_ == data_.size()) throw_short();
    const char* const begin = data_.data() + at_ + (data_[at_] == '+' ? 1 : 0);
    const char* const end = data_.data() + data_.size();
    double value = 0.0;
    const auto [stop, error] = std::from_chars(begin, end, value);
    if (error == std::errc::result_out_of_range) {
      value = std::numeric_limits<double>::infinity();
    } else if (error != std::errc() || (stop != end && std::isspace(static_cast<unsigned char>(*stop)) == 0)) {
      throw std::runtime_error(
          fmt::format("\"{}\" instead of a number", data_.substr(at_, std::min<std::size_t>(20, data_.size() - at_))));
    }
    at_ = static_cast<std::size_t>(stop - data_.data());
    return value;
  }

  [[noreturn]] static void throw_short() {
    throw std::runtime_error("it ends before the last element that its header announces");
  }

  std::string_view data_;
  Encoding encoding_;
  std::size_t at_ = 0;
};

void skip(Body& body, const Property& property) {
  const std::uint64_t count = property.list ? body.next_count(property.count_type) : 1;
  for (std::uint64_t i = 0; i < count; ++i) body.next(property.type);
}

void read_vertices(Body& body, const Element& element, TriangleMesh& mesh) {
  constexpr std::string_view kAxes[] = {"x", "y", "z"};
  int found = 0;
  for (const Property& p : element.properties)
    found += std::count(std::begin(kAxes), std::end(kAxes), p.name) != 0 ? 1 : 0;
  if (found != 3) throw std::runtime_error("vertices without x, y or z");
  for (std::uint64_t i = 0; i < element.count; ++i) {
    Eigen::Vector3d vertex = Eigen::Vector3d::Zero();
    for (const Property& p : element.properties) {
      const auto axis = std::find(std::begin(kAxes), std::end(kAxes), p.name);
      if (axis == std::end(kAxes) || p.list) {
        skip(body, p);
      } else {
        vertex[axis - std::begin(kAxes)] = body.next(p.type);
      }
    }
    mesh.vertices.push_back(vertex);
  }
}

void read_faces(Body& body, const Element& element, TriangleMesh& mesh, MeshReport& report) {
  std::vector<std::uint32_t> corners;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    for (const Property& p : element.properties) {
      if (!p.list || (p.name != "vertex_indices" && p.name != "vertex_index")) {
        skip(body, p);
        continue;
      }
      corners.clear();
      const std::uint64_t count = body.next_count(p.count_type);
      for (std::uint64_t k = 0; k < count; ++k) {
        const double corner = body.next(p.type);
        if (!(corner >= 0.0 && corner < static_cast<double>(mesh.vertices.size()))) {
          throw std::runtime_error(
              fmt::format("face {} refers to vertex {}, but there are {}", i, corner, mesh.vertices.size()));
        }
        corners.push_back(static_cast<std::uint32_t>(corner));
      }
      if (count > 3) ++report.polygons;
      if (count < 3) ++report.lines_and_points;
      if (count >= 3) triangulate(mesh.vertices, corners, mesh.triangles);
    }
  }
}

}  // namespace

TriangleMesh read_ply(const std::filesystem::path& file, MeshReport& report) {
  std::ifstream stream(file, std::ios::binary);
  const std::string data{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  const PlyHeader header = read_header(data);
  Body body(std::string_view(data).substr(header.bytes), header.encoding);
  TriangleMesh mesh;
  for (const Element& element : header.elements) {
    if (element.count > 4 * kMaxTriangles) {
      throw std::runtime_error(fmt::format("{} items of element {} exceed the limit", element.count, element.name));
    }
    if (element.name == "vertex") {
      read_vertices(body, element, mesh);
      report.file_vertices = element.count;
    } else if (element.name == "face") {
      read_faces(body, element, mesh, report);
      report.file_faces = element.count;
    } else {
      for (std::uint64_t i = 0; i < element.count; ++i) {
        for (const Property& p : element.properties) skip(body, p);
      }
    }
  }
  return mesh;
}

}  // namespace godobject::scene_compiler
