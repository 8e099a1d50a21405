#pragma once
/// The window's picture: fluoroscopy beside a frozen reference, ECG and pressure, what each hand holds, gauge,
/// contrast, dose and times, keys. Drawn with cairo, so that it is the same with and without a screen.
#include <cstdint>
#include <string>
#include <vector>

#include "app/session/live/live_driver.h"
#include "fluoro/detector/exposure.h"
#include "fluoro/display/display.h"

namespace ostium::app {

inline constexpr int panel_width = 1280, panel_height = 800;

/// What does not change during a run.
struct PanelTexts {
  std::string title;                      ///< case and script
  std::vector<std::string> tools;         ///< "guide: Judkins right 4 guide, 6F"
  std::vector<std::string> steps;         ///< of the script
  std::vector<std::string> signal_names;  ///< of Snapshot::signals
  int left_hand = 0;
  bool has_patient = false;
  bool has_balloon = false;  ///< one that an indeflator opens, alone or in a stent
};
PanelTexts panel_texts(const SessionModel& model, const ScriptPlan& plan, const LiveDriver& hand);

/// One of Snapshot::signals; not a number where the run has none of that name.
double signal(const PanelTexts& texts, const Snapshot& now, const std::string& name);

struct PanelView {
  const fluoro::Picture* picture = nullptr;    ///< live; null: none yet
  const fluoro::Picture* reference = nullptr;  ///< null: none
  fluoro::DoseMeter dose;
  int review_frame = 0, review_frames = 0;  ///< of a stored cine run; 0: live
  std::string problem;                      ///< in red: a lost wire, an unplugged cable; empty: none
  bool help = false;
};

/// `pixels`: panel_width by panel_height, 0xffRRGGBB, rows from the top.
void draw_panel(const PanelTexts& texts, const Snapshot& now, const PanelView& view,
                std::vector<std::uint32_t>& pixels);

/// A command's keys and what it does.
struct KeyHelp {
  std::string keys, what;
};
/// Of the commands that do something in this run as it stands, in the console's order.
std::vector<KeyHelp> key_help(const PanelTexts& texts, const Snapshot& now);

}  // namespace ostium::app
