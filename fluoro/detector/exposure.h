#pragma once
/// Tube settings and their dose.
#include "fluoro/detector/scatter.h"
#include "fluoro/matter/beam.h"
#include "fluoro/projection/path_lengths.h"

namespace ostium::fluoro {

enum class Mode { fluoroscopy, cine };

/// Acquisition programme of a pedal.
struct Programme {
  Mode mode = Mode::fluoroscopy;
  double frames_per_s = 15;       ///< 3.75, 7.5, 15 or 30
  double detector_dose_nGy = 30;  ///< air kerma per frame at the detector, behind the grid, for a 20 cm field
  double copper_mm = 0.4;         ///< added filter
  /// Length of the X-ray pulse: an estimate, in the middle of the 3 to 10 ms that cardiac systems use [Schueler 2000,
  /// RadioGraphics 20:1115, from memory].
  double pulse_s = 0.006;
  double lag = 0.35;                     ///< share of the previous picture in the next (lag.h)
  double kerma_limit_Gy_s = 0.088 / 60;  ///< at the reference point; fluoroscopy: 88 mGy/min (21 CFR 1020.32)
};
Programme fluoroscopy(double frames_per_s = 15);
Programme cine(double frames_per_s = 15);
/// Throws std::invalid_argument, listing the valid rates, for any other.
void require_rate(double frames_per_s);

/// Shutters: the open rectangle, as distances from the picture's middle in shares of its side; 0.5 is the edge.
struct Collimator {
  double left = 0.5, right = 0.5, top = 0.5, bottom = 0.5;  ///< each in (0, 0.5]
  double open_share() const { return (left + right) * (top + bottom); }
  bool operator==(const Collimator&) const = default;
};
/// As systems set their blades: they follow the field and just show at its edges [estimate, from cine frames: 2 to 4 %
/// of the side].
inline constexpr Collimator to_field{0.474, 0.474, 0.474, 0.474};
/// Throws std::invalid_argument stating the limits.
void check(const Collimator& collimator);

/// Tube settings of a frame.
struct Exposure {
  XrayTube tube;
  double photons_per_m2 = 0;     ///< that would reach the detector with nothing in between
  double patient_m = 0;          ///< thickness of soft tissue with the attenuation of the measuring field
  double detector_dose_nGy = 0;  ///< expected
  double kerma_Gy = 0;           ///< per frame, 15 cm before the isocentre (reference point of IEC 60601-2-43)
  double dose_area_Gy_m2 = 0;    ///< dose-area product of a frame
};

/// Cache of the beams used so far.
class Beams {
 public:
  explicit Beams(const Detector& detector) : detector_(detector) {}
  const Beam& operator()(const XrayTube& tube);

 private:
  Detector detector_;
  std::vector<std::pair<XrayTube, Beam>> made_;
};

/// For automatic brightness: path lengths on a coarse grid of rays, without drawing a picture.
inline constexpr int coarse_pixels = 32;

/// Tube settings that give the programme's dose at the detector: the geometric mean over the middle of the picture of
/// primary and scattered kerma. The tube voltage rises with thickness. `coarse`: path lengths on coarse_pixels^2.
Exposure automatic_exposure(const Programme& programme, const View& view, const Collimator& collimator,
                            const PathLengths& coarse, const ScatterKernel& kernel, double grid_transmission,
                            Beams& beams);

/// Running totals.
struct DoseMeter {
  double fluoroscopy_s = 0;
  long cine_frames = 0, cine_runs = 0;
  double kerma_Gy = 0, dose_area_Gy_m2 = 0;
  void add(const Programme& programme, const Exposure& exposure);
};

}  // namespace ostium::fluoro
