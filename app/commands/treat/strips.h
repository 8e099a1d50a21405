#pragma once
/// ECG, pressure and gauge of an inflation, as the monitor beside the pictures shows them.
#include <array>

#include "app/angiography/textbook_treatment.h"
#include "fluoro/display/overlay.h"

namespace ostium::app {

/// 250 samples a second.
struct InflationStrips {
  std::array<vascular::Lead, 2> which;
  std::vector<fluoro::Strip> strips;  ///< two leads, aorta, gauge
  long step = 0;

  explicit InflationStrips(const std::string& artery);
  double seconds() const { return static_cast<double>(strips[0].samples.size()) / 250; }
  /// Keeps no more than so many seconds from the beginning.
  void end(double seconds);
  void listen(const Bedside& bed);
};

}  // namespace ostium::app
