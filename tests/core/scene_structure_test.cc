// The structure of a scene image: its sections, its trees and its indices. The view shows exactly these bytes.

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <map>
#include <ostream>
#include <vector>

#include "core/scene/scene_view.h"
#include "tests/support/image_parts.h"
#include "tests/support/random.h"
#include "tests/support/whole_image.h"

namespace godobject {

/// Prints a status in messages of GoogleTest.
inline void PrintTo(Status status, std::ostream* out) { *out << describe(status); }

namespace {

using format::SectionId;
using test::ImageParts;
using test::SceneImage;

constexpr std::uint32_t kSectionCount = 30;

Status status_of(std::span<const std::byte> bytes) {
  SceneView scene;
  return SceneView::open(bytes, scene);
}
Status status_of(const ImageParts& image) { return status_of(SceneImage(image.assemble()).bytes()); }

SectionId id_of(std::uint32_t number) { return static_cast<SectionId>(number); }

/// The sections that an image may lack, each without any other.
bool is_optional(SectionId id) { return id == SectionId::kProvenance || id == SectionId::kWorkspace; }

/// Sections that other sections refer to. Without them a number is wrong, not the layout.
bool is_referred_to(SectionId id) {
  return id == SectionId::kRefined || id == SectionId::kFacets || id == SectionId::kExactBricks ||
         id == SectionId::kFacetSets || id == SectionId::kFacetNumbers || id == SectionId::kBodyRefined ||
         id == SectionId::kBodyFacets || id == SectionId::kBodyExactBricks || id == SectionId::kBodyFacetSets ||
         id == SectionId::kBodyFacetNumbers;
}

TEST(SceneStructure, NeedsEverySectionButTwo) {
  const ImageParts whole = test::whole_image();
  ASSERT_EQ(status_of(whole), Status::kOk);
  for (std::uint32_t number = 1; number <= kSectionCount; ++number) {
    const SectionId id = id_of(number);
    ASSERT_TRUE(whole.has(id)) << number;
    ImageParts image = whole;
    image.leave_out(id);
    EXPECT_EQ(status_of(image), is_optional(id)      ? Status::kOk
                                : is_referred_to(id) ? Status::kImageValue
                                                     : Status::kImageLayout)
        << "without section " << number;
  }
}

TEST(SceneStructure, NeedsNoSecondDirection) {
  ImageParts image = test::whole_image();
  for (const SectionId id : {SectionId::kBodyGrid, SectionId::kFeatures}) image.leave_out(id);
  for (const SectionId id : {SectionId::kBodyBrickIndex, SectionId::kBodyBricks, SectionId::kBodyRefined,
                             SectionId::kFeaturePoints, SectionId::kFeatureNodes, SectionId::kBodyFacets,
                             SectionId::kBodyExactBricks, SectionId::kBodyFacetSets, SectionId::kBodyFacetNumbers}) {
    EXPECT_EQ(status_of(image), Status::kOk);
    image.leave_out(id);
  }
  const SceneImage bytes = image.assemble();
  const SceneView scene = test::open_scene(bytes);
  EXPECT_FALSE(scene.has_features());
  EXPECT_EQ(scene.features.size, 0u);
  EXPECT_EQ(scene.features_origin, Vector3::Zero());
}

/// A section that is some bytes too long or too short has the wrong layout. Only provenance has any length.
TEST(SceneStructure, NeedsEverySectionsExactLength) {
  const ImageParts whole = test::whole_image();
  for (std::uint32_t number = 1; number <= kSectionCount; ++number) {
    const SectionId id = id_of(number);
    const bool of_sets = id == SectionId::kFacetSets || id == SectionId::kBodyFacetSets;
    const bool of_numbers = id == SectionId::kFacetNumbers || id == SectionId::kBodyFacetNumbers;
    for (const int bytes : {-8, -4, -1, 1, 4, 8, 64}) {
      if ((of_sets && bytes % 8 == 0) || (of_numbers && bytes % 4 == 0)) continue;  // whole items
      ImageParts image = whole;
      image[id].resize(image[id].size() + static_cast<std::size_t>(bytes));
      EXPECT_EQ(status_of(image), id == SectionId::kProvenance ? Status::kOk : Status::kImageLayout)
          << "section " << number << " by " << bytes;
    }
    ImageParts image = whole;
    image[id].clear();
    EXPECT_EQ(status_of(image), id == SectionId::kProvenance ? Status::kOk
                                : is_referred_to(id)         ? Status::kImageValue
                                                             : Status::kImageLayout)
        << "section " << number << " empty";
  }
}

/// Each item of an array is needed, and no item more.
TEST(SceneStructure, NeedsEveryItemOfItsArrays) {
  const ImageParts whole = test::whole_image();
  const std::map<SectionId, std::size_t> item_bytes = {
      {SectionId::kBrickIndex, 4},   {SectionId::kBricks, 256},       {SectionId::kPoints, 12},
      {SectionId::kNormals, 12},     {SectionId::kNodes, 32},         {SectionId::kBodyBrickIndex, 4},
      {SectionId::kBodyBricks, 256}, {SectionId::kFeaturePoints, 12}, {SectionId::kFeatureNodes, 32}};
  for (const auto& [id, bytes] : item_bytes) {
    for (const std::ptrdiff_t by : {-1, 1}) {
      ImageParts image = whole;
      auto& section = image[id];
      section.resize(section.size() + static_cast<std::size_t>(by) * bytes);
      EXPECT_EQ(status_of(image), Status::kImageLayout) << "section " << static_cast<int>(id) << " by " << by;
    }
  }
  for (const SectionId id : {SectionId::kRefined, SectionId::kBodyRefined}) {
    ImageParts image = whole;
    image[id].resize(image[id].size() + sizeof(format::Refined));
    EXPECT_EQ(status_of(image), Status::kImageValue) << "a refinement that none leads to";
  }
  for (const SectionId id : {SectionId::kFacets, SectionId::kBodyFacets}) {
    ImageParts image = whole;
    image.set<format::Facet>(id, {image.item<format::Facet>(id), test::facet_along_z()});
    EXPECT_EQ(status_of(image), Status::kOk) << "a facet that no brick has";
    image.item<format::Facet>(id, 1).plane[2][0] = 0.5;
    EXPECT_EQ(status_of(image), Status::kImageValue) << "the second facet is checked as well";
  }
  for (const SectionId id : {SectionId::kExactBricks, SectionId::kBodyExactBricks}) {
    ImageParts image = whole;
    image.set<format::ExactBrick>(id, {image.item<format::ExactBrick>(id), image.item<format::ExactBrick>(id)});
    EXPECT_EQ(status_of(image), Status::kOk) << "an exact brick that no brick names";
    image.item<format::ExactBrick>(id, 1).cell[0] = 2;
    EXPECT_EQ(status_of(image), Status::kImageValue) << "the second one is checked as well";
  }
  for (const SectionId id : {SectionId::kFacetSets, SectionId::kBodyFacetSets}) {
    ImageParts image = whole;
    image.set<format::FacetSet>(id, {image.item<format::FacetSet>(id), image.item<format::FacetSet>(id)});
    EXPECT_EQ(status_of(image), Status::kOk) << "a set that no cell has";
    image.item<format::FacetSet>(id, 1).first = 1;
    EXPECT_EQ(status_of(image), Status::kImageValue) << "the second one is checked as well";
  }
  for (const SectionId id : {SectionId::kFacetNumbers, SectionId::kBodyFacetNumbers}) {
    ImageParts image = whole;
    image.set<std::uint32_t>(id, {0, 0});
    EXPECT_EQ(status_of(image), Status::kOk) << "a number that no set has";
    image.set<std::uint32_t>(id, {0, 1});
    EXPECT_EQ(status_of(image), Status::kImageValue) << "the second one is checked as well";
  }
}

TEST(SceneStructure, MayHaveSectionsThatItDoesNotKnow) {
  ImageParts image = test::whole_image();
  for (std::uint32_t number = kSectionCount + 1; number < format::kMaxSections; ++number) {
    image[id_of(number)].resize(100);
    EXPECT_EQ(status_of(image), Status::kOk) << number;
  }
  for (const std::uint32_t number : {0u, 28u, 29u, 0xffffffffu}) {
    ImageParts renamed = test::whole_image();
    renamed.rename(SectionId::kProvenance, id_of(number));
    EXPECT_EQ(status_of(renamed), Status::kImageLayout) << number;
  }
}

/// Sharp edges of both bodies or of none; each in the spheres of its nodes, those of the moving body in its sphere.
TEST(SceneStructure, HasSharpEdgesInTheirSpheres) {
  const ImageParts whole = test::whole_image();
  ImageParts none = whole;
  for (const SectionId id : {SectionId::kSharpEdges, SectionId::kSharpEdgeNodes, SectionId::kBodySharpEdges,
                             SectionId::kBodySharpEdgeNodes}) {
    EXPECT_EQ(status_of(none), id == SectionId::kSharpEdges ? Status::kOk : Status::kImageLayout);
    none.leave_out(id);
  }
  EXPECT_EQ(status_of(none), Status::kOk);
  for (const bool of_body : {false, true}) {
    const SectionId edges = of_body ? SectionId::kBodySharpEdges : SectionId::kSharpEdges;
    const SectionId nodes = of_body ? SectionId::kBodySharpEdgeNodes : SectionId::kSharpEdgeNodes;
    const auto status_with = [&](auto change) {
      ImageParts image = whole;
      change(image.item<format::SharpEdge>(edges), image.item<format::Node>(nodes));
      return status_of(image);
    };
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    constexpr float kNoFloat = std::numeric_limits<float>::quiet_NaN();
    using Edge = format::SharpEdge;
    using Node = format::Node;
    EXPECT_EQ(status_with([](Edge&, Node&) {}), Status::kOk);
    ImageParts many = whole;
    many.set(edges, std::vector<Edge>(format::kMaxSharpEdges + 1, many.item<Edge>(edges)));
    EXPECT_EQ(status_of(many), Status::kImageLayout) << "more than any body may have";
    for (int end = 0; end < 2; ++end) {
      for (int axis = 0; axis < 3; ++axis) {
        for (const double x : {kNaN, 2e7, -2e7, 0.5}) {  // the last one lies outside of the node's sphere
          EXPECT_EQ(status_with([&](Edge& edge, Node&) { edge.end[end][axis] = x; }), Status::kImageValue) << x;
        }
        for (const float x : {kNoFloat, 1.1f, -1.1f}) {
          EXPECT_EQ(status_with([&](Edge& edge, Node&) { edge.normal[end][axis] = x; }), Status::kImageValue) << x;
        }
      }
    }
    for (const float radius : {kNoFloat, -1e-9f, 2e6f, 0.5f}) {
      EXPECT_EQ(status_with([&](Edge& edge, Node&) { edge.radius = radius; }), Status::kImageValue) << radius;
    }
    EXPECT_EQ(status_with([](Edge& edge, Node&) { edge.reserved = 1; }), Status::kImageValue);
    EXPECT_EQ(status_with([](Edge&, Node& node) { node.point_count = 2; }), Status::kImageValue);
    EXPECT_EQ(status_with([](Edge&, Node& node) { node.skip = 2; }), Status::kImageValue);
    EXPECT_EQ(status_with([](Edge&, Node& node) { node.leaf = 0; }), Status::kImageValue);
    EXPECT_EQ(status_with([](Edge&, Node& node) { node.center[0] += 1.0f; }), Status::kImageValue);
  }
  ImageParts far = whole;  // in the sphere of its node, not in that of the body
  far.item<format::SharpEdge>(SectionId::kBodySharpEdges).end[0][0] += 5.0;
  far.item<format::Node>(SectionId::kBodySharpEdgeNodes).radius = 10.0f;
  EXPECT_EQ(status_of(far), Status::kImageValue);
}

/// A tree over sharp edges may have a parent with one child. More nodes than twice the edges it cannot need.
TEST(SceneStructure, HasAtMostTwoNodesForASharpEdge) {
  for (const SectionId nodes : {SectionId::kSharpEdgeNodes, SectionId::kBodySharpEdgeNodes}) {
    ImageParts image = test::whole_image();
    const auto leaf = image.item<format::Node>(nodes);
    for (std::uint16_t count = 1; count <= 3; ++count) {  // a chain
      std::vector<format::Node> chain(count, leaf);
      for (std::uint16_t level = 0; level < count; ++level) {
        chain[level].skip = count;
        chain[level].level = level;
        chain[level].leaf = level + 1 == count ? 1 : 0;
      }
      image.set(nodes, chain);
      EXPECT_EQ(status_of(image), count <= 2 ? Status::kOk : Status::kImageLayout) << count;
    }
  }
}

TEST(SceneStructure, HasEverySectionOnce) {
  ImageParts image = test::whole_image();
  image[id_of(27)].resize(8);
  EXPECT_EQ(status_of(image), Status::kOk);
  image.rename(id_of(27), id_of(26));
  EXPECT_EQ(status_of(image), Status::kImageLayout);
}

format::Header& header_of(SceneImage& image) { return *reinterpret_cast<format::Header*>(image.bytes().data()); }

/// Writes the checksum of header and table alone.
void seal_header(SceneImage& image, std::uint32_t bytes) {
  header_of(image).checksum = 0;
  header_of(image).checksum = format::checksum(image.bytes().data(), bytes);
}

template <class Change>
Status status_with_header(Change change, bool sealed = true) {
  SceneImage image = test::whole_image().assemble();
  const std::uint32_t bytes = header_of(image).header_bytes;
  change(header_of(image));
  if (sealed) seal_header(image, bytes);
  return status_of(image.bytes());
}

TEST(SceneStructure, HasAHeaderWithoutAWrongByte) {
  for (int i = 0; i < 8; ++i) {
    EXPECT_EQ(status_with_header([i](format::Header& h) { h.magic[i] ^= 1; }), Status::kImageForeign) << i;
  }
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(status_with_header([i](format::Header& h) { h.reserved[i] = 1; }), Status::kImageLayout) << i;
    EXPECT_EQ(status_with_header([i](format::Header& h) { h.reserved[i] = ~0ull; }), Status::kImageLayout) << i;
  }
  for (const int by : {-64, -1, 1, 64}) {
    const auto add = [by](auto& x) {
      x = static_cast<std::remove_reference_t<decltype(x)>>(x + static_cast<std::uint64_t>(by));
    };
    EXPECT_EQ(status_with_header([=](format::Header& h) { add(h.header_bytes); }), Status::kImageLayout) << by;
    EXPECT_EQ(status_with_header([=](format::Header& h) { add(h.total_bytes); }), Status::kImageTruncated) << by;
    EXPECT_EQ(status_with_header([=](format::Header& h) { add(h.version); }), Status::kImageVersion) << by;
    EXPECT_EQ(status_with_header([=](format::Header& h) { add(h.byte_order); }), Status::kImageForeign) << by;
  }
  EXPECT_EQ(status_with_header([](format::Header& h) { h.checksum ^= 1; }, false), Status::kImageChecksum);
}

/// The header's own numbers decide before anything that they lead to is read, even the checksum.
TEST(SceneStructure, JudgesTheHeaderBeforeItUsesIt) {
  for (const std::uint32_t count : {0u, 32u, 0xffffffffu}) {
    const auto set = [count](format::Header& h) {
      h.section_count = count;
      h.header_bytes = static_cast<std::uint32_t>((64 + std::uint64_t{count} * 32 + 63) / 64 * 64);
    };
    EXPECT_EQ(status_with_header(set, false), Status::kImageLayout) << count;
  }
  // a table of 31 sections is read, and its checksum does not hold
  const auto set = [](format::Header& h) {
    h.section_count = 31;
    h.header_bytes = 1088;
  };
  EXPECT_EQ(status_with_header(set, false), Status::kImageChecksum);
  // a table of 32 is not read, although its first section's checksum does not hold
  SceneImage many = test::whole_image().assemble();
  header_of(many).section_count = 32;
  header_of(many).header_bytes = 1088;
  reinterpret_cast<format::Section*>(many.bytes().data() + 64)->offset = 1088;
  seal_header(many, 1088);
  EXPECT_EQ(status_of(many.bytes()), Status::kImageLayout);
  EXPECT_EQ(status_of(std::span<const std::byte>()), Status::kImageTruncated);
  // a file that ends in its table
  for (const std::uint32_t count : {1u, 2u, 3u, 4u}) {
    SceneImage image(64);
    std::ranges::copy(test::whole_image().assemble().bytes().first(64), image.bytes().begin());
    format::Header& header = header_of(image);
    header.section_count = count;
    header.header_bytes = count <= 2 ? 128 : 192;
    header.total_bytes = 64;
    EXPECT_EQ(status_of(image.bytes()), Status::kImageTruncated) << count;
  }
}

TEST(SceneStructure, HasNoGapAfterItsTable) {
  const SceneImage whole = test::whole_image().assemble();
  SceneImage image(whole.bytes().size() + 64);
  const std::size_t head = reinterpret_cast<const format::Header*>(whole.bytes().data())->header_bytes;
  std::ranges::copy(whole.bytes().first(head), image.bytes().begin());
  std::ranges::copy(whole.bytes().subspan(head), image.bytes().begin() + static_cast<std::ptrdiff_t>(head) + 64);
  header_of(image).header_bytes += 64;
  header_of(image).total_bytes += 64;
  auto* sections = reinterpret_cast<format::Section*>(image.bytes().data() + 64);
  for (std::size_t i = 0; i < kSectionCount; ++i) sections[i].offset += 64;
  seal_header(image, header_of(image).header_bytes);
  EXPECT_EQ(status_of(image.bytes()), Status::kImageLayout);
}

/// The least files: a header alone, and one with a section without bytes.
TEST(SceneStructure, IsMoreThanAHeader) {
  SceneImage image(128);
  std::ranges::copy(test::whole_image().assemble().bytes().first(64), image.bytes().begin());
  format::Header& header = header_of(image);
  header.section_count = 0;
  header.header_bytes = 64;
  header.total_bytes = 64;
  seal_header(image, 64);
  EXPECT_EQ(status_of(image.bytes().first(64)), Status::kImageLayout);
  header.section_count = 1;
  header.header_bytes = 128;
  header.total_bytes = 128;
  *reinterpret_cast<format::Section*>(image.bytes().data() + 64) = {id_of(21), 0, 128, 0, format::kChecksumSeed};
  seal_header(image, 128);
  EXPECT_EQ(status_of(image.bytes()), Status::kImageLayout);
}

/// Returns the table of an image.
std::span<format::Section> table_of(SceneImage& image) {
  auto* first = reinterpret_cast<format::Section*>(image.bytes().data() + sizeof(format::Header));
  return {first, header_of(image).section_count};
}

TEST(SceneStructure, HasNoHoleAndNoOverlap) {
  const SceneImage whole = test::whole_image().assemble();
  for (std::size_t i = 0; i < kSectionCount; ++i) {
    const auto status_with = [&](auto change, bool sealed_section = false) {
      SceneImage image = whole;
      format::Section& section = table_of(image)[i];
      change(section);
      if (sealed_section) {
        section.checksum = format::checksum(image.bytes().data() + section.offset, (section.bytes + 63) / 64 * 64);
      }
      seal_header(image, header_of(image).header_bytes);
      return status_of(image.bytes());
    };
    for (const std::uint64_t by : {std::uint64_t{1}, std::uint64_t{64}, ~std::uint64_t{0}, ~std::uint64_t{63}}) {
      EXPECT_EQ(status_with([by](format::Section& s) { s.offset += by; }), Status::kImageLayout) << i << " by " << by;
    }
    EXPECT_EQ(status_with([](format::Section& s) { s.reserved = 1; }), Status::kImageLayout) << i;
    EXPECT_EQ(status_with([](format::Section& s) { s.checksum ^= 1; }), Status::kImageChecksum) << i;
    EXPECT_EQ(status_with([&](format::Section& s) { s.bytes = whole.bytes().size() - s.offset + 1; }),
              Status::kImageLayout)
        << i;
    EXPECT_EQ(status_with([](format::Section& s) { s.bytes = ~0ull; }), Status::kImageLayout) << i;
    EXPECT_EQ(status_with([](format::Section& s) { s.bytes = ~0ull - 63; }), Status::kImageLayout) << i;
    // to the end of the file, so that the next section begins within
    if (i + 1 == kSectionCount) continue;
    EXPECT_EQ(status_with([&](format::Section& s) { s.bytes = whole.bytes().size() - s.offset; }, true),
              Status::kImageLayout)
        << i;
  }
}

/// A file that ends without the last section's padding, and one with bytes after it.
TEST(SceneStructure, EndsWithItsLastSection) {
  ImageParts parts = test::whole_image();
  parts.leave_out(SectionId::kProvenance);
  parts[SectionId::kProvenance].resize(65);
  const SceneImage whole = parts.assemble();
  for (const int by : {-63, -62, -1, 0, 1, 10, 64}) {
    const std::size_t bytes = whole.bytes().size() + static_cast<std::size_t>(by);
    SceneImage room(whole.bytes().size() + 128);
    std::ranges::fill(room.bytes(), std::byte{0xff});  // nothing after the end counts
    std::ranges::copy(whole.bytes().first(std::min(whole.bytes().size(), bytes)), room.bytes().begin());
    header_of(room).total_bytes = bytes;
    seal_header(room, header_of(room).header_bytes);
    EXPECT_EQ(status_of(room.bytes().first(bytes)), by == 0 ? Status::kOk : Status::kImageLayout) << by;
  }
}

/// In a tree the number of nodes, their order and their points fix every whole number.
TEST(SceneStructure, OfATreeHasNoOtherNumbers) {
  const ImageParts whole = test::whole_image();
  for (const SectionId id : {SectionId::kNodes, SectionId::kFeatureNodes}) {
    constexpr std::size_t count = 7;
    ASSERT_EQ(ImageParts(whole).count<format::Node>(id), count);
    const auto expect_refused = [&](std::size_t i, auto change, const char* what) {
      ImageParts image = whole;
      change(image.item<format::Node>(id, i));
      EXPECT_EQ(status_of(image), Status::kImageValue) << what << " of node " << i;
    };
    for (std::size_t i = 0; i < count; ++i) {
      for (std::uint32_t bit = 0; bit < 32; ++bit) {
        const std::uint32_t mask = 1u << bit;
        expect_refused(
            i, [=](format::Node& n) { n.skip ^= mask; }, "skip");
        expect_refused(
            i, [=](format::Node& n) { n.first_point ^= mask; }, "first point");
        expect_refused(
            i, [=](format::Node& n) { n.point_count ^= mask; }, "points");
        if (bit >= 16) continue;
        expect_refused(
            i, [=](format::Node& n) { n.level = static_cast<std::uint16_t>(n.level ^ mask); }, "level");
        expect_refused(
            i, [=](format::Node& n) { n.leaf = static_cast<std::uint16_t>(n.leaf ^ mask); }, "leaf");
      }
      for (const std::uint32_t by : {1u, 2u, 3u, 0u - 1u, 0u - 2u, 0u - 3u}) {
        expect_refused(
            i, [=](format::Node& n) { n.skip += by; }, "skip");
        expect_refused(
            i, [=](format::Node& n) { n.first_point += by; }, "first point");
        expect_refused(
            i, [=](format::Node& n) { n.point_count += by; }, "points");
      }
    }
  }
}

/// A tree whose numbers fit each other, but which begins at the second point and so ends behind the last one. The
/// spheres hold any point.
TEST(SceneStructure, OfATreeBeginsAtTheFirstPoint) {
  const test::SurfaceSamples one_point{{Vector3(0.5, 0.0, 0.0)}, {Vector3::UnitX()}};
  for (const ImageParts& whole : {test::whole_image(), test::whole_image(one_point)}) {
    for (const SectionId id : {SectionId::kNodes, SectionId::kFeatureNodes}) {
      for (const std::uint32_t first : {0u, 1u}) {
        ImageParts image = whole;
        for (std::size_t i = 0; i < image.count<format::Node>(id); ++i) {
          auto& node = image.item<format::Node>(id, i);
          node.first_point += first;
          node.radius = 1e7f;
        }
        EXPECT_EQ(status_of(image), first == 0 ? Status::kOk : Status::kImageValue) << static_cast<int>(id);
      }
    }
  }
}

/// Sets a tree of `depth` nodes, each the only child of the one before, over the points of `image`.
void set_chain(ImageParts& image, std::uint32_t depth, std::uint32_t levels) {
  const format::Node root = image.item<format::Node>(SectionId::kNodes);
  std::vector<format::Node> nodes;
  for (std::uint32_t i = 0; i < depth; ++i) {
    format::Node& node = nodes.emplace_back(root);
    node.skip = depth;
    node.level = static_cast<std::uint16_t>(i);
    node.leaf = i + 1 == depth ? 1 : 0;
  }
  image.set(SectionId::kNodes, nodes);
  auto& body = image.item<format::Body>(SectionId::kBody);
  body.node_count = depth;
  body.level_count = levels;
}

TEST(SceneStructure, OfATreeHasAsManyLevelsAsItSays) {
  for (std::uint32_t depth = 1; depth <= format::kMaxLevels; ++depth) {
    ImageParts image = test::whole_image();
    set_chain(image, depth, depth);
    EXPECT_EQ(status_of(image), Status::kOk) << depth;
    if (depth > 1) {
      set_chain(image, depth, depth - 1);
      EXPECT_EQ(status_of(image), Status::kImageValue) << depth;
    }
  }
  ImageParts image = test::whole_image();
  set_chain(image, format::kMaxLevels + 1, format::kMaxLevels);
  EXPECT_EQ(status_of(image), Status::kImageValue);
}

/// Reads a tree by its definition: a node's children follow it, one after the other, up to its `skip`.
class TreeReader {
 public:
  TreeReader(std::span<const format::Node> nodes, std::uint32_t levels) : nodes_(nodes), levels_(levels) {}

