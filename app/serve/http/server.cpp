#include "app/serve/http/server.h"

#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <random>
#include <stdexcept>
#include <thread>

#include "app/serve/http/connection.h"
#include "core/base/thread_priority.h"

namespace ostium::app {

struct Server::Parts {
  Parts(ServerSettings settings, Listener& listener)
      : hub{std::move(settings), listener, {}, {}, {}}, acceptor(context), retry(context) {}

  asio::io_context context{1};
  Hub hub;
  tcp::acceptor acceptor;
  asio::steady_timer retry;
  std::uint16_t port = 0;
  std::atomic<int> inside{0};
  std::thread thread;

  void listen() {
    beast::error_code error;
    const auto address = asio::ip::make_address(hub.settings.address, error);
    const tcp::endpoint at(address, hub.settings.port);
    if (!error) acceptor.open(at.protocol(), error);
    if (!error) acceptor.set_option(asio::socket_base::reuse_address(true), error);
    if (!error) acceptor.bind(at, error);
    if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
    if (error)
      throw std::runtime_error(hub.settings.address + ":" + std::to_string(hub.settings.port) +
                               ": cannot be listened at (" + error.message() +
                               "); expected an address of this machine and a free port");
    port = acceptor.local_endpoint().port();
    const std::string own = address.is_v6() ? "[" + address.to_string() + "]" : address.to_string();
    std::vector<std::string> names = hub.settings.host_names;
    names.push_back(own);
    if (address.is_loopback()) names.emplace_back("localhost");
    for (const std::string& name : names) hub.hosts.push_back(name + ":" + std::to_string(port));
    constexpr int port_of_http = 80;  // which browsers leave out
    if (port == port_of_http) hub.hosts.insert(hub.hosts.end(), names.begin(), names.end());
  }

  void accept() {
    acceptor.async_accept([this](beast::error_code error, tcp::socket socket) {
      // Closed: perhaps after this one had come in, and then without an error here.
      if (error == asio::error::operation_aborted || !acceptor.is_open()) return;
      if (error) {  // out of descriptors, say: not at once again
        retry.expires_after(std::chrono::milliseconds(100));
        retry.async_wait([this](beast::error_code stopped) {
          if (!stopped && acceptor.is_open()) accept();
        });
        return;
      }
      if (hub.connections.size() >= hub.settings.most_connections) end_oldest_stranger();
      if (hub.connections.size() < hub.settings.most_connections) {
        const auto connection = std::make_shared<Connection>(std::move(socket), hub);
        hub.connections.insert(connection);
        connection->begin();
      }
      accept();
    });
  }

  /// Whoever comes gets the place of the first that has said no hello, so that many who say nothing keep nobody out.
  void end_oldest_stranger() {
    std::shared_ptr<Connection> oldest;
    for (const auto& connection : hub.connections)
      if (!connection->is_in() && (!oldest || connection->born() < oldest->born())) oldest = connection;
    if (oldest) oldest->close();
  }

  void send(Channel channel, const SharedMessage& message) {
    if (channel != Channel::all) hub.newest[static_cast<std::size_t>(channel) - 1] = message;
    int count = 0;
    // A connection that ends leaves the set.
    for (const auto& connection : std::vector(hub.connections.begin(), hub.connections.end())) {
      connection->send(channel, message);
      count += connection->is_in();
    }
    inside = count;
  }
};

Server::Server(ServerSettings settings, Listener& listener)
    : parts_(std::make_unique<Parts>(std::move(settings), listener)) {
  Parts& p = *parts_;
  p.listen();
  p.accept();
  p.thread = std::thread([&p] {
    core::give_way_to_steps();
    p.context.run();
  });
}

Server::~Server() {
  Parts& p = *parts_;
  asio::post(p.context, [&p] {
    p.acceptor.close();
    p.retry.cancel();
    for (const auto& connection : std::vector(p.hub.connections.begin(), p.hub.connections.end())) connection->close();
  });
  p.thread.join();
}

std::uint16_t Server::port() const { return parts_->port; }
int Server::connections() const { return parts_->inside; }

void Server::send(Channel channel, Message message) {
  asio::post(parts_->context, [p = parts_.get(), channel, m = std::make_shared<const Message>(std::move(message))] {
    p->send(channel, m);
  });
}

void Server::forget(Channel channel) {
  asio::post(parts_->context,
             [p = parts_.get(), channel] { p->hub.newest[static_cast<std::size_t>(channel) - 1].reset(); });
}

void Server::greet_all() {
  asio::post(parts_->context, [p = parts_.get()] {
    p->hub.newest = {};
    for (const auto& connection : std::vector(p->hub.connections.begin(), p->hub.connections.end()))
      connection->greet();
  });
}

std::string make_token() {
  std::random_device random;  // the system's
  std::string token;
  for (int i = 0; i < 64; ++i) token += "0123456789abcdef"[random() & 15];
  return token;
}

bool is_loopback(const std::string& address) {
  beast::error_code error;
  const auto ip = asio::ip::make_address(address, error);
  return !error && ip.is_loopback();
}

}  // namespace ostium::app
