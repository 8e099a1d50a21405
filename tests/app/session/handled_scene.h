#pragma once
/// Scenes made by hand, in which handling errors are looked for, and a case with its tools.
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "app/session/handling/errors.h"
#include "app/session/run/run.h"
#include "data/catalogue/script/script.h"

namespace ostium::app {

enum Tool { guide, thick, thin, balloon };

/// A vessel index of three places (aorta, its branch, ventricle), and an artery of 100 cells of 1 mm with its lesion
/// from 30 to 40 mm; a side branch that leaves at 20 mm has cells 100 to 149, copies of those from 50 on.
struct Played {
  HandlingMap map;
  HandlingScene scene;
  std::vector<SessionEvent> events;

  Played() {
    map.astray_m = {0, 30e-3, 0, 0}, map.in_coronary_m = {0, 0, 0, 8e-3};
    map.before_root = {1, 1, 0, 0}, map.in_ventricle = {0, 0, 1, 0};
    for (int c = 0; c < 150; ++c) {
      const bool side = c >= 100;
      map.from_ostium_m.push_back(1e-3 * (side ? c - 80 : c));
      map.to_end_m.push_back(1e-3 * (side ? 149 - c : 99 - c));
      map.unplanned_m.push_back(side ? 1e-3 * (c - 99) : 0);
      map.deep_m.push_back(10e-3), map.healthy_m.push_back(1.5e-3);
      map.behind_lesion.push_back(!side && c > 40);
    }
    scene.tools.resize(4);
    for (HandledTool& tool : scene.tools) tool.sphere = 0;
    scene.beam = scene.thin_tip_is_seen = scene.diastasis = true;
  }

  HandledTool& operator[](Tool t) { return scene.tools[static_cast<std::size_t>(t)]; }
  void feed(Tool t, double by_m) {
    (*this)[t].inserted_m += by_m, (*this)[t].fed_m += by_m, (*this)[t].feed_m_s = by_m / 0.01;
  }
  /// Looks every 10 ms.
  template <class Errors, class Each>
  void play(Errors& errors, double seconds, Each each) {
    for (int i = 0; i < std::lround(seconds / 0.01); ++i) {
      scene.time_s += 0.01;
      each(i);
      look_for(errors, map, scene, EventSink{static_cast<std::uint64_t>(1e3 * scene.time_s), events});
    }
  }
  /// The number of events of a kind, which it then clears.
  int took(data::EventCode code) {
    const auto n = std::count_if(events.begin(), events.end(),
                                 [&](const SessionEvent& e) { return e.code == static_cast<int>(code); });
    std::erase_if(events, [&](const SessionEvent& e) { return e.code == static_cast<int>(code); });
    return static_cast<int>(n);
  }
};

inline RunSetup tools_in_place() {
  RunSetup out;
  set_vessel("rca-mid-focal", vascular::LengthUnit::millimetre, out);
  set_script(data::find_script("rca-from-the-ostium"), out);
  return out;
}

inline std::shared_ptr<const Vessel> vessel_in_place() {
  static const std::shared_ptr<const Vessel> made = [] {
    std::string warnings;
    return make_vessel(tools_in_place(), warnings);
  }();
  return made;
}

}  // namespace ostium::app
