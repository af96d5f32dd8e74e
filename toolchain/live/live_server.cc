#include "toolchain/live/live_server.h"

#include <libwebsockets.h>
#include <sys/random.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <deque>
#include <iterator>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "toolchain/command_line/failure.h"
#include "toolchain/live/request.h"

namespace godobject::live {
namespace {

using command::ExitCode;
using command::Failure;

constexpr std::size_t kMostWaiting = 32;   // messages to a viewer that does not take them; a further answer ends it
constexpr std::size_t kMostDownloads = 8;  // of the page at a time; each has a copy
constexpr std::size_t kWrite = 16384;      // at once [bytes]
constexpr unsigned short kMostHeaders = 16384;  // of a request [bytes]
constexpr unsigned kFoxglove = 1;               // lws_protocols::id; that of the page is 0

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

/// True for an origin on this machine, with any port.
bool is_local(std::string_view origin) {
  for (const std::string_view host : {"http://localhost", "http://127.0.0.1"}) {
    if (!origin.starts_with(host)) continue;
    const std::string_view port = origin.substr(host.size());
    return port.empty() || (port[0] == ':' && port.find_first_not_of("0123456789", 1) == std::string_view::npos);
  }
  return false;
}

/// True for the origins of Foxglove and Lichtblick: the web application, desktop applications, and a server on this
/// machine.
bool is_of_foxglove(std::string_view origin) {
  return origin == "https://app.foxglove.dev" || origin == "file://" || is_local(origin);
}

/// Copies a part of a message, from `begin` on.
void copy_part(const ServerMessage& message, std::size_t begin, std::span<unsigned char> part) {
  const std::string_view head = std::string_view(message.head).substr(std::min(begin, message.head.size()));
  const std::size_t of_head = head.copy(reinterpret_cast<char*>(part.data()), part.size());
  if (of_head == part.size()) return;
  message.body->copy(reinterpret_cast<char*>(part.data()) + of_head, part.size() - of_head,
                     begin + of_head - message.head.size());
}

std::size_t size_of(const ServerMessage& message) {
  return message.head.size() + (message.body ? message.body->size() : 0);
}

/// True for a Host header with a numeric address or this machine's own name, with or without a port. A name of
/// somebody else could lead a browser here (DNS rebinding), and other characters do not belong in a header.
bool is_host(std::string_view host) {
  constexpr std::string_view kDigits = "0123456789";
  const std::size_t colon = host.find(':');
  const std::string_view name = host.substr(0, colon);
  const bool is_address = !name.empty() && name.find_first_not_of("0123456789.") == std::string_view::npos;
  const std::string_view port = colon == std::string_view::npos ? "0" : host.substr(colon + 1);
  const bool is_port = !port.empty() && port.size() <= 5 && port.find_first_not_of(kDigits) == std::string_view::npos;
  return (is_address || name == "localhost") && host.size() < 64 && is_port;
}

/// Answers a request with an error and nothing else.
int refuse(lws* wsi, unsigned status, const char* words) {
  if (lws_return_http_status(wsi, status, words) != 0) return -1;
  return lws_http_transaction_completed(wsi) != 0 ? -1 : 0;
}

}  // namespace

struct LiveServer::Connections {
  /// A web socket.
  struct Viewer {
    ViewerNumber number = 0;
    ViewerProtocol* protocol = nullptr;
    std::deque<ServerMessage> waiting;
    std::size_t sent = 0;  ///< of the first one [bytes]
    std::string received;  ///< pieces of a message
    lws_usec_t since = 0;  ///< the viewer has taken nothing [us]; 0: nothing waits
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

  Connections(Setup server_setup, Protocols server_protocols)
      : setup(std::move(server_setup)), protocols(server_protocols) {}

  Setup setup;
  Protocols protocols;
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

  static bool speaks_foxglove(lws* wsi) { return lws_get_protocol(wsi)->id == kFoxglove; }

  /// A page of another origin must not use a token that it has found out; programs that are no browser send no origin.
  bool may_connect(lws* wsi) const {
    const std::string origin = header_text(wsi, WSI_TOKEN_ORIGIN);
    const std::string host = header_text(wsi, WSI_TOKEN_HOST);
    const bool own = origin.empty() || origin == "http://" + host;
    const bool known = own || (speaks_foxglove(wsi) && is_of_foxglove(origin));
    return has_token(wsi) && is_host(host) && known && viewers.size() < kMostViewers;
  }

