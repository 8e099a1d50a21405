#pragma once
/// The C-arm system as its operator uses it: two pedals, last image hold, stored cine runs, a frozen reference, a
/// roadmap, and the dose meter. One call per frame; frame n falls on a step of the simulation, never on a clock.
#include "fluoro/console/roadmap.h"
#include "fluoro/detector/imager.h"
#include "fluoro/display/display.h"

namespace ostium::fluoro {

struct Pedals {
  bool fluoroscopy = false, cine = false;  ///< cine takes precedence
  bool any() const { return fluoroscopy || cine; }
};

/// Sides of the detector field, m: magnification.
inline constexpr double fields_m[] = {0.20, 0.16, 0.13};

struct FluoroscopeInput {
  const Scene& scene;
  View view;
  Collimator collimator;
  Pedals pedals;
  double fluoroscopy_per_s = 15, cine_per_s = 15;  ///< frames per second: 3.75, 7.5, 15, 30
  double beat_phase = 0;                           ///< [0, 1), 0 is the R wave
  bool show_roadmap = false;
  std::uint64_t seed = 1;
};

/// A cine run as displayed, with the data DICOM needs.
struct CineRun {
  View view;
  Programme programme;
  Exposure exposure;  ///< of its last frame
  std::vector<Picture> frames;
};

/// All state needed to continue.
struct FluoroscopeState {
  ImagerState imager;
  DoseMeter dose;
  Pedals before;                     ///< the pedals of the last tick
  std::vector<CineRun> runs;         ///< for review; the last is the newest
  Picture live;                      ///< shown now; with no pedal down the last image, including its lag
  std::optional<Picture> reference;  ///< frozen, shown beside the live picture
  Roadmap roadmap;                   ///< recorded from the last cine run
};

struct TickReport {
  bool xray_on = false;
  FrameReport frame;  ///< of the beam, if it was on
};

/// Throws std::invalid_argument, before changing anything, for an impossible C-arm pose, shutters or frame rates.
TickReport tick(Imager& imager, const FluoroscopeInput& in, FluoroscopeState& state, DisplayScratch& scratch);

/// Freezes the current picture as the reference.
void freeze_reference(FluoroscopeState& state);

}  // namespace ostium::fluoro
