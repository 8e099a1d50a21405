#pragma once
/// Letters and traces on the picture, as on the monitor of a catheter laboratory.
#include <string>

#include "fluoro/detector/exposure.h"
#include "fluoro/display/display.h"

namespace ostium::fluoro {

struct OverlayText {
  View view;
  Programme programme;
  Exposure exposure;
  DoseMeter dose;
  bool xray_on = false;
  std::string state;    ///< "CINE", "LIH", "REVIEW 12/75": what the picture is; empty: from the programme
  std::string patient;  ///< case id
};

/// Angles, SID, field, rate, tube voltage, times, dose-area product (Gy cm2) and kerma (mGy) along the edges; a
/// radiation sign while the beam is on.
void draw_overlay(const OverlayText& text, Picture& picture);

/// A signal over time, oldest sample first.
struct Strip {
  std::string name;  ///< "II", "Ao"
  std::string unit;  ///< "mV", "mmHg"
  double samples_per_s = 250;
  std::vector<float> samples;  ///< in `unit`; the newest at the right edge
  double least = 0, most = 1;  ///< of the trace's height
};

/// Makes the picture higher by `height` pixels and draws the strips there, each in its share: the last `seconds` of it,
/// with a mark every second and the newest value.
void append_strips(const std::vector<Strip>& strips, double seconds, int height, Picture& picture);

/// Side by side, the lower one's rest black: live and reference.
Picture beside(const Picture& left, const Picture& right);

}  // namespace ostium::fluoro
