#include "device/emulator/connection.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace ostium::device {

namespace {

constexpr int send_buffer_bytes = 16384;  // of the kernel; more would hide for long that a host does not read
// A dead host is probed after 3, 5 and 7 s of silence, and given up at 9 s; what was sent to it, after 8 s.
constexpr int idle_s = 3, between_s = 2, probes = 3, unanswered_ms = 8000;

bool is_for_later(int error) { return error == EAGAIN || error == EWOULDBLOCK || error == EINTR; }

ConnectionEnd gone() { return ConnectionEnd(fmt::format("the host is gone: {}", std::strerror(errno))); }

}  // namespace

Connection::Connection(int socket) : socket_(socket) {
  fcntl(socket, F_SETFL, fcntl(socket, F_GETFL) | O_NONBLOCK);
  setsockopt(socket, SOL_SOCKET, SO_SNDBUF, &send_buffer_bytes, sizeof send_buffer_bytes);
}

void Connection::notice_death() {
  const auto set = [&](int level, int option, int value) {
    setsockopt(socket_.number(), level, option, &value, sizeof value);
  };
  set(SOL_SOCKET, SO_KEEPALIVE, 1);  // finds a dead host when nothing is sent
  set(IPPROTO_TCP, TCP_KEEPIDLE, idle_s), set(IPPROTO_TCP, TCP_KEEPINTVL, between_s);
  set(IPPROTO_TCP, TCP_KEEPCNT, probes);
  set(IPPROTO_TCP, TCP_USER_TIMEOUT, unanswered_ms);  // and when something is
  set(IPPROTO_TCP, TCP_NODELAY, 1);                   // a sample is worth nothing later
}

void Connection::exchange() {
  flush();
  if (!clogged()) receive();
}

void Connection::send(std::span<const std::uint8_t> bytes) {
  if (!clogged()) clogged_since_ = Clock::now();
  unsent_.insert(unsent_.end(), bytes.begin(), bytes.end());
  flush();
}

/// A host that takes a byte now and then has the same time for all that waits.
void Connection::flush() {
  while (clogged()) {
    const ssize_t count = ::send(socket_.number(), unsent_.data(), unsent_.size(), MSG_NOSIGNAL);
    if (count < 0 && !is_for_later(errno)) throw gone();
    if (count <= 0) break;
    unsent_.erase(unsent_.begin(), unsent_.begin() + count);
  }
  if (clogged() && Clock::now() - clogged_since_ > patience)
    throw ConnectionEnd(fmt::format("the host did not read for {} s", patience.count()));
}

void Connection::receive() {
  std::uint8_t some[4096];
  const std::size_t room = std::min(sizeof some, most_received - received_.size());
  if (room == 0) return;
  const ssize_t count = recv(socket_.number(), some, room, 0);
  if (count == 0) throw ConnectionEnd("the host has left");
  if (count < 0 && !is_for_later(errno)) throw gone();
  if (count > 0) received_.insert(received_.end(), some, some + count);
}

pollfd Connection::awaited() const {
  const bool has_room = received_.size() < most_received;
  return {socket_.number(), static_cast<short>(clogged() ? POLLOUT : has_room ? POLLIN : 0), 0};
}

void wait_for(std::span<pollfd> awaited, Connection::Clock::time_point until) {
  using namespace std::chrono;
  const auto left = std::max(nanoseconds{0}, duration_cast<nanoseconds>(until - Connection::Clock::now())).count();
  const timespec time{left / 1'000'000'000, left % 1'000'000'000};
  ppoll(awaited.data(), awaited.size(), &time, nullptr);
}

}  // namespace ostium::device
