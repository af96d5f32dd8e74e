#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace godobject::live {

/// A viewer's side of a connection, written from RFC 6455 and without the library of the server.
class PageClient {
 public:
  explicit PageClient(int port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    const timeval patience{30, 0};  // only for a server that never answers
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    connected_ = ::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }
  ~PageClient() { ::close(socket_); }
  PageClient(const PageClient&) = delete;
  PageClient& operator=(const PageClient&) = delete;

  bool connected() const { return connected_; }

  void send(std::string_view bytes) const { (void)::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL); }

  /// Sends a request and returns the head of the response; empty if the server closes instead.
  std::string get(const std::string& path, const std::string& more = "", const std::string& host = "127.0.0.1:1") {
    send("GET " + path + " HTTP/1.1\r\nHost: " + host + "\r\n" + more + "\r\n");
    while (received_.find("\r\n\r\n") == std::string::npos) {
      if (!receive()) return "";
    }
    const std::size_t end = received_.find("\r\n\r\n") + 4;
    const std::string head = received_.substr(0, end);
    received_.erase(0, end);
    return head;
  }

  /// Reads and forgets bytes.
  void skip(std::size_t bytes) {
    if (need(bytes)) received_.erase(0, bytes);
  }

  /// Opens the web socket. `origin`: empty for a program that is no browser. Returns the head of the response.
  std::string open_socket(const std::string& path, const std::string& protocol, const std::string& origin = "") {
    return get(path,
               "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
               "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Protocol: " +
                   protocol + "\r\n" + (origin.empty() ? "" : "Origin: " + origin + "\r\n"));
  }

  /// Opens the web socket as a page. Returns the first line of the response.
  std::string open(const std::string& token, const std::string& origin = "http://127.0.0.1:1") {
    const std::string head = open_socket("/socket?token=" + token, "godobject-live", origin);
    return head.substr(0, head.find('\r'));
  }

  /// Sends a text message of up to 65535 bytes, masked with zeros.
  void say(std::string_view text, bool is_last = true, int opcode = 1) const {
    std::string frame;
    frame += static_cast<char>((is_last ? 0x80 : 0) | opcode);
    if (text.size() < 126) {
      frame += static_cast<char>(0x80 | text.size());
    } else {
      frame += static_cast<char>(0x80 | 126);
      frame += static_cast<char>(text.size() >> 8);
      frame += static_cast<char>(text.size() & 0xff);
    }
    frame += std::string(4, '\0');
    frame += text;
    send(frame);
  }

  /// Returns the next message, text or binary, of pieces of up to 65535 bytes; empty if the server closes.
  std::string hear() {
    std::string message;
    for (;;) {
      if (!need(2)) return "";
      const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(received_[i]); };
      const int opcode = byte(0) & 15;
      const bool is_last = (byte(0) & 0x80) != 0;
      std::size_t length = byte(1) & 127;
      std::size_t begin = 2;
      if (length == 126) {
        if (!need(4)) return "";
        length = static_cast<std::size_t>(byte(2)) << 8 | byte(3);
        begin = 4;
      }
      if (!need(begin + length)) return "";
      if (opcode <= 2) message += received_.substr(begin, length);
      if (opcode == 1 || opcode == 2) heard_binary_ = opcode == 2;
      received_.erase(0, begin + length);
      if (opcode == 8) return "";
      if (opcode <= 2 && is_last) return message;
    }
  }

  /// True if the last message was binary.
  bool heard_binary() const { return heard_binary_; }

  /// Reads until the server closes, or until there are `most` bytes. Returns the number of bytes.
  std::size_t drain(std::size_t most = std::size_t{1} << 26) {
    while (received_.size() < most && receive()) {
    }
    return received_.size();
  }

 private:
  bool need(std::size_t bytes) {
    while (received_.size() < bytes) {
      if (!receive()) return false;
    }
    return true;
  }
  bool receive() {
    std::array<char, 65536> piece;
    const ssize_t length = ::recv(socket_, piece.data(), piece.size(), 0);
    if (length <= 0) return false;
    received_.append(piece.data(), static_cast<std::size_t>(length));
    return true;
  }

  int socket_;
  bool connected_ = false;
  bool heard_binary_ = false;
  std::string received_;
};

}  // namespace godobject::live
