#include "toolchain/live/live_server.h"

#include <libwebsockets.h>
#include <sys/random.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <deque>
#include <map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/live/request.h"

namespace godobject::live {
namespace {

using command::ExitCode;
using command::Failure;

constexpr std::size_t kMostAnswers = 8;  // that wait for a viewer; more messages than answers taken end it
constexpr std::size_t kWrite = 16384;    // of the page, at once [bytes]

/// Compares in a time that does not depend on where the texts differ.
bool same_text(std::string_view a, std::string_view b) {
  unsigned different = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) different |= static_cast<unsigned>(a[i] ^ b[i]);
  return different == 0;
}

std::string header_text(lws* wsi, lws_token_indexes header) {
  std::string text(static_cast<std::size_t>(lws_hdr_total_length(wsi, header)) + 1, '\0');
  const int length = lws_hdr_copy(wsi, text.data(), static_cast<int>(text.size()), header);
  text.resize(length > 0 ? static_cast<std::size_t>(length) : 0);
  return text;
}

std::string argument(lws* wsi, const char* name) {
  std::array<char, 256> text{};
  const std::string key = fmt::format("{}=", name);
  const char* value = lws_get_urlarg_by_name(wsi, key.c_str(), text.data(), static_cast<int>(text.size()));
  return value != nullptr ? value : "";
}

std::string with_host(std::string page, const std::string& host) {
  constexpr std::string_view kMark = "@HOST@";
  const std::size_t at = page.find(kMark);
  if (at != std::string::npos) page.replace(at, kMark.size(), host);
  return page;
}

/// True if it is a name or an address with a port, so that it may stand in a header.
bool is_host(std::string_view host) {
  const auto fits = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view(".-:[]").find(c) != std::string_view::npos;
  };
  return !host.empty() && host.size() < 128 && std::all_of(host.begin(), host.end(), fits);
}

}  // namespace

struct LiveServer::Connections {
  /// A web socket.
  struct Viewer {
    ViewerNumber number = 0;
    std::deque<std::string> answers;
    std::string state;     ///< that waits
    std::string received;  ///< pieces of a message
    lws_usec_t since = 0;  ///< the oldest unsent message waits [us]; 0: none does
  };

  /// A request for the page.
  struct Download {
    std::string page;
    std::size_t sent = 0;
  };

  struct Timer {
    lws_sorted_usec_list_t entry{};
    Connections* connections = nullptr;
  };

  Setup setup;
  Handlers handlers;
  lws_context* context = nullptr;
  std::map<lws*, Viewer> viewers;
  std::map<lws*, Download> downloads;
  ViewerNumber last_number = 0;

  Timer timer{{}, this};
  lws_usec_t interval = 0;
  const std::function<bool()>* tick = nullptr;
  bool runs = false;

  static Connections& of(lws* wsi) { return *static_cast<Connections*>(lws_context_user(lws_get_context(wsi))); }

  bool has_token(lws* wsi) const { return same_text(argument(wsi, "token"), setup.token); }

  /// A page of another origin must not use a token that it has found out; programs that are no browser send no origin.
  bool may_connect(lws* wsi) const {
    const std::string origin = header_text(wsi, WSI_TOKEN_ORIGIN);
    const bool foreign = !origin.empty() && origin != "http://" + header_text(wsi, WSI_TOKEN_HOST);
    return has_token(wsi) && !foreign && viewers.size() < kMostViewers;
  }

  int begin_download(lws* wsi, std::string_view path);
  int continue_download(lws* wsi);
  int receive(lws* wsi, std::string_view piece);
  int write_next(lws* wsi);
  void send_later(lws* wsi, Viewer& viewer);
  void close_stalled();
};