  /// Tells whether the nodes are one tree of these points.
  bool is_tree(std::uint32_t points) const {
    return is_subtree(0, 0, 0) && nodes_[0].skip == nodes_.size() && nodes_[0].point_count == points;
  }

 private:
  bool is_subtree(std::size_t at, std::uint32_t depth, std::uint32_t first_point) const {
    if (at >= nodes_.size() || depth >= levels_) return false;
    const format::Node& node = nodes_[at];
    if (node.level != depth || node.first_point != first_point || node.point_count == 0) return false;
    if (node.leaf == 1) return node.skip == at + 1;
    if (node.leaf != 0) return false;
    std::uint64_t points = 0;
    std::size_t child = at + 1;
    do {
      if (!is_subtree(child, depth + 1, static_cast<std::uint32_t>(first_point + points))) return false;
      points += nodes_[child].point_count;
      child = nodes_[child].skip;
    } while (child < node.skip);
    return child == node.skip && points == node.point_count;
  }

  std::span<const format::Node> nodes_;
  std::uint32_t levels_;
};

/// Appends a random subtree of these points.
void grow(std::vector<format::Node>& nodes, std::uint32_t first, std::uint32_t count, std::uint16_t level,
          test::Random& random) {
  const std::size_t own = nodes.size();
  format::Node& node = nodes.emplace_back();
  node.radius = 1.0f;
  node.first_point = first;
  node.point_count = count;
  node.level = level;
  node.leaf = level == 3 || random.integer(0, 3) == 0 ? 1 : 0;
  const bool is_leaf = node.leaf != 0;
  for (std::uint32_t next = first; !is_leaf && next < first + count;) {
    const auto most = static_cast<int>(first + count - next);
    const auto share = static_cast<std::uint32_t>(random.integer(1, most));
    grow(nodes, next, share, static_cast<std::uint16_t>(level + 1), random);
    next += share;
  }
  nodes[own].skip = static_cast<std::uint32_t>(nodes.size());
}

/// Changes one whole number of a node by a little, or to that of another node.
void damage(std::vector<format::Node>& nodes, test::Random& random) {
  const auto any = [&] { return static_cast<std::size_t>(random.integer(0, static_cast<int>(nodes.size()) - 1)); };
  format::Node& node = nodes[any()];
  const format::Node other = nodes[any()];
  const auto by = static_cast<std::uint32_t>(random.integer(-2, 2));
  switch (random.integer(0, 7)) {
    case 0: node.skip += by; break;
    case 1: node.first_point += by; break;
    case 2: node.point_count += by; break;
    case 3: node.leaf ^= 1; break;
    case 4: node.level = static_cast<std::uint16_t>(node.level + by); break;
    case 5: node.skip = other.skip; break;
    case 6: node.first_point = other.first_point; break;
    default: node.point_count = other.point_count; break;
  }
}

TEST(SceneStructure, OfATreeIsAsItsDefinitionReadsIt) {
  const test::SurfaceSamples samples{std::vector<Vector3>(12, Vector3(0.5, 0.0, 0.0)),
                                     std::vector<Vector3>(12, Vector3::UnitX())};
  ImageParts image = test::whole_image(samples);
  test::Random random(1);
  int valid = 0, spoiled = 0;
  for (int i = 0; i < 3000; ++i) {
    std::vector<format::Node> nodes;
    grow(nodes, 0, 12, 0, random);
    if (nodes.size() > 24) continue;  // a tree has at most two nodes a point
    for (int changes = random.integer(0, 4); changes > 0; --changes) damage(nodes, random);
    image.set(SectionId::kNodes, nodes);
    auto& body = image.item<format::Body>(SectionId::kBody);
    body.node_count = static_cast<std::uint32_t>(nodes.size());
    body.level_count = static_cast<std::uint32_t>(random.integer(2, 5));
    const bool is_tree = TreeReader(nodes, body.level_count).is_tree(12);
    ASSERT_EQ(status_of(image), is_tree ? Status::kOk : Status::kImageValue) << "tree " << i;
    ++(is_tree ? valid : spoiled);
  }
  EXPECT_GT(valid, 200);
  EXPECT_GT(spoiled, 200);
}

/// Numbers of points whose sum overflows to the parent's.
TEST(SceneStructure, OfATreeCountsPointsWithoutOverflow) {
  ImageParts image = test::whole_image();
  ASSERT_EQ(status_of(image), Status::kOk);
  auto& first = image.item<format::Node>(SectionId::kNodes, 2);
  auto& second = image.item<format::Node>(SectionId::kNodes, 3);
  const std::uint32_t both = first.point_count + second.point_count;
  for (const std::uint32_t points : {0xfffffff0u, 0x80000000u, both + 1}) {
    first.point_count = points;
    second.first_point = points;
    second.point_count = both - points;
    EXPECT_EQ(status_of(image), Status::kImageValue) << points;
  }
  first.radius = second.radius = 1.0f;  // no sphere is too small
  for (const std::uint32_t points : {0u, 1u, both - 1, both}) {
    first.point_count = points;
    second.first_point = points;
    second.point_count = both - points;
    EXPECT_EQ(status_of(image), points == 0 || points == both ? Status::kImageValue : Status::kOk) << points;
  }
}

TEST(SceneStructure, OfATreeEndsWithALeaf) {
  ImageParts image = test::whole_image();
  auto& last = image.item<format::Node>(SectionId::kNodes, 6);
  last.skip = 6;
  last.leaf = 0;
  EXPECT_EQ(status_of(image), Status::kImageValue);
}

/// Returns parts of a ball whose refinements are nested and have coarse octants; no second direction.
ImageParts refined_image(bool exact) {
  test::SceneDescription description;
  description.distance = [](const Vector3& p) { return test::ball_distance(p, 0.01); };
  description.surface_min = Vector3::Constant(-0.01);
  description.surface_max = Vector3::Constant(0.05);  // so that some positions are far
  description.voxel_size = 0.01;
  description.band = 0.01;
  description.settings.safety_distance = 0.005;
  description.points = {Vector3(0.01, 0.0, 0.0)};
  const Vector3 low = Vector3::Constant(-0.03);
  description.refined = [low](const Vector3& center, double edge) {
    const Vector3 from = center - low - Vector3::Constant(0.5 * edge);
    if (edge > 0.03) return from.norm() < 0.05;
    return from.norm() < 0.005 || (edge > 0.015 && (from - Vector3::Constant(0.02)).norm() < 0.005);
  };
  description.coarse = [low](const Vector3& center, double edge) {
    return (center - low).x() > 1.2 * edge && (center - low).y() > 0.7 * edge;
  };
  if (exact) description.facet = test::facet_along_z();
  return ImageParts(test::build_scene_image(description));
}

/// Reads index and refinements by their definition in core/scene/format.h.
class EntryReader {
 public:
  explicit EntryReader(ImageParts& image) : image_(image) {}

