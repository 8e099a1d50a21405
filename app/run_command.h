#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace ostium {

struct RunOptions {
  std::string vessel;  ///< a case, or a mesh
  std::string script = "aorta-arch-wire";
  std::vector<std::string> set;  ///< TOOL=INSTRUMENT
  std::uint64_t seed = 0;
  double seconds = 0;            ///< most that are simulated; 0: until the script ends
  std::string folder;            ///< where recording and metrics go; empty: nowhere
  std::string record = "full";   ///< none, events, full
  bool real = false;             ///< paced at 1 kHz
  std::string unit = "mm";       ///< of a mesh
  std::string entry, towards;    ///< of a mesh: X,Y,Z
  std::string device;            ///< empty: the script moves the tools; auto, usb, emulator: hands at a tracking box;
                                 ///< keyboard: hands at keyboard, mouse or gamepad, in the window
  std::string display = "none";  ///< or window
  std::string last_frame;        ///< the window's last picture goes into this PNG; empty: nowhere
  std::string serial;            ///< of the box
  bool film = false;             ///< DIR/procedure.mp4
  bool report = false;           ///< DIR/report.html, events.csv, key-frames/
  bool json = false;
};

struct RunSetup;
/// What the options ask for. Throws LoadError or MeshError.
RunSetup setup_of(const RunOptions& options);

/// `ostium run`. Returns the exit code: 0 if the script succeeded. Throws LoadError or MeshError.
int run_command(const RunOptions& options);
/// `ostium` without more: an angioplasty from start to end, with everything that is to be had of it, in `folder`.
int demonstration_command(const std::string& folder);
/// `ostium scripts`.
int scripts_command(bool json);

}  // namespace ostium
