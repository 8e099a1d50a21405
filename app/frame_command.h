#pragma once
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace ostium {

struct FrameOptions {
  static constexpr double as_view = std::numeric_limits<double>::quiet_NaN();
  std::string of = "phantom";  ///< what is in the beam: that, or a case
  double phase = 0.75;         ///< of the heart, of a case; a film begins there
  std::string view = "ap";
  double lao_deg = as_view, cran_deg = as_view;  ///< instead of the view's
  double sid_mm = 1100, field_mm = 200;
  std::vector<double> table_mm{0, 0, 0};             ///< of the isocentre in the patient: left, head, front
  std::vector<double> shutters{0.5, 0.5, 0.5, 0.5};  ///< left, right, top, bottom, in shares of the picture's side
  int pixels = 512;
  bool cine = false;
  double frames_per_s = 15;
  int frames = 0;             ///< 0: 8 before the one of a still picture; 30 of a video
  std::string fill = "none";  ///< left, right: coronary full of contrast
  double stenosis_percent = 60;
  std::string guide = "left";  ///< where guide and wire are: left, right, none
  std::uint64_t seed = 1;
  std::string renderer = "scanline";
  bool overlay = false, json = false;
  std::string out = "frame.png";  ///< .png, .dcm or .mp4
};

int frame_command(const FrameOptions& options);
/// `ostium views`.
int views_command(bool json);

}  // namespace ostium
