#include "toolchain/page/replay_page.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <string_view>

#include "tests/page/page_reader.h"
#include "tests/page/page_scene.h"
#include "toolchain/page/compressed_text.h"

namespace godobject::page {
namespace {

constexpr std::string_view kPlayer = "console.log('player');";

/// Returns the text between two words of a page.
std::string between(const std::string& page, const std::string& begin, const std::string& end) {
  const std::size_t from = page.find(begin);
  if (from == std::string::npos) return "";
  const std::size_t start = from + begin.size();
  return page.substr(start, page.find(end, start) - start);
}

std::size_t count(std::string_view text, std::string_view word) {
  std::size_t found = 0;
  for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) ++found;
  return found;
}

TEST(CompressedText, IsBase64OfAZlibStream) {
  for (const std::string& bytes : {std::string(), std::string("a"), std::string("ab\0\xff", 4), std::string(5000, 'x')})
    EXPECT_EQ(inflated(compressed_text(bytes)), bytes);
}

TEST(ReplayPage, HoldsDataAndPlayer) {
  const PageScene scene = sliding_scene(100);
  const std::string page = replay_page(scene, "A box", kPlayer);
  const std::string data = between(page, "id=\"replay-data\">", "</script>");
  EXPECT_EQ(inflated(data), page_data(scene));
  EXPECT_NE(page.find("<script>console.log('player');</script>"), std::string::npos);
  EXPECT_EQ(between(page, "<title>", "</title>"), "A box");
  EXPECT_EQ(between(page, "<h1>", "</h1>"), "A box");
}

TEST(ReplayPage, LoadsNothing) {
  const std::string page = replay_page(sliding_scene(3), "A box", kPlayer);
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
  for (const std::string_view word : {"http:", "https:", " src=", "@import", "url("})
    EXPECT_EQ(count(page, word), 0u) << word;
}

TEST(ReplayPage, EscapesTheTitle) {
  const std::string page = replay_page(sliding_scene(3), "a</title><script>alert(1)</script> & \"b\" {0}", kPlayer);
  EXPECT_EQ(between(page, "<title>", "</title>"),
            "a&lt;/title&gt;&lt;script&gt;alert(1)&lt;/script&gt; &amp; &quot;b&quot; {0}");
}

TEST(ReplayPage, KeepsTheScriptInItsElement) {
  const std::string page =
      replay_page(sliding_scene(3), "A box", "a='</script>';b=`</SCRIPT`;c='<!--<script>';d='</p>'");
  EXPECT_NE(page.find("a='<\\/script>';b=`<\\/SCRIPT`;c='<\\!--<script>';d='</p>'</script>"), std::string::npos);
  EXPECT_EQ(count(page, "</script>"), 2u);
}

TEST(ReplayPage, KeepsNamesOfAnyKindInTheData) {
  PageScene scene = sliding_scene(3);
  scene.replays[0].name = "</script><b>\"\\ \xc3\xa9";
  scene.moving_name = "\xff not UTF-8";
  const std::string page = replay_page(scene, "A box", kPlayer);
  const PageReader reader(inflated(between(page, "id=\"replay-data\">", "</script>")));
  EXPECT_EQ(reader.header().at("replays").at(0).at("name"), scene.replays[0].name);
}

TEST(ReplayPage, SaysWhatIsToBeSeen) {
  PageScene scene = sliding_scene(3);
  EXPECT_NE(replay_page(scene, "", kPlayer).find("<p class=\"lead\">The translucent body follows a hand"),
            std::string::npos);
  scene.replays.push_back(scene.replays.front());
  EXPECT_NE(replay_page(scene, "", kPlayer).find("<p class=\"lead\">Each picture shows another replay"),
            std::string::npos);
}

TEST(ReplayPage, OfAMinuteOfShakyMotionIsSmallEnoughToSend) {
  PageScene scene = sliding_scene(60000);
  scene.replays.push_back({"paper", scene.replays[0].log});
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 1.0);
  for (auto& row : scene.replays[1].log) {
    row.H_WS.translation += 1e-4 * Vector3(noise(random), noise(random), noise(random));
    row.wrench.force += 0.2 * Vector3(noise(random), noise(random), noise(random));
    row.depth += 1e-5 * noise(random);
    row.solve_ns *= std::exp(noise(random));
  }
  EXPECT_LT(replay_page(scene, "A box", kPlayer).size() + 700'000, 10'000'000u);  // and a player of 0.7 MB
}

}  // namespace
}  // namespace godobject::page