int LiveServer::Connections::begin_download(lws* wsi, std::string_view path) {
  const std::string host = header_text(wsi, WSI_TOKEN_HOST);
  if (path != "/") return lws_return_http_status(wsi, HTTP_STATUS_NOT_FOUND, nullptr);
  if (!has_token(wsi) || !is_host(host)) {
    return lws_return_http_status(wsi, HTTP_STATUS_FORBIDDEN,
                                  "The address needs the token that godobject-live printed.");
  }
  Download download{with_host(setup.page, host)};
  std::array<unsigned char, LWS_PRE + 2048> buffer{};
  unsigned char* const begin = buffer.data() + LWS_PRE;
  unsigned char* at = begin;
  unsigned char* const end = buffer.data() + buffer.size() - 1;
  const auto add = [&](const char* name, std::string_view value) {
    return lws_add_http_header_by_name(wsi, reinterpret_cast<const unsigned char*>(name),
                                       reinterpret_cast<const unsigned char*>(value.data()),
                                       static_cast<int>(value.size()), &at, end) != 0;
  };
  if (lws_add_http_common_headers(wsi, HTTP_STATUS_OK, "text/html; charset=utf-8", download.page.size(), &at, end) !=
          0 ||
      add("cache-control:", "no-store") || add("referrer-policy:", "no-referrer") ||
      add("x-content-type-options:", "nosniff") || add("x-frame-options:", "DENY") ||
      lws_finalize_write_http_header(wsi, begin, &at, end) != 0) {
    return 1;
  }
  downloads[wsi] = std::move(download);
  lws_callback_on_writable(wsi);
  return 0;
}

int LiveServer::Connections::continue_download(lws* wsi) {
  const auto found = downloads.find(wsi);
  if (found == downloads.end()) return 0;
  Download& download = found->second;
  const std::size_t length = std::min(kWrite, download.page.size() - download.sent);
  std::vector<unsigned char> buffer(LWS_PRE + length);
  std::memcpy(buffer.data() + LWS_PRE, download.page.data() + download.sent, length);
  download.sent += length;
  const bool last = download.sent == download.page.size();
  if (lws_write(wsi, buffer.data() + LWS_PRE, length, last ? LWS_WRITE_HTTP_FINAL : LWS_WRITE_HTTP) <
      static_cast<int>(length)) {
    return 1;
  }
  if (!last) {
    lws_callback_on_writable(wsi);
    return 0;
  }
  downloads.erase(found);
  return lws_http_transaction_completed(wsi) != 0 ? -1 : 0;
}

void LiveServer::Connections::send_later(lws* wsi, Viewer& viewer) {
  if (viewer.since == 0) viewer.since = lws_now_usecs();
  lws_callback_on_writable(wsi);
}

/// Joins the pieces of a message. A viewer that sends too much, or does not take its answers, is closed.
int LiveServer::Connections::receive(lws* wsi, std::string_view piece) {
  Viewer& viewer = viewers[wsi];
  viewer.received += piece;
  if (viewer.received.size() > kLongestMessage || lws_frame_is_binary(wsi) != 0) return -1;
  if (lws_is_final_fragment(wsi) == 0 || lws_remaining_packet_payload(wsi) != 0) return 0;
  std::string answer = handlers.received(viewer.number, std::exchange(viewer.received, {}));
  if (answer.empty()) return 0;
  if (viewer.answers.size() == kMostAnswers) return -1;
  viewer.answers.push_back(std::move(answer));
  send_later(wsi, viewer);
  return 0;
}

int LiveServer::Connections::write_next(lws* wsi) {
  Viewer& viewer = viewers[wsi];
  std::string text;
  if (!viewer.answers.empty()) {
    text = std::move(viewer.answers.front());
    viewer.answers.pop_front();
  } else {
    text = std::exchange(viewer.state, {});
  }
  if (text.empty()) return 0;
  viewer.since = 0;
  std::vector<unsigned char> buffer(LWS_PRE + text.size());
  std::memcpy(buffer.data() + LWS_PRE, text.data(), text.size());
  if (lws_write(wsi, buffer.data() + LWS_PRE, text.size(), LWS_WRITE_TEXT) < static_cast<int>(text.size())) return -1;
  if (!viewer.answers.empty() || !viewer.state.empty()) send_later(wsi, viewer);
  return 0;
}

/// Makes room for others.
void LiveServer::Connections::close_stalled() {
  const lws_usec_t now = lws_now_usecs();
  for (const auto& [wsi, viewer] : viewers) {
    if (viewer.since > 0 && now - viewer.since > setup.stalled_us) {
      lws_set_timeout(wsi, PENDING_TIMEOUT_USER_OK, LWS_TO_KILL_ASYNC);
    }
  }
}

