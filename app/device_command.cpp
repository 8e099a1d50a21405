#include "app/device_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <numbers>
#include <thread>

#include "data/formats/load_error.h"
#include "device/emulated_port.h"
#include "device/round_trips.h"
#include "device/stroking_hand.h"
#include "device/tracking_box.h"
#include "device/usb_port.h"
#include "device/usbip.h"

namespace ostium {

namespace {

using Json = nlohmann::ordered_json;

std::atomic<bool> interrupted{false};

void stop_on_signals() {
  const auto ask_to_stop = [](int) { interrupted = true; };
  std::signal(SIGINT, ask_to_stop);
  std::signal(SIGTERM, ask_to_stop);
}

double clock_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

constexpr const char* tool_names[tools] = {"guide", "wire", "shaft", "second wire"};

const char* words(Sight sight) { return sight == Sight::seen ? "seen" : sight == Sight::lost ? "LOST" : "absent"; }

const char* words(Link link) {
  constexpr const char* all[] = {"unplugged", "silent", "wrong version", "stopped", "running"};
  return all[static_cast<int>(link)];
}

const char* words(PortTrouble trouble) {
  constexpr const char* all[] = {"", "no access", "in use", "not a box", "stalled", "failing"};
  return all[static_cast<int>(trouble)];
}

const char* words(Pause pause) {
  return pause == Pause::none ? "" : pause == Pause::travel_full ? "travel full" : "travel empty";
}

/// The port that is asked for, with what belongs to it.
struct Source {
  std::unique_ptr<EmulatedBox> box;
  std::unique_ptr<StrokingHand> hand;
  std::unique_ptr<Port> port;

