#pragma once
/// One client of the server: requests, then perhaps a WebSocket. Runs on the server's thread.
#include <array>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <deque>
#include <optional>
#include <set>

#include "app/serve/http/server.h"

namespace ostium::app {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using tcp = asio::ip::tcp;

class Connection;

/// What all connections share.
struct Hub {
  ServerSettings settings;
  Listener& listener;
  std::vector<std::string> hosts;  ///< allowed, with port
  std::set<std::shared_ptr<Connection>> connections;
  std::array<SharedMessage, newest_only_channels> newest;
};

class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(tcp::socket socket, Hub& hub);
  void begin();
  void send(Channel channel, const SharedMessage& message);
  void greet();  ///< if it has said hello
  void close();  ///< at once
  bool is_in() const { return role_.has_value(); }
  bool is_trainer() const { return role_ == Role::trainer; }
  std::chrono::steady_clock::time_point born() const { return born_; }

 private:
  using Clock = std::chrono::steady_clock;
  void read_request();
  void answer(beast::error_code error);
  bool is_ours() const;
  void reply(http::status status, const std::string& type, const std::string& text);
  void open_socket();
  void read_message();
  void hear(beast::error_code error);
  bool let_in(const std::string& text);
  bool too_many();
  std::size_t viewers() const;
  void write_next();
  void watch();

  Hub& hub_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::empty_body>> request_;
  http::response<http::string_body> response_;
  websocket::stream<beast::tcp_stream> socket_;
  asio::steady_timer timer_;
  bool is_socket_ = false, closed_ = false;
  std::optional<Role> role_;
  const Clock::time_point born_ = Clock::now();
  Clock::time_point since_ = born_, writing_since_, allowed_at_ = Clock::now(), heard_at_ = Clock::now();
  double allowed_;  ///< messages that may come at once
  bool quiet_ = true;
  std::array<SharedMessage, newest_only_channels> newest_;
  std::size_t next_channel_ = 0;
  std::deque<SharedMessage> waiting_;
  SharedMessage writing_;
};

}  // namespace ostium::app
