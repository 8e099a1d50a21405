#pragma once
/// A host of the emulator's server, for tests: an independent implementation of the USB/IP bytes.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>

#include <mutex>
#include <thread>

#include "device/emulator/usbip_server.h"

namespace ostium::device {

using Bytes = std::vector<std::uint8_t>;
using Clock = std::chrono::steady_clock;

inline double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

inline Bytes big(std::initializer_list<std::uint32_t> words) {
  Bytes b;
  for (const std::uint32_t w : words)
    for (const int shift : {24, 16, 8, 0}) b.push_back(static_cast<std::uint8_t>(w >> shift));
  return b;
}

/// The bytes of a command that submits a transfer.
inline Bytes submission(std::uint32_t number, bool in, std::uint32_t endpoint, std::uint32_t length,
                        const Bytes& setup = {}, const Bytes& data = {}) {
  Bytes b = big({1, number, usbip_device, in, endpoint, 0, length, 0, 0, 0});
  b.insert(b.end(), setup.begin(), setup.end());
  b.resize(48, 0);
  b.insert(b.end(), data.begin(), data.end());
  return b;
}

class UsbipHost {
 public:
  explicit UsbipHost(int socket = -1) : socket_(socket) {}

  void send(const Bytes& b) { ASSERT_EQ(try_to_send(b), static_cast<ssize_t>(b.size())); }
  ssize_t try_to_send(const Bytes& b, int flags = 0) {
    return ::send(socket_.number(), b.data(), b.size(), flags | MSG_NOSIGNAL);
  }

  /// Empty: the server has ended the connection.
  Bytes receive(std::size_t count) {
    Bytes b(count);
    for (std::size_t done = 0; done < count;) {
      const ssize_t some = recv(socket_.number(), b.data() + done, count - done, 0);
      if (some <= 0) return {};
      done += static_cast<std::size_t>(some);
    }
    return b;
  }
  /// Reads until the server has ended the connection.
  bool is_ended() {
    while (!receive(1).empty()) {
    }
    return true;
  }
  void leave() { socket_ = Socket(); }
  int socket() const { return socket_.number(); }

  void submit(std::uint32_t number, bool in, std::uint32_t endpoint, std::uint32_t length, const Bytes& setup,
              const Bytes& data = {}) {
    send(submission(number, in, endpoint, length, setup, data));
  }

  struct Answer {
    std::uint32_t command = 0, number = 0;
    std::int32_t status = 0;
    Bytes data;
  };
  Answer answer(bool with_data) {
    const Bytes h = receive(48);
    if (h.empty()) return {};
    Answer a{word(h, 0), word(h, 4), static_cast<std::int32_t>(word(h, 20)), {}};
    if (with_data && a.status == 0) a.data = receive(word(h, 24));
    return a;
  }

  /// The status that the server answers; -1: none.
  int attach(const std::string& bus_id = "1-1") {
    Bytes request{0x01, 0x11, 0x80, 0x03, 0, 0, 0, 0};
    request.insert(request.end(), bus_id.begin(), bus_id.end());
    request.resize(40, 0);
    send(request);
    const Bytes h = receive(8);
    if (h.empty()) return -1;
    const auto status = static_cast<int>(word(h, 4));
    return status == 0 && receive(312).empty() ? -1 : status;
  }

 private:
  static std::uint32_t word(const Bytes& b, std::size_t at) {
    return std::uint32_t{b[at]} << 24 | std::uint32_t{b[at + 1]} << 16 | std::uint32_t{b[at + 2]} << 8 | b[at + 3];
  }
  Socket socket_;
};

/// A server on a port of its own, in a thread.
class UsbipServed {
 public:
  EmulatedUsb usb{Calibration{}};

  UsbipServed() : thread_([this] { server_.serve([this] { return over_.load(); }); }) {}
  ~UsbipServed() { stop(); }

  /// How long it took to end, s.
  double stop() {
    const auto begin = Clock::now();
    over_ = true;
    if (thread_.joinable()) thread_.join();
    return seconds_since(begin);
  }

  UsbipHost connected() const {
    UsbipHost host(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    sockaddr_in a{};
    a.sin_family = AF_INET, a.sin_port = htons(server_.port()), a.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(connect(host.socket(), reinterpret_cast<sockaddr*>(&a), sizeof a), 0);
    return host;
  }

  /// Whether a line with these words was said within a second.
  bool said(const std::string& words) {
    for (const auto begin = Clock::now(); seconds_since(begin) < 1;
         std::this_thread::sleep_for(std::chrono::milliseconds(5))) {
      const std::lock_guard guard(mutex_);
      for (const std::string& line : lines_)
        if (line.find(words) != std::string::npos) return true;
    }
    return false;
  }

 private:
  std::mutex mutex_;
  std::vector<std::string> lines_;
  std::atomic<bool> over_{false};
  UsbipServer server_{usb, 0, false, [this](const std::string& line) {
                        const std::lock_guard guard(mutex_);
                        lines_.push_back(line);
                      }};
  std::thread thread_;
};

}  // namespace ostium::device
