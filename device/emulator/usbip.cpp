#include "device/emulator/usbip.h"

#include <arpa/inet.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <stdexcept>

#include "device/transport/usb_port.h"

namespace ostium::device {

namespace {

using Clock = std::chrono::steady_clock;
using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t header_bytes = 48;
constexpr std::uint32_t cmd_submit = 1, cmd_unlink = 2, ret_submit = 3, ret_unlink = 4;
constexpr std::uint32_t most_bytes = 4096;  // largest transfer: the box has none longer
constexpr int longest_put_off = 200;        // samples kept for an absent host; later ones are lost, as on a bus

std::uint32_t get_u32(const std::uint8_t* at) {
  return std::uint32_t{at[0]} << 24 | std::uint32_t{at[1]} << 16 | std::uint32_t{at[2]} << 8 | at[3];
}
std::uint16_t get_u16(const std::uint8_t* at) { return static_cast<std::uint16_t>(at[0] << 8 | at[1]); }
void add_u32(Bytes& to, std::uint32_t value) {
  for (const int shift : {24, 16, 8, 0}) to.push_back(static_cast<std::uint8_t>(value >> shift));
}
void add_u16(Bytes& to, std::uint16_t value) {
  to.push_back(static_cast<std::uint8_t>(value >> 8)), to.push_back(static_cast<std::uint8_t>(value));
}
void add_text(Bytes& to, const char* text, std::size_t length) {
  const std::size_t begin = to.size();
  to.resize(begin + length, 0);
  std::copy_n(text, std::min(std::strlen(text), length - 1), to.begin() + static_cast<std::ptrdiff_t>(begin));
}

Bytes header(std::uint32_t command, std::uint32_t number) {
  Bytes h;
  h.reserve(header_bytes);
  add_u32(h, command), add_u32(h, number);
  h.resize(20, 0);
  return h;
}

}  // namespace

UsbipLink::~UsbipLink() { close(socket_); }

bool UsbipLink::send_all(const Bytes& bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t count = send(socket_, bytes.data() + done, bytes.size() - done, MSG_NOSIGNAL);
    if (count <= 0 && errno != EINTR) return false;
    done += count > 0 ? static_cast<std::size_t>(count) : 0;
  }
  return true;
}

bool UsbipLink::reply(std::uint32_t number, std::int32_t status, std::uint32_t length, const Bytes& data) {
  Bytes h = header(ret_submit, number);
  add_u32(h, static_cast<std::uint32_t>(status)), add_u32(h, length);
  h.resize(header_bytes, 0);
  h.insert(h.end(), data.begin(), data.end());
  return send_all(h);
}

bool UsbipLink::take_command(const std::uint8_t* h, const Bytes& data) {
  const std::uint32_t command = get_u32(h), number = get_u32(h + 4), endpoint = get_u32(h + 16);
  const bool in = get_u32(h + 12) == 1;
  if (command == cmd_unlink) {
    const std::uint32_t which = get_u32(h + 20);
    const auto at = std::find_if(in_.begin(), in_.end(), [&](const Waiting& w) { return w.number == which; });
    const bool was_waiting = at != in_.end();
    if (was_waiting) in_.erase(at);
    Bytes answer = header(ret_unlink, number);
    add_u32(answer, static_cast<std::uint32_t>(was_waiting ? -ECONNRESET : 0));
    answer.resize(header_bytes, 0);
    return send_all(answer);
  }
  if (command != cmd_submit) return false;
  const std::uint32_t length = get_u32(h + 24);
  if (endpoint == 0) {
    const ControlReply answer = usb_.control({h + 40, 8}, data);
    if (!answer) return reply(number, -EPIPE, 0, {});
    return in ? reply(number, 0, static_cast<std::uint32_t>(answer->size()), *answer) : reply(number, 0, length, {});
  }
  if (!in) {
    if (endpoint != (emulated_out_endpoint & 0xf)) return reply(number, -EPIPE, 0, {});
    usb_.out(data);
    return reply(number, 0, length, {});
  }
  if (endpoint != (emulated_in_endpoint & 0xf)) return reply(number, -EPIPE, 0, {});
  in_.push_back({number, length});
  return true;
}

/// Processes all complete commands received. False: the host has left, or broke the protocol.
bool UsbipLink::receive() {
  std::uint8_t some[4096];
  const ssize_t count = recv(socket_, some, sizeof some, MSG_DONTWAIT);
  if (count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR)) return false;
  if (count > 0) received_.insert(received_.end(), some, some + count);
  while (received_.size() >= header_bytes) {
    const std::uint8_t* h = received_.data();
    const bool sends_data = get_u32(h) == cmd_submit && get_u32(h + 12) == 0;
    const std::uint32_t length = sends_data ? get_u32(h + 24) : 0;
    if (length > most_bytes) return false;
    if (received_.size() < header_bytes + length) break;
    const Bytes data(received_.begin() + header_bytes, received_.begin() + header_bytes + length);
    if (!take_command(h, data)) return false;
    received_.erase(received_.begin(), received_.begin() + header_bytes + length);
  }
  return true;
}

