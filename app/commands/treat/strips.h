#pragma once
/// ECG, pressure and gauge during an inflation, as shown on the monitor.
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
  /// Keeps at most that many seconds from the beginning.
  void end(double seconds);
  void listen(const Bedside& bed);
};

}  // namespace ostium::app
