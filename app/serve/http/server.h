#pragma once
/// HTTP and WebSockets for one page, on a thread of its own. What it is given to send it sends as each client can take
/// it: of pictures the newest only, of everything else all, in order. A client that stalls, floods or sends nonsense
/// loses its connection, and nobody else notices.
///
/// Clients name no file: what can be fetched is a list in memory. Only a Host that the server was asked to be, and a
/// page of its own (Origin), is answered; others get 403. A WebSocket's first message must be
/// {"do": "hello", "token": "..."}.
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace ostium::app {

enum class Role { trainer, viewer };

/// Something that can be fetched by GET.
struct Page {
  std::string path, type, text;  ///< "/", "text/html; charset=utf-8"
};

/// Of messages of a channel only the newest is sent. `all`: none is left out.
enum class Channel { all, frame, reference, truth, now };
inline constexpr int newest_only_channels = 4;

struct Message {
  std::string bytes;
  bool binary = false;
};
using SharedMessage = std::shared_ptr<const Message>;

/// What the server asks of its owner, on the server's thread.
class Listener {
 public:
  virtual ~Listener() = default;
  /// Sent first to one who has come in.
  virtual std::vector<std::string> greet(Role role) = 0;
  /// The answer to a message; empty: none.
  virtual std::string hear(Role role, const std::string& text) = 0;
  /// The trainer's connection has ended, or is silent.
  virtual void lost_trainer() = 0;
};

struct ServerSettings {
  std::string address = "127.0.0.1";
  std::uint16_t port = 0;               ///< 0: any that is free
  std::vector<std::string> host_names;  ///< beside the address and, on loopback, localhost; without port
  std::string trainer_token, viewer_token;
  std::vector<Page> pages;
  // Limits:
  std::size_t most_connections = 48, most_viewers = 40;  ///< the rest is for pages and the trainer
  std::size_t message_bytes = 8192, most_waiting = 4000;
  double messages_per_s = 120, burst = 240;
  double hello_s = 5, stall_s = 10, request_s = 10;
};

class Server {
 public:
  /// Throws std::runtime_error if the address cannot be listened at.
  Server(ServerSettings settings, Listener& listener);
  ~Server();  ///< ends all connections and the thread
  Server(const Server&) = delete;

  std::uint16_t port() const;
  // From any thread; never waits for a client:
  void send(Channel channel, Message message);
  void forget(Channel channel);  ///< those who come later do not get its last message
  void greet_all();              ///< afresh: something else is played from here on; what was newest is forgotten
  int connections() const;       ///< that have said hello

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// 256 bits at random, as 64 hexadecimal digits.
std::string make_token();
bool is_loopback(const std::string& address);

}  // namespace ostium::app
