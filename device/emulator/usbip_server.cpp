#include "device/emulator/usbip_server.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace ostium::device {

UsbipServer::UsbipServer(EmulatedUsb& usb, std::uint16_t port, bool any_host,
                         std::function<void(const std::string&)> say)
    : usb_(usb), say_(std::move(say)), listener_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {
  const int yes = 1;
  setsockopt(listener_.number(), SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  sockaddr_in address{};
  address.sin_family = AF_INET, address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(any_host ? INADDR_ANY : INADDR_LOOPBACK);
  if (bind(listener_.number(), reinterpret_cast<sockaddr*>(&address), sizeof address) != 0 ||
      listen(listener_.number(), SOMAXCONN) != 0)
    throw std::runtime_error(fmt::format("port {} cannot be had: {}", port, std::strerror(errno)));
}

std::uint16_t UsbipServer::port() const {
  sockaddr_in address{};
  socklen_t length = sizeof address;
  getsockname(listener_.number(), reinterpret_cast<sockaddr*>(&address), &length);
  return ntohs(address.sin_port);
}

void UsbipServer::serve(const std::function<bool()>& over) {
  while (!over()) {
    wait();
    serve_attached();
    accept_host();
    asking_.remove_if([this](Asking& host) { return is_done(host); });
  }
  asking_.clear();
  attached_.reset();
}

void UsbipServer::wait() {
  auto until = Connection::Clock::now() + std::chrono::milliseconds(50);
  awaited_.assign(1, {listener_.number(), POLLIN, 0});
  for (const Asking& host : asking_) awaited_.push_back(host.connection.awaited());
  if (attached_) awaited_.push_back(attached_->awaited()), until = std::min(until, attached_->due());
  wait_for(awaited_, until);
}

void UsbipServer::serve_attached() try {
  if (attached_) attached_->go_on();
} catch (const ConnectionEnd& end) {
  attached_.reset();
  say_(fmt::format("the box is free again: {}", end.what()));
}

void UsbipServer::accept_host() {
  const int socket = accept4(listener_.number(), nullptr, nullptr, SOCK_CLOEXEC);
  if (socket < 0) return;  // none came, or it has left already
  if (asking_.size() == most_asking) {
    say_("a connection is ended: too many hosts ask nothing");
    asking_.pop_front();
  }
  asking_.push_back({Connection(socket), Connection::Clock::now() + time_to_ask});
  asking_.back().connection.notice_death();
}

/// True: it was answered, or its connection ends.
bool UsbipServer::is_done(Asking& host) try {
  host.connection.exchange();
  if (const auto request = parse_usbip_request(host.connection.received())) {
    answer(*request, host.connection);
    return true;
  }
  if (Connection::Clock::now() < host.until) return false;
  throw ConnectionEnd(fmt::format("the host asked nothing within {} s", time_to_ask.count()));
} catch (const ConnectionEnd& end) {
  say_(fmt::format("a connection is ended: {}", end.what()));
  return true;
}

void UsbipServer::answer(const UsbipRequest& request, Connection& host) {
  if (!request.attaches) return host.send(usbip_list_answer());
  serve_attached();  // who had the box may have left just before this one asked
  const UsbipStatus status = request.bus_id != usbip_bus_id ? UsbipStatus::no_such_device
                             : attached_                    ? UsbipStatus::in_use
                                                            : UsbipStatus::ok;
  host.send(usbip_attach_answer(status));
  if (status == UsbipStatus::in_use) say_("a host is refused: another one has the box");
  if (status == UsbipStatus::no_such_device) say_("a host is refused: it asks for another device");
  if (status != UsbipStatus::ok) return;
  host.drop(request.bytes);
  attached_.emplace(usb_, std::move(host));
  say_("a host has attached the box");
}

}  // namespace ostium::device
