#include "device/emulator/usbip_link.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>

namespace ostium::device {

namespace {

constexpr std::chrono::milliseconds frame{1};
constexpr int longest_put_off = 200;  // samples kept for an absent host; later ones are lost, as on a bus

}  // namespace

void UsbipLink::reply(std::uint32_t number, std::int32_t status, std::uint32_t length,
                      std::span<const std::uint8_t> data) {
  host_.send(usbip_submit_reply(number, status, length, data));
}

void UsbipLink::take_back(const UsbipCommand& c) {
  const auto at = std::find_if(waiting_.begin(), waiting_.end(), [&](auto& w) { return w.number == c.unlinked; });
  const bool was_waiting = at != waiting_.end();
  if (was_waiting) waiting_.erase(at);
  host_.send(usbip_unlink_reply(c.number, was_waiting ? -ECONNRESET : 0));
}

void UsbipLink::take(const UsbipCommand& c) {
  if (c.unlinks) return take_back(c);
  if (c.endpoint == 0) {
    const ControlReply answer = usb_.control(c.setup, c.data);
    if (!answer) return reply(c.number, -EPIPE, 0);
    if (!c.in) return reply(c.number, 0, c.length);
    const auto length = std::min(c.length, static_cast<std::uint32_t>(answer->size()));
    return reply(c.number, 0, length, std::span(*answer).first(length));
  }
  if (c.endpoint != ((c.in ? emulated_in_endpoint : emulated_out_endpoint) & 0xf)) return reply(c.number, -EPIPE, 0);
  if (!c.in) {
    usb_.out(c.data);
    return reply(c.number, 0, c.length);
  }
  if (waiting_.size() == most_waiting)
    throw ConnectionEnd(fmt::format("the host has more than {} transfers waiting", most_waiting));
  waiting_.push_back({c.number, c.length});
}

/// The next sample goes to the oldest transfer.
void UsbipLink::sample() {
  const EmulatedUsb::Sample sample = usb_.sample();
  if (!sample.stall && !sample.error && sample.bytes.empty()) return;
  const Waiting to = waiting_.front();
  waiting_.pop_front();
  if (sample.stall || sample.error) return reply(to.number, sample.stall ? -EPIPE : -EPROTO, 0);
  if (sample.bytes.size() > to.length) return reply(to.number, -EOVERFLOW, 0);
  reply(to.number, 0, static_cast<std::uint32_t>(sample.bytes.size()), sample.bytes);
}

Connection::Clock::time_point UsbipLink::due(bool fast) const {
  return fast && can_sample() ? Connection::Clock::time_point{} : due_;
}

void UsbipLink::go_on(bool fast) {
  host_.exchange();
  while (!host_.clogged()) {
    const auto command = parse_usbip_command(host_.received());
    if (!command) break;
    take(*command);
    host_.drop(command->bytes);
  }
  const auto now = Connection::Clock::now();
  if (now < due(fast)) return;
  due_ = now + frame;
  if (can_sample()) {
    put_off_ = 0;
    return sample();
  }
  ++late_;
  if (put_off_ < longest_put_off)
    ++put_off_;
  else if (!fast)
    usb_.sample();
}

std::string UsbipLink::serve(const std::atomic<bool>& over, const std::atomic<bool>* fast) try {
  while (!over) {
    const bool hurry = fast && *fast;
    pollfd one = awaited();
    wait_for({&one, 1}, due(hurry));
    go_on(hurry);
  }
  return "it was asked to end";
} catch (const ConnectionEnd& end) {
  return end.what();
}

}  // namespace ostium::device
