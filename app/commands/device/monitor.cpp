#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/command_line/common_options.h"
#include "app/command_line/interrupt.h"
#include "app/commands/device/device.h"
#include "app/commands/device/words.h"
#include "core/base/units.h"
#include "device/emulator/emulated_port.h"
#include "device/emulator/stroking_hand.h"
#include "device/host/round_trips.h"
#include "device/host/tracking_box.h"
#include "device/transport/usb_port.h"

namespace ostium::app {

namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
  std::string serial;     ///< of the box; empty: the first one found
  double seconds = 0;     ///< 0: until Ctrl-C
  bool arm = false;       ///< arms the clamps, which stay open
  double push_N = 0;      ///< arms the clamps and resists every push with this force
  bool emulator = false;  ///< use an emulated box in this process
  bool json = false;
};

void declare(Options& options, Arguments& a) {
  add_box_serial_option(options, a.serial);
  options.add("--seconds", a.seconds, "Then end; else at Ctrl-C").range(0.01, 1e6);
  options.flag("--arm", a.arm, "Arm the clamps; they stay open");
  options.add("--push", a.push_N, "Arm them, and resist every push with so many N").range(0.0, 8.0);
  options.flag("--emulator", a.emulator, "An emulated box whose wire goes in and out");
  options.flag("--json", a.json, "A line of JSON a second");
}

constexpr const char* tool_names[device::tools] = {"guide", "wire", "shaft", "second wire"};

/// The chosen port and the objects it needs.
struct Source {
  std::unique_ptr<device::EmulatedBox> box;
  std::unique_ptr<device::StrokingHand> hand;
  std::unique_ptr<device::Port> port;

  explicit Source(const Arguments& a) {
    if (!a.emulator) {
      port = std::make_unique<device::UsbPort>(a.serial);
      return;
    }
    device::Calibration c;
    c.serial = device::emulated_serial;
    require_emulated_box(a.serial);
    box = std::make_unique<device::EmulatedBox>(c);
    hand = std::make_unique<device::StrokingHand>();
    port = std::make_unique<device::EmulatedPort>(*box, [h = hand.get()](device::EmulatedBox& b) { h->move(b); });
  }
};