namespace {

template <class Connections>
int on_event(lws* wsi, lws_callback_reasons reason, void* /*user*/, void* in, std::size_t length) {
  const auto text = [&] { return std::string_view(static_cast<const char*>(in), length); };
  switch (reason) {
    case LWS_CALLBACK_HTTP: return Connections::of(wsi).begin_download(wsi, text());
    case LWS_CALLBACK_HTTP_WRITEABLE: return Connections::of(wsi).continue_download(wsi);
    case LWS_CALLBACK_CLOSED_HTTP: Connections::of(wsi).downloads.erase(wsi); return 0;
    case LWS_CALLBACK_FILTER_PROTOCOL_CONNECTION: return Connections::of(wsi).may_connect(wsi) ? 0 : 1;
    case LWS_CALLBACK_ESTABLISHED: {
      Connections& connections = Connections::of(wsi);
      connections.viewers[wsi].number = ++connections.last_number;
      return 0;
    }
    case LWS_CALLBACK_RECEIVE: return Connections::of(wsi).receive(wsi, text());
    case LWS_CALLBACK_SERVER_WRITEABLE: return Connections::of(wsi).write_next(wsi);
    case LWS_CALLBACK_CLOSED: {
      Connections& connections = Connections::of(wsi);
      const ViewerNumber number = connections.viewers[wsi].number;
      connections.viewers.erase(wsi);
      connections.handlers.left(number);
      return 0;
    }
    default: return 0;
  }
}

template <class Connections>
void on_timer(lws_sorted_usec_list_t* timer) {
  Connections& connections = *lws_container_of(timer, typename Connections::Timer, entry)->connections;
  connections.close_stalled();
  connections.runs = (*connections.tick)();
  if (connections.runs) {
    lws_sul_schedule(connections.context, 0, timer, &on_timer<Connections>, connections.interval);
  } else {
    lws_cancel_service(connections.context);
  }
}

}  // namespace

LiveServer::LiveServer(Setup setup, Handlers handlers) : connections_(std::make_unique<Connections>()) {
  static const lws_protocols kProtocols[] = {
      {"http", &on_event<Connections>, 0, 0, 0, nullptr, 0},
      {"godobject-live", &on_event<Connections>, 0, kLongestMessage, 0, nullptr, 0},
      {nullptr, nullptr, 0, 0, 0, nullptr, 0}};
  connections_->setup = std::move(setup);
  connections_->handlers = std::move(handlers);
  lws_set_log_level(0, nullptr);
  lws_context_creation_info info{};
  info.port = connections_->setup.port;
  info.iface = connections_->setup.address.c_str();
  info.protocols = kProtocols;
  info.user = connections_.get();
  info.gid = -1;  // keeps the rights of the caller
  info.uid = -1;
  info.options = LWS_SERVER_OPTION_FAIL_UPON_UNABLE_TO_BIND | LWS_SERVER_OPTION_DISABLE_IPV6;
  info.vhost_name = "godobject-live";
  connections_->context = lws_create_context(&info);
  if (connections_->context == nullptr) {
    throw Failure(ExitCode::kUnavailable,
                  fmt::format("{}:{}: cannot be opened; another program may use the port: choose one by --port, or an "
                              "address of this machine by --listen",
                              connections_->setup.address, connections_->setup.port));
  }
}

LiveServer::~LiveServer() {
  if (connections_->context != nullptr) lws_context_destroy(connections_->context);
}

int LiveServer::port() const noexcept {
  return lws_get_vhost_listen_port(lws_get_vhost_by_name(connections_->context, "godobject-live"));
}

std::size_t LiveServer::viewers() const noexcept { return connections_->viewers.size(); }

void LiveServer::run(std::int64_t interval_us, const std::function<bool()>& tick) {
  Connections& connections = *connections_;
  connections.interval = interval_us;
  connections.tick = &tick;
  connections.runs = true;
  lws_sul_schedule(connections.context, 0, &connections.timer.entry, &on_timer<Connections>, interval_us);
  while (connections.runs && lws_service(connections.context, 0) >= 0) {
  }
}

void LiveServer::publish(const std::function<std::string(ViewerNumber)>& text_of) {
  for (auto& [wsi, viewer] : connections_->viewers) {
    viewer.state = text_of(viewer.number);
    connections_->send_later(wsi, viewer);
  }
}

std::string make_token() {
  std::array<unsigned char, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    throw Failure(ExitCode::kUnavailable, "the system gives no random numbers for the token");
  }
  std::string text;
  for (const unsigned char byte : bytes) text += fmt::format("{:02x}", byte);
  return text;
}

}  // namespace godobject::live
