#pragma once
/// Rows of `ostium-bench`: the whole tick of the step, timed as CPU time of the thread that works, beside the accuracy
/// gate that the same settings reach.
#include <string>
#include <vector>

namespace ostium::bench {

struct Row {
  std::string name;
  double ms = 0;            ///< CPU time of a simulated millisecond, mean
  double p999_ms = 0;       ///< its 99.9th percentile
  double yardstick_ms = 0;  ///< where it has one of its own
  struct {
    std::string name;
    double value = 0;
    std::string unit = "mm";
    bool pass = false;
  } gate;
};

struct Duration {
  int warm_up_steps = 500;
  int steps = 10'000;
};

/// One rod of `elements`, clamped, swinging freely under its own weight (verification: rod-swing). The tick is drive,
/// step and state hash.
Row free_rod(const std::string& name, int elements, const Duration& duration);

/// Two and three coaxial rods of 512 elements each and 1 m, the inner ones 50 mm longer than those around them,
/// clamped, swinging under their weight with the damping of the catalogue's shafts (verification: nesting-pair); in
/// turns.
std::vector<Row> nested_rods(const Duration& duration);

/// Guide and wire of the catalogue in the beating test vessel, by the scripted procedure of app/verify/drives.h.
Row vessel_pair(const std::string& name, bool quick);

/// Random drives 0 to count - 1 of 5 s, and how the wall held them; or the scripted procedure, over and over, with
/// energy and memory, a line a minute. Printed; false if any wire got out, or deeper than the gates allow.
bool print_drives(int count);
bool print_soak(double minutes);

/// Mean CPU time, ms per step, of free rods from 16 to 4,096 elements.
struct GrowthPoint {
  int elements;
  double ms;
};
std::vector<GrowthPoint> growth(const Duration& duration);

/// The thesis' stretch experiment (its figure 3.6) with the yardstick, and ours beside it. Printed as it is computed.
void print_stretch_table(bool quick);

/// CPU time of one fluoroscopy frame from scene to grey levels (`ms`; p999_ms is the slowest of 150), beside the
/// angle-opacity shader. `rotating`: the C-arm turns between frames, so that nothing can be kept.
Row frame_row(const std::string& name, int pixels, bool rotating, bool quick);

/// CPU time of flow and contrast for a frame at 15 a second (`ms`; p999_ms is the slowest), while both coronaries fill.
Row circulation_row(bool quick);
/// CPU time of a step of balloon, stent and wall (ms, and 99.9th percentile), while a stent is opened in a lesion.
Row treatment_row(bool quick);

/// How many ticks of a 1 kHz loop are late, alone and with another thread drawing frames. Printed.
void print_late_ticks(double seconds);

}  // namespace ostium::bench