Json to_json(const device::BoxSnapshot& now, const device::RoundTrips& trips) {
  Json out = {{"link", words(now.link)},
              {"trouble", words(now.trouble)},
              {"advice", advice(now)},
              {"box_s", now.box_s},
              {"reports", now.reports},
              {"lost", now.lost},
              {"ignored", now.ignored},
              {"armed", now.armed},
              {"watchdog", now.watchdog},
              {"pause", words(now.pause)},
              {"pressure_atm", now.pressure_Pa / 101'325},
              {"flow_mL_s", 1e6 * now.flow_m3_s},
              {"pedals", now.pedals},
              {"round_trip_ms", {{"median", 1e3 * trips.percentile_s(0.5)}, {"p99", 1e3 * trips.percentile_s(0.99)}}}};
  for (std::size_t i = 0; i < device::tools; ++i) {
    const device::ToolSnapshot& t = now.tool[i];
    out["tools"][tool_names[i]] = {{"sight", words(t.sight)},
                                   {"quality", t.quality},
                                   {"arrivals", t.arrivals},
                                   {"inserted_mm", 1e3 * t.inserted_m},
                                   {"in_box_mm", 1e3 * t.in_box_m},
                                   {"fed_mm", 1e3 * t.fed_m},
                                   {"turned_deg", t.turned_rad * 180 / units::pi},
                                   {"clamp_N", t.clamp_N},
                                   {"brake_mNm", 1e3 * t.brake_Nm}};
  }
  return out;
}

std::string table(const device::BoxSnapshot& now, const device::RoundTrips& trips, double rate_Hz) {
  std::string out = fmt::format("{:<10} {:>9.1f} s of the box, {:.0f} Hz; {} reports, {} lost, {} ignored{}{}\n",
                                words(now.link), now.box_s, rate_Hz, now.reports, now.lost, now.ignored,
                                now.armed ? "; armed" : "", now.watchdog ? "; watchdog" : "");
  for (std::size_t i = 0; i < device::tools; ++i) {
    const device::ToolSnapshot& t = now.tool[i];
    out += fmt::format(
        "  {:<12} {:<7} {:>3}  inserted {:>8.2f} mm, in the box {:>7.2f} mm, turned {:>8.1f} deg, clamp {:.2f} N{}\n",
        tool_names[i], words(t.sight), t.quality, 1e3 * t.inserted_m, 1e3 * t.in_box_m, t.turned_rad * 180 / units::pi,
        t.clamp_N, t.brake_Nm > 0 ? fmt::format(", brake {:.2f} mNm", 1e3 * t.brake_Nm) : "");
  }
  out += fmt::format(
      "  pressure {:.2f} atm, flow {:.2f} mL/s, pedals {:04x}; round trip median {:.2f} ms, 99 % {:.2f} ms\n",
      now.pressure_Pa / 101'325, 1e6 * now.flow_m3_s, now.pedals, 1e3 * trips.percentile_s(0.5),
      1e3 * trips.percentile_s(0.99));
  return out + fmt::format("  {}\n", advice(now));
}

/// Shows the state of the box on the terminal.
class Display {
 public:
  explicit Display(bool json) : json_(json), redraw_(isatty(STDOUT_FILENO) && !json) {}

  /// Ten times a second on a terminal, else once; and whenever the box comes or goes.
  bool is_due(const device::BoxSnapshot& now, double now_s) const {
    return now_s - shown_s_ >= (redraw_ ? 0.1 : 1) || (now.link != shown_link_ && now_s - begin_s_ > 0.2);
  }

  void show(const device::BoxSnapshot& now, const device::RoundTrips& trips, double now_s) {
    if (json_) {
      fmt::print("{}\n", to_json(now, trips).dump());
    } else {
      const double rate_Hz = static_cast<double>(now.reports - shown_reports_) / std::max(1e-3, now_s - shown_s_);
      if (redraw_ && lines_) fmt::print("\033[{}A\033[J", lines_);
      const std::string text = table(now, trips, rate_Hz);
      lines_ = static_cast<int>(std::count(text.begin(), text.end(), '\n'));
      fmt::print("{}", text);
    }
    std::fflush(stdout);
    shown_s_ = now_s, shown_reports_ = now.reports, shown_link_ = now.link;
  }

  double begin_s() const { return begin_s_; }

 private:
  bool json_, redraw_;
  double begin_s_ = clock_s(), shown_s_ = begin_s_;
  std::uint64_t shown_reports_ = 0;
  device::Link shown_link_ = device::Link::running;
  int lines_ = 0;
};

/// Exit code: 0 if reports came and none was lost, else 1.
int run(const Arguments& a) {
  stop_on_signals();
  Source source(a);
  device::TrackingBox box(*source.port, {});
  device::BoxRequest request;
  request.arm = a.arm || a.push_N > 0;
  for (device::ClampLoad& load : request.load) load.push_N = a.push_N;
  device::RoundTrips trips;
  Display display(a.json);
  while (!interrupted) {
    const double now_s = clock_s(), since_s = now_s - display.begin_s();
    if (a.seconds > 0 && since_s >= a.seconds) break;
    if (a.emulator && box.now().box_s > since_s) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      continue;
    }
    request.step_s = now_s;
    box.poll(0.02, request);
    trips.add(box.now().round_trip);
    if (display.is_due(box.now(), now_s)) display.show(box.now(), trips, now_s);
  }
  display.show(box.now(), trips, clock_s());
  return box.now().reports > 0 && box.now().lost == 0 ? 0 : 1;
}

}  // namespace

Command device_monitor_command() {
  return make_command("monitor", "What the box says: tools, pressure, flow, pedals",
                      {"ostium device monitor", "ostium device monitor --emulator --seconds 20 --json"}, declare, run);
}

}  // namespace ostium::app
