#pragma once
/// Text and traces on the picture, as on the monitor of a catheter laboratory.
#include <string>
#include <vector>

#include "fluoro/detector/exposure.h"
#include "fluoro/display/display.h"

namespace ostium::fluoro {

struct OverlayText {
  View view;
  Programme programme;
  Exposure exposure;
  DoseMeter dose;
  bool xray_on = false;
  std::string state;    ///< "CINE", "LIH", "REVIEW 12/75": kind of picture; empty: taken from the programme
  std::string patient;  ///< case id
};

/// Draws angles, SID, field, rate, tube voltage, times, dose-area product (Gy cm2) and kerma (mGy) along the edges; a
/// radiation sign while the beam is on.
void draw_overlay(const OverlayText& text, Picture& picture);

/// Lines of text along the top, as large as those of the overlay.
void draw_captions(const std::vector<std::string>& lines, Picture& picture);

/// A signal over time, oldest sample first.
struct Strip {
  std::string name;  ///< "II", "Ao"
  std::string unit;  ///< "mV", "mmHg"
  double samples_per_s = 250;
  std::vector<float> samples;  ///< in `unit`; the newest is at the right edge
  double least = 0, most = 1;  ///< range of the vertical axis
};

/// Extends the picture by `height` pixels at the bottom and draws the strips there, sharing the height: the last
/// `seconds` of each, with a mark every second and the newest value.
void append_strips(const std::vector<Strip>& strips, double seconds, int height, Picture& picture);

/// Side by side, such as live and reference; the lower picture is padded with black.
Picture beside(const Picture& left, const Picture& right);

}  // namespace ostium::fluoro