/// One millisecond of the bus. False: the host has left.
bool UsbipLink::tick(bool even_if_lost) {
  sampled_ = !in_.empty();
  if (!sampled_ && !even_if_lost) return true;
  const EmulatedUsb::Sample sample = usb_.sample();
  if (in_.empty() || (!sample.stall && !sample.error && sample.bytes.empty())) return true;
  const Waiting to = in_.front();
  in_.pop_front();
  if (sample.stall || sample.error) return reply(to.number, sample.stall ? -EPIPE : -EPROTO, 0, {});
  if (sample.bytes.size() > to.length) return reply(to.number, -EOVERFLOW, 0, {});
  return reply(to.number, 0, static_cast<std::uint32_t>(sample.bytes.size()), sample.bytes);
}

void UsbipLink::serve(const std::atomic<bool>& over, const std::atomic<bool>* fast) {
  using namespace std::chrono_literals;
  int put_off = 0;
  for (auto due = Clock::now() + 1ms; !over;) {
    const bool hurry = fast && *fast;
    const auto now = Clock::now();
    if (now >= due || (hurry && !in_.empty())) {
      due = std::max(now, hurry ? now : due) + 1ms;
      if (!tick(!hurry && put_off >= longest_put_off)) break;
      put_off = sampled_ ? 0 : put_off + 1;
      if (!sampled_) ++late_;
      continue;
    }
    pollfd one{socket_, POLLIN, 0};
    const auto left = std::chrono::duration_cast<std::chrono::nanoseconds>(due - now).count();
    const timespec wait{0, std::max<long>(0, left)};
    if (ppoll(&one, 1, &wait, nullptr) > 0 && !receive()) break;
  }
  usb_.detached();
}

// --- TCP -------------------------------------------------------------------------------------------------------------

namespace {

constexpr std::uint16_t version = 0x0111;
constexpr std::uint16_t req_devlist = 0x8005, rep_devlist = 0x0005, req_import = 0x8003, rep_import = 0x0003;
constexpr const char* bus_id = "1-1";

bool receive_all(int socket, std::uint8_t* to, std::size_t count) {
  for (std::size_t done = 0; done < count;) {
    const ssize_t some = recv(socket, to + done, count - done, 0);
    if (some <= 0) return false;
    done += static_cast<std::size_t>(some);
  }
  return true;
}

Bytes operation(std::uint16_t code, std::uint32_t status) {
  Bytes b;
  add_u16(b, version), add_u16(b, code), add_u32(b, status);
  return b;
}

void add_device(Bytes& to) {
  add_text(to, "/sys/devices/ostium/usb1/1-1", 256), add_text(to, bus_id, 32);
  add_u32(to, usbip_device >> 16), add_u32(to, usbip_device & 0xffff), add_u32(to, usbip_speed);
  add_u16(to, usb_vendor), add_u16(to, usb_product), add_u16(to, 0x0100);
  for (const int b : {0, 0, 0, 1, 1, 1}) to.push_back(static_cast<std::uint8_t>(b));
}

/// Handles a host's first request. True: the host has attached the box.
bool imported(int socket) {
  std::uint8_t request[8], busid[32];
  if (!receive_all(socket, request, sizeof request)) return false;
  Bytes answer;
  bool has_it = false;
  if (get_u16(request + 2) == req_devlist) {
    answer = operation(rep_devlist, 0);
    add_u32(answer, 1);
    add_device(answer);
    for (const int b : {int{usb_class}, int{usb_subclass}, int{usb_protocol}, 0})
      answer.push_back(static_cast<std::uint8_t>(b));
  } else if (get_u16(request + 2) == req_import && receive_all(socket, busid, sizeof busid)) {
    has_it = std::strncmp(reinterpret_cast<const char*>(busid), bus_id, sizeof busid) == 0;
    answer = operation(rep_import, has_it ? 0 : 1);
    if (has_it) add_device(answer);
  }
  return send(socket, answer.data(), answer.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(answer.size()) && has_it;
}

}  // namespace

void serve_usbip(EmulatedUsb& usb, std::uint16_t port, bool any_host, const std::atomic<bool>& over,
                 const std::function<void(const std::string&)>& say) {
  const int listener = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const int yes = 1;
  setsockopt(listener, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  sockaddr_in address{};
  address.sin_family = AF_INET, address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(any_host ? INADDR_ANY : INADDR_LOOPBACK);
  if (listener < 0 || bind(listener, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0 ||
      listen(listener, 4) != 0) {
    const std::string why = std::strerror(errno);
    if (listener >= 0) close(listener);
    throw std::runtime_error("port " + std::to_string(port) + " cannot be had: " + why);
  }
  while (!over) {
    pollfd one{listener, POLLIN, 0};
    if (poll(&one, 1, 100) <= 0) continue;
    const int host = accept4(listener, nullptr, nullptr, SOCK_CLOEXEC);
    if (host < 0) continue;
    setsockopt(host, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    const timeval patience{2, 0};
    setsockopt(host, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    UsbipLink link(usb, host);
    if (!imported(host)) continue;
    say("a host has attached the box");
    link.serve(over);
    say("the host has let go of the box");
  }
  close(listener);
}

}  // namespace ostium::device
