#pragma once
/// A short angioplasty from ahead of the ostium, for tests of treatment by rods.
#include <memory>
#include <string>

#include "app/session/run/run.h"

namespace ostium::app {

inline const char* const predilatation = R"({
  "schema": "ostium-script/1", "name": "predilatation", "title": "A test",
  "tools": [ { "name": "guide", "instrument": "guide-jr4-6f" }, { "name": "balloon", "instrument": "balloon-nc-25x12" },
             { "name": "stent", "instrument": "stent-325x15" }, { "name": "wire", "instrument": "wire-014-workhorse" } ],
  "steps": [
    { "do": "fluoroscopy", "on": true },
    { "do": "advance", "tool": "guide", "speed_mm_s": 15, "until": [{ "inserted_mm": 17 }], "timeout_s": 3,
      "label": "into the ostium" },
    { "do": "inject", "rate_mL_s": 4, "volume_mL": 5, "until": [{ "contrast_in": "RCA+30" }], "timeout_s": 3 },
    { "do": "advance", "tool": "wire", "speed_mm_s": 25, "turn_deg_s": 90, "until": [{ "tip_passes": "RCA+80" }],
      "timeout_s": 8 },
    { "do": "advance", "tool": "balloon", "speed_mm_s": 30, "until": [{ "balloon_at_mm": -20 }], "timeout_s": 6 },
    { "do": "advance", "tool": "balloon", "speed_mm_s": 8, "until": [{ "balloon_at_mm": -1 }], "timeout_s": 6 },
    { "do": "inflate", "gauge_atm": 20, "over_s": 1.5 },
    { "do": "wait", "until": [{ "balloon_open": true }], "timeout_s": 4 },
    { "do": "mark", "text": "open" },
    { "do": "deflate", "timeout_s": 12 },
    { "do": "advance", "tool": "stent", "speed_mm_s": 50, "until": [{ "balloon_at_mm": 30 }] }
  ]
})";

inline RunSetup setup() {
  RunSetup out;
  set_vessel("rca-mid-focal", vascular::LengthUnit::millimetre, out);
  set_script(data::read_script("predilatation.json", predilatation), out);
  set_value("begin", "RCA", out);
  return out;
}

inline std::shared_ptr<const Vessel> vessel() {
  static const std::shared_ptr<const Vessel> made = [] {
    std::string warnings;
    return make_vessel(setup(), warnings);
  }();
  return made;
}

/// Steps until the operator is at a step of the script; false: it never comes there.
inline bool run_to(ScriptedRun& run, int step) {
  while (static_cast<int>(run.hands.step) < step)
    if (!run.tick()) return false;
  return true;
}

}  // namespace ostium::app
