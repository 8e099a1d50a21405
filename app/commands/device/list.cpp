#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/command_line/common_options.h"
#include "app/commands/device/device.h"
#include "app/commands/device/words.h"
#include "device/host/tracking_box.h"
#include "device/transport/usb_port.h"

namespace ostium::app {

namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
  bool json = false;
};

void declare(Options& options, Arguments& a) { add_json_flag(options, a.json); }

Json to_json(const device::FoundBox& box) {
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

void print(const device::FoundBox& box) {
  fmt::print("{:<16} {}, {}", box.identity.serial.empty() ? "?" : box.identity.serial, box.identity.product,
             box.identity.place);
  if (box.info)
    fmt::print("; protocol {}, firmware {}, {} tracks, {} Hz, watchdog {} ms", box.info->version, box.info->firmware,
               box.info->tracks, box.info->rate_Hz, box.info->watchdog_ms);
  if (box.calibration) fmt::print("; calibrated {}", box.calibration->date);
  if (!box.calibration_problem.empty()) fmt::print("; {}", box.calibration_problem);
  device::BoxSnapshot now;
  now.trouble = box.trouble;
  fmt::print("{}{}\n", box.trouble == device::PortTrouble::none ? "" : "\n  ",
             box.trouble == device::PortTrouble::none ? "" : advice(now));
}

/// Exit code: 0 if a box is found, else 1.
int run(const Arguments& a) {
  const std::vector<device::FoundBox> boxes = device::find_boxes();
  if (a.json) {
    auto out = Json::array();
    for (const device::FoundBox& box : boxes) out.push_back(to_json(box));
    fmt::print("{}\n", out.dump(2));
  } else {
    for (const device::FoundBox& box : boxes) print(box);
    if (boxes.empty()) fmt::print(stderr, "ostium device: no tracking box is plugged in (1209:0001)\n");
  }
  return boxes.empty() ? 1 : 0;
}

}  // namespace

Command device_list_command() { return make_command("list", "Boxes that are plugged in", {}, declare, run); }

}  // namespace ostium::app