  bool is_valid() {
    const std::size_t positions = image_.count<std::uint32_t>(SectionId::kBrickIndex);
    for (std::size_t i = 0; i < positions; ++i) {
      if (!is_position(image_.item<std::uint32_t>(SectionId::kBrickIndex, i))) return false;
    }
    return refined_ == image_.count<format::Refined>(SectionId::kRefined) && named_ == brick_count();
  }

 private:
  static bool bit(std::uint32_t entry, int number) { return (entry >> number & 1) != 0; }
  std::size_t brick_count() { return image_.count<format::Brick>(SectionId::kBricks); }

  bool is_position(std::uint32_t entry) {
    if (!bit(entry, 31)) return is_stored(entry, 0);
    const float clearance = std::bit_cast<float>((entry & 0x3fffffffu) << 1);
    return clearance <= 1e8f;
  }
  bool is_stored(std::uint32_t entry, int depth) {
    const std::uint32_t number = entry & 0x0fffffffu;
    if (bit(entry, 30)) return false;
    if (!bit(entry, 29)) return names(number, bit(entry, 28));
    if (bit(entry, 28) || number != refined_ || depth == 4) return false;
    if (number >= image_.count<format::Refined>(SectionId::kRefined)) return false;
    ++refined_;
    return is_refinement(image_.item<format::Refined>(SectionId::kRefined, number), depth);
  }
  bool is_refinement(const format::Refined& refined, int depth) {
    int coarse = 0, edged = 0;
    for (const std::uint32_t child : refined.child) {
      if (!bit(child, 31)) continue;
      if (child != 0x80000000u && child != 0x90000000u) return false;
      ++coarse;
      edged += child == 0x90000000u;
    }
    if (edged != 0 && edged != coarse) return false;
    const bool own = depth == 0 || coarse > 0;
    if (own ? !names(refined.brick, edged > 0) : refined.brick != 0xffffffffu) return false;
    for (const std::uint32_t child : refined.child) {
      if (!bit(child, 31) && !is_stored(child, depth + 1)) return false;
    }
    return true;
  }
  bool names(std::uint32_t number, bool exact) {
    ++named_;
    return number < brick_count() && (image_.item<format::Brick>(SectionId::kBricks, number).exact != 0) == exact;
  }

