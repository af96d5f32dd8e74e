#include "toolchain/live/live_server.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <set>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "tests/live/page_client.h"
#include "toolchain/command_line/failure.h"
#include "toolchain/live/request.h"

namespace godobject::live::live_server_test {
namespace {

/// Answers "hello" and shows the number of the server's tick.
class PageStub final : public ViewerProtocol {
 public:
  ServerMessages joined(ViewerNumber) override { return {}; }
  std::optional<ServerMessages> received(ViewerNumber, std::string_view message, bool binary) override {
    if (binary) return {};
    ++messages;
    return message == "hello" ? ServerMessages{{"hello, too"}} : ServerMessages{};
  }
  ServerMessages state(ViewerNumber viewer) override {
    if (viewer == 1) ++states_of_first;
    return {{fmt::format("{:{}}", ticks.load(), width.load())}};
  }
  void left(ViewerNumber viewer) override {
    last_left = viewer;
    ++left_count;
  }

  std::atomic<ViewerNumber> last_left{0};
  std::atomic<int> ticks{0}, width{1}, messages{0}, left_count{0}, states_of_first{0};
};

/// Greets, answers each message by a text, and shows a binary message that all viewers share.
class FoxgloveStub final : public ViewerProtocol {
 public:
  ServerMessages joined(ViewerNumber) override { return {{"welcome"}, {"channels"}}; }
  std::optional<ServerMessages> received(ViewerNumber, std::string_view, bool binary) override {
    ++messages;
    return ServerMessages{{binary ? "no data" : "no such message"}};
  }
  ServerMessages state(ViewerNumber viewer) override {
    if (viewer == 1) ++states_of_first;
    return {{fmt::format("to {}: ", viewer), shared, true}};
  }
  void left(ViewerNumber) override {}

  std::atomic<int> messages{0}, states_of_first{0};
  const std::shared_ptr<const std::string> shared = std::make_shared<const std::string>(300'000, 'x');
};

/// A server on a thread of its own.
class LiveServerTest : public testing::Test {
 protected:
  LiveServerTest() { begin(20'000'000); }