  explicit Source(const DeviceOptions& o) {
    if (!o.emulator) {
      port = std::make_unique<UsbPort>(o.serial);
      return;
    }
    Calibration c;
    c.serial = "EMULATED";
    box = std::make_unique<EmulatedBox>(c);
    hand = std::make_unique<StrokingHand>();
    port = std::make_unique<EmulatedPort>(*box, [h = hand.get()](EmulatedBox& b) { h->move(b); });
  }
};

Json to_json(const BoxSnapshot& now, const RoundTrips& trips) {
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
  for (std::size_t i = 0; i < tools; ++i) {
    const ToolSnapshot& t = now.tool[i];
    out["tools"][tool_names[i]] = {{"sight", words(t.sight)},
                                   {"quality", t.quality},
                                   {"arrivals", t.arrivals},
                                   {"inserted_mm", 1e3 * t.inserted_m},
                                   {"in_box_mm", 1e3 * t.in_box_m},
                                   {"fed_mm", 1e3 * t.fed_m},
                                   {"turned_deg", t.turned_rad * 180 / std::numbers::pi},
                                   {"clamp_N", t.clamp_N}};
  }
  return out;
}

std::string table(const BoxSnapshot& now, const RoundTrips& trips, double rate_Hz) {
  std::string out = fmt::format("{:<10} {:>9.1f} s of the box, {:.0f} Hz; {} reports, {} lost, {} ignored{}{}\n",
                                words(now.link), now.box_s, rate_Hz, now.reports, now.lost, now.ignored,
                                now.armed ? "; armed" : "", now.watchdog ? "; watchdog" : "");
  for (std::size_t i = 0; i < tools; ++i) {
    const ToolSnapshot& t = now.tool[i];
    out += fmt::format(
        "  {:<12} {:<7} {:>3}  inserted {:>8.2f} mm, in the box {:>7.2f} mm, turned {:>8.1f} deg, clamp {:.2f} N\n",
        tool_names[i], words(t.sight), t.quality, 1e3 * t.inserted_m, 1e3 * t.in_box_m,
        t.turned_rad * 180 / std::numbers::pi, t.clamp_N);
  }
  out += fmt::format(
      "  pressure {:.2f} atm, flow {:.2f} mL/s, pedals {:04x}; round trip median {:.2f} ms, 99 % {:.2f} ms\n",
      now.pressure_Pa / 101'325, 1e6 * now.flow_m3_s, now.pedals, 1e3 * trips.percentile_s(0.5),
      1e3 * trips.percentile_s(0.99));
  return out + fmt::format("  {}\n", advice(now));
}

Json to_json(const FoundBox& box) {
  Json out = {{"serial", box.identity.serial},
              {"product", box.identity.product},
              {"place", box.identity.place},
              {"trouble", words(box.trouble)}};
  if (box.info)
    out.update({{"protocol", box.info->version},
                {"tracks", box.info->tracks},
                {"firmware", box.info->firmware},
                {"rate_Hz", box.info->rate_Hz},
                {"watchdog_ms", box.info->watchdog_ms}});
  if (box.calibration) out["calibrated"] = box.calibration->date;
  if (!box.calibration_problem.empty()) out["calibration_problem"] = box.calibration_problem;
  return out;
}

}  // namespace

int device_list_command(const DeviceOptions& o) {
  const std::vector<FoundBox> boxes = find_boxes();
  if (o.json) {
    auto out = Json::array();
    for (const FoundBox& box : boxes) out.push_back(to_json(box));
    fmt::print("{}\n", out.dump(2));
  } else {
    for (const FoundBox& box : boxes) {
      fmt::print("{:<16} {}, {}", box.identity.serial.empty() ? "?" : box.identity.serial, box.identity.product,
                 box.identity.place);
      if (box.info)
        fmt::print("; protocol {}, firmware {}, {} tracks, {} Hz, watchdog {} ms", box.info->version,
                   box.info->firmware, box.info->tracks, box.info->rate_Hz, box.info->watchdog_ms);
      if (box.calibration) fmt::print("; calibrated {}", box.calibration->date);
      if (!box.calibration_problem.empty()) fmt::print("; {}", box.calibration_problem);
      BoxSnapshot now;
      now.trouble = box.trouble;
      fmt::print("{}{}\n", box.trouble == PortTrouble::none ? "" : "\n  ",
                 box.trouble == PortTrouble::none ? "" : advice(now));
    }
    if (boxes.empty()) fmt::print(stderr, "ostium device: no tracking box is plugged in (1209:0001)\n");
  }
  return boxes.empty() ? 1 : 0;
}

int device_monitor_command(const DeviceOptions& o) {
  stop_on_signals();
  Source source(o);
  TrackingBox box(*source.port, {});
  BoxRequest request;
  request.arm = o.arm || o.push_N > 0;
  for (ClampLoad& load : request.load) load.push_N = o.push_N;
  RoundTrips trips;
  const bool redraw = isatty(STDOUT_FILENO) && !o.json;
  const double begin_s = clock_s();
  double shown_s = begin_s, shown_box_s = 0;
  std::uint64_t shown_reports = 0;
  Link shown_link = Link::running;
  int lines = 0;
  const auto show = [&](double now_s) {
    const BoxSnapshot& now = box.now();
    if (o.json) {
      fmt::print("{}\n", to_json(now, trips).dump());
    } else {
      const double rate_Hz = static_cast<double>(now.reports - shown_reports) / std::max(1e-3, now_s - shown_s);
      if (redraw && lines) fmt::print("\033[{}A\033[J", lines);
      const std::string text = table(now, trips, rate_Hz);
      lines = static_cast<int>(std::count(text.begin(), text.end(), '\n'));
      fmt::print("{}", text);
    }
    std::fflush(stdout);
    shown_s = now_s, shown_box_s = now.box_s, shown_reports = now.reports, shown_link = now.link;
  };
  while (!interrupted) {
    const double now_s = clock_s();
    if (o.seconds > 0 && now_s - begin_s >= o.seconds) break;
    if (o.emulator && box.now().box_s > now_s - begin_s) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      continue;
    }
    request.step_s = now_s;
    box.poll(0.02, request);
    trips.add(box.now().round_trip);
    if (now_s - shown_s >= (redraw ? 0.1 : 1) || (box.now().link != shown_link && now_s - begin_s > 0.2)) show(now_s);
  }
  show(clock_s());
  return box.now().reports > 0 && box.now().lost == 0 ? 0 : 1;
}

int device_emulate_command(const DeviceOptions& o) {
  stop_on_signals();
  Calibration c;
  c.serial = "EMULATED";
  for (TrackCalibration& track : c.track) track.before_introducer_mm = 20;
  EmulatedUsb usb(c);
  StrokingHand hand;
  if (!o.still) usb.hand = [&](EmulatedBox& box) { hand.move(box); };
  std::atomic<bool> over{false};
  std::thread clock([&] {
    for (const double begin_s = clock_s(); !interrupted && (o.seconds <= 0 || clock_s() < begin_s + o.seconds);)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    over = true;
  });
  fmt::print(stderr,
             "an emulated box on port {}; on Linux, as root:\n  modprobe vhci_hcd && usbip attach -r {} -b 1-1\n"
             "Ctrl-C ends it\n",
             o.port, o.any_host ? "THIS_MACHINE" : "127.0.0.1");
  std::string problem;
  try {
    serve_usbip(usb, static_cast<std::uint16_t>(o.port), o.any_host, over,
                [](const std::string& what) { fmt::print(stderr, "{}\n", what); });
  } catch (const std::exception& error) {
    problem = error.what();
    interrupted = true;
  }
  clock.join();
  if (!problem.empty()) throw LoadError(problem);
  return 0;
}

}  // namespace ostium