  ImageParts& image_;
  std::size_t refined_ = 0, named_ = 0;
};

/// Returns a random word of the index or of the refinements.
std::uint32_t& any_word(ImageParts& image, test::Random& random) {
  const auto index = static_cast<int>(image.count<std::uint32_t>(SectionId::kBrickIndex));
  const auto refined = static_cast<int>(image.count<std::uint32_t>(SectionId::kRefined));
  const int word = random.integer(0, index + refined - 1);
  return word < index ? image.item<std::uint32_t>(SectionId::kBrickIndex, static_cast<std::size_t>(word))
                      : image.item<std::uint32_t>(SectionId::kRefined, static_cast<std::size_t>(word - index));
}

TEST(SceneStructure, OfRefinementsIsAsTheirDefinitionReadsIt) {
  test::Random random(2);
  int valid = 0, spoiled = 0;
  for (const bool edged : {false, true}) {
    const ImageParts whole = refined_image(edged);
    ASSERT_EQ(status_of(whole), Status::kOk);
    for (int i = 0; i < 1200; ++i) {
      ImageParts image = whole;
      for (int changes = random.integer(0, 2); changes > 0; --changes) {
        std::uint32_t& word = any_word(image, random);
        std::uint32_t& other = any_word(image, random);
        switch (random.integer(0, 3)) {
          case 0: word ^= 1u << random.integer(28, 31); break;
          case 1: word ^= 1u << random.integer(0, 27); break;
          case 2: std::swap(word, other); break;
          default: word = other; break;
        }
      }
      const bool is_valid = EntryReader(image).is_valid();
      ASSERT_EQ(status_of(image), is_valid ? Status::kOk : Status::kImageValue) << "image " << i;
      ++(is_valid ? valid : spoiled);
    }
  }
  EXPECT_GT(valid, 200);
  EXPECT_GT(spoiled, 200);
}

}  // namespace
}  // namespace godobject