  void begin(std::int64_t stalled_us) {
    server_.emplace(LiveServer::Setup{.address = "127.0.0.1",
                                      .port = 0,
                                      .page = "<p>@HOST@</p>" + std::string(200'000, 'x'),
                                      .token = "secret",
                                      .stalled_us = stalled_us},
                    LiveServer::Protocols{pages_, foxglove_});
    thread_ = std::jthread([this] { server_->run(1000, [this] { return tick(); }); });
  }
  ~LiveServerTest() override { stop(); }

  bool tick() {
    ++pages_.ticks;
    viewers_ = server_->viewers();
    if (publishes_) server_->publish();
    return !end_;
  }

  /// Ends the server, which closes all connections.
  void stop() {
    end_ = true;
    if (thread_.joinable()) thread_.join();
    server_.reset();
  }

  int port() const { return server_->port(); }

  /// Waits until the server has done `count` more ticks.
  void wait_ticks(int count) const {
    const int until = pages_.ticks + count;
    while (pages_.ticks < until) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  PageStub pages_;
  FoxgloveStub foxglove_;
  std::atomic<std::size_t> viewers_{0};
  std::atomic<bool> publishes_{false}, end_{false};
  std::optional<LiveServer> server_;
  std::jthread thread_;
};

TEST_F(LiveServerTest, GivesThePageToWhoHasTheToken) {
  PageClient client(port());
  ASSERT_TRUE(client.connected());
  const std::string head = client.get("/?token=secret", "Connection: close\r\n");
  EXPECT_TRUE(head.starts_with("HTTP/1.1 200")) << head;
  for (const char* line : {"content-type: text/html", "cache-control: no-store", "referrer-policy: no-referrer",
                           "x-frame-options: DENY", "x-content-type-options: nosniff"}) {
    EXPECT_NE(head.find(line), std::string::npos) << line << " is not in " << head;
  }
  const std::string page = "<p>127.0.0.1:1</p>" + std::string(200'000, 'x');
  EXPECT_EQ(client.drain(page.size()), page.size());
}

TEST_F(LiveServerTest, GivesNothingToOthers) {
  for (const char* path : {"/", "/?token=", "/?token=Secret", "/?token=secret2", "/?token=secre", "/?x=secret"}) {
    PageClient client(port());
    EXPECT_TRUE(client.get(path).starts_with("HTTP/1.1 403")) << path;
  }
  for (const char* path : {"/index.html?token=secret", "/../etc/passwd?token=secret", "/socket?token=secret"}) {
    PageClient client(port());
    const std::string head = client.get(path);
    EXPECT_FALSE(head.starts_with("HTTP/1.1 2")) << path << ": " << head;
  }
}

/// A name that leads here although it is not ours, and characters that would end a header or a policy.
TEST_F(LiveServerTest, GivesNothingToOtherNames) {
  for (const char* host : {"localhost", "localhost:1", "127.0.0.1", "192.168.0.7:8642"}) {
    EXPECT_TRUE(PageClient(port()).get("/?token=secret", "", host).starts_with("HTTP/1.1 200")) << host;
  }
  for (const char* host : {"evil.example", "evil.example:1", "127.0.0.1.evil", "127.0.0.1:1;x", "127.0.0.1 *", "'self'",
                           "localhost:x", "localhost:", ":1", "127.0.0.1:123456"}) {
    EXPECT_TRUE(PageClient(port()).get("/?token=secret", "", host).starts_with("HTTP/1.1 403")) << host;
  }
}

TEST_F(LiveServerTest, GoesOnAfterARefusal) {
  PageClient client(port());
  const std::string head = client.get("/");
  ASSERT_TRUE(head.starts_with("HTTP/1.1 403"));
  const std::size_t at = head.find("content-length: ");
  ASSERT_NE(at, std::string::npos) << head;
  client.skip(static_cast<std::size_t>(std::stoi(head.substr(at + 16))));
  EXPECT_TRUE(client.get("/?token=secret").starts_with("HTTP/1.1 200"));
}

/// Browsers send the cookies of all ports of a host.
TEST_F(LiveServerTest, ReadsLongHeaders) {
  const std::string cookies = "Cookie: a=" + std::string(9000, 'x') + "\r\n";
  EXPECT_TRUE(PageClient(port()).get("/?token=secret", cookies).starts_with("HTTP/1.1 200"));
}

/// HTTP/2 without a token: two requests without an end, then data of both, which stopped the process once.
TEST_F(LiveServerTest, SpeaksNoOtherVersionOfHttp) {
  const auto frame = [](const std::string& payload, char type, char flags, char stream) {
    std::string text(9, '\0');
    text[2] = static_cast<char>(payload.size());
    text[3] = type;
    text[4] = flags;
    text[8] = stream;
    return text + payload;
  };
  const auto literal = [](const std::string& name, const std::string& value) {
    return std::string(1, '\0') + static_cast<char>(name.size()) + name + static_cast<char>(value.size()) + value;
  };
  const std::string request = "\x82\x86" + literal(":path", "/abc") + literal(":authority", "127.0.0.1");  // GET, http
  for (int trial = 0; trial < 5; ++trial) {
    PageClient client(port());
    const std::string head = client.get("/?token=bad",
                                        "Connection: Upgrade, HTTP2-Settings\r\nUpgrade: h2c\r\n"
                                        "HTTP2-Settings: AAMAAABkAARAAAAAAAIAAAAA\r\n");
    EXPECT_FALSE(head.starts_with("HTTP/1.1 101")) << head;
    client.send("PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n" + frame("", 4, 0, 0));
    for (const char stream : {'\3', '\5'}) client.send(frame(request, 1, 4, stream));
    for (const char stream : {'\3', '\5'}) client.send(frame(std::string(100, 'x'), 0, 0, stream));
    wait_ticks(50);
  }
  EXPECT_EQ(PageClient(port()).open("secret"), "HTTP/1.1 101 Switching Protocols");
}

TEST_F(LiveServerTest, OpensASocketOnlyWithTokenAndOwnOrigin) {
  EXPECT_EQ(PageClient(port()).open("secret"), "HTTP/1.1 101 Switching Protocols");
  EXPECT_NE(PageClient(port()).open("guess"), "HTTP/1.1 101 Switching Protocols");
  EXPECT_NE(PageClient(port()).open(""), "HTTP/1.1 101 Switching Protocols");
  EXPECT_NE(PageClient(port()).open("secret", "http://evil.example"), "HTTP/1.1 101 Switching Protocols");
  EXPECT_NE(PageClient(port()).open("secret", "null"), "HTTP/1.1 101 Switching Protocols");
  const std::string longest = "https://" + std::string(253, 'x') + ":65535";
  EXPECT_NE(PageClient(port()).open("secret", longest), "HTTP/1.1 101 Switching Protocols");
  EXPECT_EQ(pages_.messages, 0);
}

TEST_F(LiveServerTest, AnswersOneViewerAndShowsStatesToAll) {
  PageClient a(port());
  PageClient b(port());
  ASSERT_EQ(a.open("secret"), "HTTP/1.1 101 Switching Protocols");
  ASSERT_EQ(b.open("secret"), "HTTP/1.1 101 Switching Protocols");
  a.say("hello");
  EXPECT_EQ(a.hear(), "hello, too");
  a.say("hel", false);
  a.say("lo", true, 0);
  EXPECT_EQ(a.hear(), "hello, too") << "a message in two pieces";
  publishes_ = true;
  const int first = std::stoi(b.hear());
  EXPECT_GT(std::stoi(b.hear()), first);
  EXPECT_GT(std::stoi(a.hear()), 0);
}

TEST_F(LiveServerTest, ClosesAViewerThatSendsTooMuchOrBinary) {
  PageClient big(port());
  ASSERT_EQ(big.open("secret"), "HTTP/1.1 101 Switching Protocols");
  big.say(std::string(kLongestMessage + 1, 'x'));
  EXPECT_EQ(big.hear(), "");
  PageClient binary(port());
  ASSERT_EQ(binary.open("secret"), "HTTP/1.1 101 Switching Protocols");
  binary.say("hello", true, 2);
  EXPECT_EQ(binary.hear(), "");
  PageClient pieces(port());
  ASSERT_EQ(pieces.open("secret"), "HTTP/1.1 101 Switching Protocols");
  pieces.say("x", false);
  for (int i = 0; i < 5; ++i) pieces.say(std::string(1000, 'x'), false, 0);
  EXPECT_EQ(pieces.hear(), "");
  EXPECT_EQ(pages_.messages, 0);
  wait_ticks(5);
  EXPECT_EQ(viewers_, 0u);
  EXPECT_EQ(pages_.left_count, 3);
}

TEST_F(LiveServerTest, HasRoomForEightViewers) {
  std::vector<std::unique_ptr<PageClient>> clients;
  for (std::size_t i = 0; i < LiveServer::kMostViewers; ++i) {
    clients.push_back(std::make_unique<PageClient>(port()));
    ASSERT_EQ(clients.back()->open("secret"), "HTTP/1.1 101 Switching Protocols");
  }
  EXPECT_NE(PageClient(port()).open("secret"), "HTTP/1.1 101 Switching Protocols");
  clients.pop_back();
  while (viewers_ == LiveServer::kMostViewers) wait_ticks(1);
  EXPECT_EQ(PageClient(port()).open("secret"), "HTTP/1.1 101 Switching Protocols");
}

/// A viewer that reads nothing neither delays the ticks nor the other viewer, and memory does not grow with it: it gets
/// far fewer states than there were.
TEST_F(LiveServerTest, DoesNotWaitForAStalledViewer) {
  pages_.width = 50'000;
  PageClient stalled(port());
  PageClient other(port());
  ASSERT_EQ(stalled.open("secret"), "HTTP/1.1 101 Switching Protocols");
  ASSERT_EQ(other.open("secret"), "HTTP/1.1 101 Switching Protocols");
  publishes_ = true;
  const int begin = std::stoi(other.hear());
  int last = begin;
  while (last < begin + 600) last = std::stoi(other.hear());
  stop();
  EXPECT_LT(pages_.states_of_first, 300);
  EXPECT_LT(stalled.drain(), 300u * 50'000u);
}

/// Of two viewers the one that reads stays.
TEST_F(LiveServerTest, ClosesAStalledViewer) {
  stop();
  end_ = false;
  begin(200'000);
  pages_.width = 50'000;
  PageClient stalled(port());
  PageClient other(port());
  ASSERT_EQ(stalled.open("secret"), "HTTP/1.1 101 Switching Protocols");
  ASSERT_EQ(other.open("secret"), "HTTP/1.1 101 Switching Protocols");
  publishes_ = true;
  while (pages_.left_count == 0) ASSERT_NE(other.hear(), "");
  wait_ticks(2);
  EXPECT_EQ(viewers_, 1u);
  EXPECT_EQ(pages_.last_left, 1u);
  ASSERT_NE(other.hear(), "");
}

constexpr const char* kFoxglove = "foxglove.websocket.v1";

TEST_F(LiveServerTest, SpeaksTheProtocolThatAViewerAsksFor) {
  for (const char* wanted : {kFoxglove, "foxglove.sdk.v1", "foxglove.websocket.v1, foxglove.sdk.v1",
                             "foxglove.of.tomorrow, foxglove.sdk.v1"}) {
    for (const char* path : {"/?token=secret", "/foxglove?token=secret"}) {
      PageClient client(port());
      const std::string head = client.open_socket(path, wanted);
      EXPECT_TRUE(head.starts_with("HTTP/1.1 101")) << wanted << ": " << head;
      EXPECT_NE(head.find("Sec-WebSocket-Protocol: foxglove."), std::string::npos) << head;
      EXPECT_EQ(head.find(","), std::string::npos) << head;
      EXPECT_EQ(client.hear(), "welcome");
      EXPECT_EQ(client.hear(), "channels");
      EXPECT_FALSE(client.heard_binary());
    }
  }
  PageClient client(port());
  EXPECT_FALSE(client.open_socket("/?token=secret", "foxglove.of.tomorrow").starts_with("HTTP/1.1 101"));
}

TEST_F(LiveServerTest, OpensAFoxgloveSocketOnlyWithTokenAndKnownOrigin) {
  const auto opens = [this](const std::string& origin, const char* path = "/?token=secret") {
    return PageClient(port()).open_socket(path, kFoxglove, origin).starts_with("HTTP/1.1 101");
  };
  for (const char* origin : {"", "file://", "https://app.foxglove.dev", "http://127.0.0.1:1", "http://localhost:8080",
                             "http://localhost", "http://127.0.0.1:9999"}) {
    EXPECT_TRUE(opens(origin)) << origin;
    EXPECT_FALSE(opens(origin, "/?token=guess")) << origin;
    EXPECT_FALSE(opens(origin, "/foxglove")) << origin;
  }
  for (const char* origin :
       {"null", "http://evil.example", "https://app.foxglove.dev.evil.example", "http://app.foxglove.dev",
        "https://evil.example/https://app.foxglove.dev", "http://localhost.evil.example", "http://localhost:80.evil",
        "http://127.0.0.1.evil.example", "file://evil", "http://evil.example?http://localhost"}) {
    EXPECT_FALSE(opens(origin)) << origin;
  }
  EXPECT_NE(PageClient(port()).open("secret", "https://app.foxglove.dev"), "HTTP/1.1 101 Switching Protocols")
      << "a page's socket, which may move the hand";
}

TEST_F(LiveServerTest, SendsLargeBinaryMessagesWhole) {
  PageClient a(port());
  PageClient b(port());
  for (PageClient* client : {&a, &b}) {
    client->open_socket("/?token=secret", kFoxglove);
    client->hear();
    client->hear();
  }
  a.say("rubbish");
  EXPECT_EQ(a.hear(), "no such message");
  a.say("rubbish", true, 2);
  EXPECT_EQ(a.hear(), "no data");
  publishes_ = true;
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(a.hear(), "to 1: " + *foxglove_.shared);
    EXPECT_TRUE(a.heard_binary());
    EXPECT_EQ(b.hear(), "to 2: " + *foxglove_.shared);
  }
}

/// As DoesNotWaitForAStalledViewer: the stalled one speaks Foxglove's protocol, and gets 300 kB at each tick.
TEST_F(LiveServerTest, DoesNotWaitForAStalledFoxgloveViewer) {
  PageClient stalled(port());
  PageClient other(port());
  stalled.open_socket("/?token=secret", kFoxglove);
  ASSERT_EQ(other.open("secret"), "HTTP/1.1 101 Switching Protocols");
  publishes_ = true;
  const int begin = std::stoi(other.hear());
  int last = begin;
  while (last < begin + 600) last = std::stoi(other.hear());
  stop();
  EXPECT_LT(foxglove_.states_of_first, 100);
  EXPECT_LT(stalled.drain(), 100u * 300'000u);
}

/// Its answers wait, and their number is bounded.
TEST_F(LiveServerTest, ClosesAViewerThatAsksWithoutReading) {
  PageClient flood(port());
  flood.open_socket("/?token=secret", kFoxglove);
  publishes_ = true;
  wait_ticks(100);
  for (int i = 0; i < 100; ++i) flood.say("rubbish");
  while (viewers_ > 0) wait_ticks(1);
  EXPECT_LT(foxglove_.messages, 40);
}

TEST_F(LiveServerTest, SurvivesRubbish) {
  for (const char* text :
       {"\r\n\r\n", "GET", "POST / HTTP/1.1\r\n\r\n", "\x16\x03\x01 is TLS", "GET /?token=secret HTTP/9\r\n\r\n",
        "GET /?token=%00%ff%zz HTTP/1.1\r\nHost: \xff\r\n\r\n"}) {
    PageClient client(port());
    client.send(text);
  }
  PageClient client(port());
  EXPECT_EQ(client.open("secret"), "HTTP/1.1 101 Switching Protocols");
}

TEST(LiveServerStart, NamesACureIfThePortIsTaken) {
  PageStub pages;
  FoxgloveStub foxglove;
  const LiveServer first({.address = "127.0.0.1", .port = 0, .page = "", .token = "a"}, {pages, foxglove});
  try {
    const LiveServer second({.address = "127.0.0.1", .port = first.port(), .page = "", .token = "a"},
                            {pages, foxglove});
    ADD_FAILURE() << "two servers on one port";
  } catch (const command::Failure& failure) {
    EXPECT_EQ(failure.exit_code(), command::ExitCode::kUnavailable);
    EXPECT_NE(std::string(failure.what()).find("--port"), std::string::npos);
  }
}

TEST(MakeToken, IsAnotherOneEachTime) {
  std::set<std::string> tokens;
  for (int i = 0; i < 100; ++i) tokens.insert(make_token());
  EXPECT_EQ(tokens.size(), 100u);
  EXPECT_EQ(tokens.begin()->size(), 32u);
}

}  // namespace
}  // namespace godobject::live::live_server_test
