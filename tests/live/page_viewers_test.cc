#include "toolchain/live/page_viewers.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/live/live_scene.h"
#include "tests/support/folder_test.h"

namespace godobject::live::page_viewers_test {
namespace {

using nlohmann::json;

/// Obeys all requests but a reset.
class SourceStub final : public LiveSource {
 public:
  explicit SourceStub(const firmware::ControllerConfig& config)
      : placement_(firmware::place(config.workspace, config.device, scene_.H_MB.translation)) {}

  const SceneView& scene() const override { return scene_; }
  const firmware::Placement* placement() const override { return &placement_; }
  void take(std::vector<LiveSample>&) override {}
  std::optional<LiveSettings> settings() const override { return {}; }
  double speed() const override { return 1.0; }
  std::uint64_t lost() const override { return 0; }
  std::string failure() const override { return ""; }
  std::string answer(const Request& request) override {
    if (std::holds_alternative<HandRequest>(request)) ++moves;
    return std::holds_alternative<ResetRequest>(request) ? "not now" : "";
  }

  int moves = 0;

 private:
  const test::SceneImage image_ = test::ball_over_plate();
  const SceneView scene_ = test::open_scene(image_);
  const firmware::Placement placement_;
};

/// A clock that a test sets.
class SetClock final : public hal::Clock {
 public:
  std::int64_t now_ns() noexcept override { return now; }
  void sleep_until(std::int64_t) noexcept override {}
  std::int64_t now = 0;
};

class PageViewersTest : public test::FolderTest {
 protected:
  /// Returns the answer to a message; null: none.
  json answer(ViewerNumber viewer, const std::string& message) {
    const auto answers = viewers_.received(viewer, message, false);
    EXPECT_TRUE(answers.has_value());
    return answers->empty() ? json() : json::parse(answers->at(0).head);
  }

  /// Returns who has the hand, as a viewer sees it.
  std::string hand(ViewerNumber viewer) {
    viewers_.add({});
    viewers_.make_state(3);
    const json state = json::parse(viewers_.state(viewer).at(0).head);
    EXPECT_EQ(state["viewers"], 3);
    return state["hand"];
  }

  const std::string move_ = R"({"type":"hand","pose":[0,0,0,1,0,0,0]})";
  SourceStub source_{ball_in_hand(folder_)};
  SetClock clock_;
  PageViewers viewers_{source_, clock_};
};

/// A page that vanishes silently loses the hand.
TEST_F(PageViewersTest, TakesTheHandFromASilentPage) {
  answer(1, move_);
  clock_.now += PageViewers::kPatience_ns - 1;
  EXPECT_EQ(hand(1), "yours");
  answer(1, move_);
  clock_.now += PageViewers::kPatience_ns - 1;
  EXPECT_EQ(hand(1), "yours");
  clock_.now += 2;
  EXPECT_EQ(hand(1), "free");
}

/// Also while no cycles come.
TEST_F(PageViewersTest, ShowsTheLastStateToANewPage) {
  EXPECT_TRUE(viewers_.joined(1).empty()) << "nothing is known yet";
  LiveSample sample;
  sample.mode = "stopped";
  viewers_.add(sample);
  viewers_.make_state(1);
  const ServerMessages first = viewers_.joined(2);
  ASSERT_EQ(first.size(), 1u);
  EXPECT_EQ(json::parse(first.at(0).head)["mode"], "stopped");
}

TEST_F(PageViewersTest, GivesTheHandToOneAtATime) {
  EXPECT_EQ(hand(1), "free");
  EXPECT_TRUE(answer(1, move_).is_null());
  EXPECT_EQ(hand(1), "yours");
  EXPECT_EQ(hand(2), "other");
  EXPECT_EQ(answer(2, move_)["text"], "another viewer has the hand");
  EXPECT_EQ(source_.moves, 1);
  EXPECT_EQ(answer(1, R"({"type":"release"})")["ok"], true);
  EXPECT_TRUE(answer(2, move_).is_null());
  viewers_.left(1);
  EXPECT_EQ(hand(2), "yours");
  viewers_.left(2);
  EXPECT_EQ(hand(1), "free");
}

TEST_F(PageViewersTest, SaysWhyItDoesNot) {
  EXPECT_EQ(answer(1, R"({"type":"reset"})"), (json{{"type", "answer"}, {"ok", false}, {"text", "not now"}}));
  EXPECT_EQ(answer(1, "rubbish")["ok"], false);
  EXPECT_FALSE(viewers_.received(1, move_, true).has_value()) << "a page sends no binary messages";
  EXPECT_EQ(source_.moves, 0);
}

}  // namespace
}  // namespace godobject::live::page_viewers_test
