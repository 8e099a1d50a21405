#pragma once
/// A client of the trainer's station that shares nothing with the server: a socket, and RFC 6455 by hand.
#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace ostium::app {

class Client {
 public:
  explicit Client(std::uint16_t port, int receive_bytes = 0) : port_(port) {
    socket_ = ::socket(AF_INET, SOCK_STREAM, 0);
    if (receive_bytes) setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_bytes, sizeof receive_bytes);
    sockaddr_in at{};
    at.sin_family = AF_INET, at.sin_port = htons(port), at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (connect(socket_, reinterpret_cast<const sockaddr*>(&at), sizeof at) != 0) close();
  }
  ~Client() { close(); }
  Client(const Client&) = delete;
  void close() {
    if (socket_ >= 0) ::close(socket_);
    socket_ = -1;
  }

  std::string host() const { return "127.0.0.1:" + std::to_string(port_); }
  void raw(const std::string& bytes) {
    for (std::size_t at = 0; at < bytes.size() && socket_ >= 0;) {
      const ssize_t n = ::send(socket_, bytes.data() + at, bytes.size() - at, MSG_NOSIGNAL);
      if (n <= 0) return close();
      at += static_cast<std::size_t>(n);
    }
  }
  /// What has come within that time, at least something; empty: nothing, or it is closed.
  std::string take(int ms = 3000) {
    pollfd wait{socket_, POLLIN, 0};
    if (socket_ < 0 || poll(&wait, 1, ms) <= 0) return "";
    std::string bytes(1 << 16, '\0');
    const ssize_t n = recv(socket_, bytes.data(), bytes.size(), 0);
    if (n <= 0) close();
    bytes.resize(n > 0 ? static_cast<std::size_t>(n) : 0);
    return bytes;
  }
  /// Sends a request; its answer's head and what came with it.
  std::string request(const std::string& line, const std::string& more = "", const std::string& host_header = "-") {
    raw(line + " HTTP/1.1\r\nHost: " + (host_header == "-" ? host() : host_header) + "\r\n" + more + "\r\n");
    std::string all;
    while (all.find("\r\n\r\n") == std::string::npos) {
      const std::string part = take();
      if (part.empty()) break;
      all += part;
    }
    const std::size_t end = all.find("\r\n\r\n");
    rest_ = end == std::string::npos ? "" : all.substr(end + 4);
    return all.substr(0, end);
  }
  std::string open_socket(const std::string& origin, const std::string& host_header = "-") {
    return request("GET /socket",
                   (origin.empty() ? "" : "Origin: " + origin + "\r\n") +
                       "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
                       "Sec-WebSocket-Version: 13\r\n",
                   host_header);
  }
  bool come_in(const std::string& token, const std::string& greeted = "\"welcome\"") {
    if (open_socket("http://" + host()).find(" 101 ") == std::string::npos) return false;
    say(R"({"do":"hello","token":")" + token + "\"}");
    return message_with(greeted).has_value();
  }
  /// One frame, masked with zeros.
  void say(const std::string& text, char opcode = 1) {
    std::string frame(1, static_cast<char>(0x80 | opcode));
    if (text.size() < 126) {
      frame += static_cast<char>(0x80 | text.size());
    } else {
      frame += static_cast<char>(0x80 | 126);
      frame += static_cast<char>(text.size() >> 8 & 255);
      frame += static_cast<char>(text.size() & 255);
    }
    raw(frame + std::string(4, '\0') + text);
  }
  /// The next whole frame's payload; pings are passed over. Empty: none within that time.
  std::optional<std::string> frame(int ms = 3000) {
    const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(ms);
    while (true) {
      if (rest_.size() >= 2) {
        std::size_t head = 2, size = static_cast<unsigned char>(rest_[1]) & 127;
        const std::size_t more = size == 126 ? 2 : size == 127 ? 8 : 0;
        if (rest_.size() >= head + more) {
          if (more) size = 0;
          for (std::size_t i = 0; i < more; ++i) size = size << 8 | static_cast<unsigned char>(rest_[head + i]);
          head += more;
          if (rest_.size() >= head + size) {
            const int opcode = rest_[0] & 15;
            const std::string payload = rest_.substr(head, size);
            rest_.erase(0, head + size);
            if (opcode == 8) close();
            if (opcode == 1 || opcode == 2) return payload;
            continue;
          }
        }
      }
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - std::chrono::steady_clock::now());
      const std::string part = left.count() > 0 ? take(static_cast<int>(left.count())) : "";
      if (part.empty()) return std::nullopt;
      rest_ += part;
    }
  }
  /// The next message that this holds for.
  std::optional<std::string> message(const std::function<bool(const std::string&)>& is, int ms = 5000) {
    const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(ms);
    while (std::chrono::steady_clock::now() < until)
      if (const auto text = frame(200); text && is(*text))
        return text;
      else if (!text && !is_open())
        return std::nullopt;
    return std::nullopt;
  }
  std::optional<std::string> message_with(const std::string& part, int ms = 5000) {
    return message([&](const std::string& text) { return text.find(part) != std::string::npos; }, ms);
  }
  bool is_open() const { return socket_ >= 0; }
  /// Whether the server ends it within that time.
  bool is_ended(int ms) {
    const auto until = std::chrono::steady_clock::now() + std::chrono::milliseconds(ms);
    while (is_open() && std::chrono::steady_clock::now() < until) take(50);
    return !is_open();
  }

 private:
  std::uint16_t port_;
  int socket_ = -1;
  std::string rest_;
};

}  // namespace ostium::app