  int begin_download(lws* wsi, std::string_view path);
  int continue_download(lws* wsi);
  void join(lws* wsi);
  void leave(lws* wsi);
  int receive(lws* wsi, std::string_view piece);
  int write_next(lws* wsi);
  void send(lws* wsi, Viewer& viewer, ServerMessages messages);
  void send_later(lws* wsi, Viewer& viewer);
  void close_stalled();
};

int LiveServer::Connections::begin_download(lws* wsi, std::string_view path) {
  const std::string host = header_text(wsi, WSI_TOKEN_HOST);
  if (path != "/") return refuse(wsi, HTTP_STATUS_NOT_FOUND, nullptr);
  if (!has_token(wsi) || !is_host(host)) {
    return refuse(wsi, HTTP_STATUS_FORBIDDEN, "Use the address that godobject-live printed, with its token.");
  }
  if (downloads.size() >= kMostDownloads) return refuse(wsi, HTTP_STATUS_SERVICE_UNAVAILABLE, nullptr);
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

void LiveServer::Connections::send(lws* wsi, Viewer& viewer, ServerMessages messages) {
  if (messages.empty()) return;
  std::move(messages.begin(), messages.end(), std::back_inserter(viewer.waiting));
  send_later(wsi, viewer);
}

void LiveServer::Connections::join(lws* wsi) {
  Viewer& viewer = viewers[wsi];
  viewer.number = ++last_number;
  viewer.protocol = speaks_foxglove(wsi) ? &protocols.foxglove : &protocols.page;
  send(wsi, viewer, viewer.protocol->joined(viewer.number));
}

void LiveServer::Connections::leave(lws* wsi) {
  const auto found = viewers.find(wsi);
  if (found == viewers.end()) return;
  const Viewer viewer = std::move(found->second);
  viewers.erase(found);
  viewer.protocol->left(viewer.number);
}

/// Joins the pieces of a message. A viewer that sends too much, or does not take its answers, is closed.
int LiveServer::Connections::receive(lws* wsi, std::string_view piece) {
  Viewer& viewer = viewers.at(wsi);
  viewer.received += piece;
  if (viewer.received.size() > kLongestMessage) return -1;
  if (lws_is_final_fragment(wsi) == 0 || lws_remaining_packet_payload(wsi) != 0) return 0;
  const std::string message = std::exchange(viewer.received, {});
  std::optional<ServerMessages> answers =
      viewer.protocol->received(viewer.number, message, lws_frame_is_binary(wsi) != 0);
  if (!answers || viewer.waiting.size() + answers->size() > kMostWaiting) return -1;
  send(wsi, viewer, std::move(*answers));
  return 0;
}

/// Writes a part of a message: a viewer takes a large one piece by piece, and none is copied as a whole.
int LiveServer::Connections::write_next(lws* wsi) {
  Viewer& viewer = viewers.at(wsi);
  if (viewer.waiting.empty()) return 0;
  const ServerMessage& message = viewer.waiting.front();
  const std::size_t rest = size_of(message) - viewer.sent;
  std::vector<unsigned char> buffer(LWS_PRE + std::min(kWrite, rest));
  const std::span part = std::span(buffer).subspan(LWS_PRE);
  copy_part(message, viewer.sent, part);
  const bool is_last = part.size() == rest;
  const int flags =
      lws_write_ws_flags(message.binary ? LWS_WRITE_BINARY : LWS_WRITE_TEXT, viewer.sent == 0 ? 1 : 0, is_last ? 1 : 0);
  if (lws_write(wsi, part.data(), part.size(), static_cast<lws_write_protocol>(flags)) <
      static_cast<int>(part.size())) {
    return -1;
  }
  viewer.since = 0;
  viewer.sent += part.size();
  if (is_last) {
    viewer.waiting.pop_front();
    viewer.sent = 0;
  }
  if (!viewer.waiting.empty()) send_later(wsi, viewer);
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
int handle(lws* wsi, lws_callback_reasons reason, void* in, std::size_t length) {
  const auto text = [&] { return std::string_view(static_cast<const char*>(in), length); };
  switch (reason) {
    // the library also offers HTTP/2, with which it stops the process on a malformed request
    case LWS_CALLBACK_HTTP_CONFIRM_UPGRADE:
      return std::string_view(static_cast<const char*>(in)) == "websocket" ? 0 : 1;
    case LWS_CALLBACK_HTTP: return Connections::of(wsi).begin_download(wsi, text());
    case LWS_CALLBACK_HTTP_WRITEABLE: return Connections::of(wsi).continue_download(wsi);
    case LWS_CALLBACK_CLOSED_HTTP: Connections::of(wsi).downloads.erase(wsi); return 0;
    case LWS_CALLBACK_FILTER_PROTOCOL_CONNECTION: return Connections::of(wsi).may_connect(wsi) ? 0 : 1;
    case LWS_CALLBACK_ESTABLISHED: Connections::of(wsi).join(wsi); return 0;
    case LWS_CALLBACK_RECEIVE: return Connections::of(wsi).receive(wsi, text());
    case LWS_CALLBACK_SERVER_WRITEABLE: return Connections::of(wsi).write_next(wsi);
    case LWS_CALLBACK_CLOSED: Connections::of(wsi).leave(wsi); return 0;
    default: return 0;
  }
}

/// The library is written in C and could not pass an exception on: the connection that caused it is closed.
template <class Connections>
int on_event(lws* wsi, lws_callback_reasons reason, void* /*user*/, void* in, std::size_t length) {
  try {
    return handle<Connections>(wsi, reason, in, length);
  } catch (...) {
    return -1;
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

LiveServer::LiveServer(Setup setup, Protocols protocols)
    : connections_(std::make_unique<Connections>(std::move(setup), protocols)) {
  static const lws_protocols kProtocols[] = {
      {"http", &on_event<Connections>, 0, 0, 0, nullptr, 0},
      {"godobject-live", &on_event<Connections>, 0, kLongestMessage, 0, nullptr, 0},
      {"foxglove.websocket.v1", &on_event<Connections>, 0, kLongestMessage, kFoxglove, nullptr, 0},
      {"foxglove.sdk.v1", &on_event<Connections>, 0, kLongestMessage, kFoxglove, nullptr, 0},
      {nullptr, nullptr, 0, 0, 0, nullptr, 0}};
  lws_set_log_level(0, nullptr);
  lws_context_creation_info info{};
  info.port = connections_->setup.port;
  info.max_http_header_data = kMostHeaders;  // browsers send cookies of all ports of a host
  info.pt_serv_buf_size = kMostHeaders;
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

void LiveServer::publish() {
  for (auto& [wsi, viewer] : connections_->viewers) {
    if (viewer.waiting.empty()) connections_->send(wsi, viewer, viewer.protocol->state(viewer.number));
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
