#include "device/host/link.h"

namespace ostium::device {

void plugged_in(LinkState& state) {
  if (!state.plugged) state = {true, false, false, false, 0, state.taken, state.ignored};
}

void unplugged(LinkState& state) { state = {false, false, false, false, 0, state.taken, state.ignored}; }

void time_passed(double elapsed_s, LinkState& state) { state.quiet_s += elapsed_s; }

std::optional<InReport> received(std::span<const std::uint8_t> bytes, LinkState& state) {
  const Flaw flaw = flaw_of_in_report(bytes);
  const auto report = parse_in_report(bytes);
  if (!report) {
    ++state.ignored;
    state.wrong_version |= flaw == Flaw::version;
    return {};
  }
  ++state.taken;
  state.heard = true, state.wrong_version = false, state.quiet_s = 0;
  state.stopped = report->emergency_stop || report->over_temperature;
  return report;
}

Link link(const LinkState& state) {
  if (!state.plugged) return Link::unplugged;
  if (state.quiet_s > silent_after_s || !state.heard) return state.wrong_version ? Link::wrong_version : Link::silent;
  return state.stopped ? Link::stopped : Link::running;
}

std::string_view advice(Link link) {
  switch (link) {
    case Link::unplugged:
      return "The tracking box is not plugged in. Plug it in: a session goes on where it was.";
    case Link::silent:
      return "The tracking box is plugged in but says nothing. Unplug it and plug it in again.";
    case Link::wrong_version:
      return "The tracking box speaks another version of the protocol. Update its firmware or Ostium.";
    case Link::stopped:
      return "The tracking box was stopped: emergency stop or heat. Its clamps are open. Release the stop, arm again.";
    case Link::running:
      return "";
  }
  return "";
}

}  // namespace ostium::device
