#pragma once
#include <memory>
#include <optional>
#include <string>

#include "app/commands/run/session_arguments.h"

namespace ostium::app {

struct RunArguments {
  SessionArguments session;
  std::string folder;            ///< where recording and metrics go; empty: nowhere
  std::string record = "full";   ///< none, events, full
  std::string speed = "max";     ///< real: paced by the clock at 1 kHz
  std::string device;            ///< empty: the script moves the tools; auto, usb, emulator: a tracking box does;
                                 ///< keyboard: people do, with keyboard, mouse or gamepad in the window
  std::string display = "none";  ///< or window
  std::string last_frame;        ///< PNG file for the window's last picture; empty: none
  std::string serial;            ///< serial number of the box
  std::string renderer = "scanline";
  bool film = false;    ///< write DIR/procedure.mp4
  bool report = false;  ///< write DIR/report.html, events.csv, key-frames/
  bool json = false;
  std::optional<int> serve;  ///< port of a trainer's station beside the run; 0: any that is free

  bool in_window() const { return display == "window" || device == "keyboard"; }
};

/// Builds the vessel; chooses the tool sizes that fit it, and says what was chosen. Throws LoadError or MeshError.
std::shared_ptr<const Vessel> build_vessel(RunSetup& setup, const std::string& command);

/// Exit code: 0 if the script succeeded. Throws LoadError or MeshError.
int run_script(const RunArguments& arguments);

}  // namespace ostium::app
