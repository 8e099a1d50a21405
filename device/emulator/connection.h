#pragma once
/// A connected socket that never blocks and holds little, whatever the other end does.
///
/// While bytes wait to be sent nothing is read, so a host that does not read soon cannot send either, and memory stays
/// bounded. It loses the connection after `patience`.
#include <poll.h>

#include <chrono>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "device/emulator/socket.h"

namespace ostium::device {

/// Why a connection ends, as a line for a log: the host left, does not read, or broke the protocol.
class ConnectionEnd : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Connection {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds patience{5};  ///< with a host that does not read
  static constexpr std::size_t most_received = 8192;  ///< bytes; above the longest message of the protocol

  /// Takes ownership of the socket.
  explicit Connection(int socket);

  /// TCP only: a machine at the other end that no longer answers is noticed within 10 s.
  void notice_death();

  /// Sends what waits and reads what came. Throws ConnectionEnd when the host is gone or its time is up, as send does.
  void exchange();
  void send(std::span<const std::uint8_t> bytes);
  /// Some bytes wait to be sent: nothing more should be.
  bool clogged() const { return !unsent_.empty(); }

  std::span<const std::uint8_t> received() const { return received_; }
  void drop(std::size_t count) { received_.erase(received_.begin(), received_.begin() + static_cast<long>(count)); }

  /// What makes the next exchange() worth while.
  pollfd awaited() const;

 private:
  void flush();
  void receive();

  Socket socket_;
  std::vector<std::uint8_t> received_, unsent_;
  Clock::time_point clogged_since_;
};

/// Waits until one of them is ready, but no longer than `until`; signals end it early.
void wait_for(std::span<pollfd> awaited, Connection::Clock::time_point until);

}  // namespace ostium::device
