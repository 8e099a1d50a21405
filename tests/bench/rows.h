#pragma once
/// Rows of `ostium-bench`: CPU time of a whole step in the working thread, beside the gate accuracy at the same
/// settings.
#include <time.h>

#include <string>
#include <vector>

namespace ostium::bench {

struct Row {
  std::string name;
  double ms = 0;            ///< CPU time per simulated millisecond, mean
  double p999_ms = 0;       ///< its 99.9th percentile
  double most_ms = 0;       ///< of the slowest step or frame; 0: not measured
  double least_ms = 0;      ///< of the fastest frame; 0: not measured
  double wall_ms = 0;       ///< of a frame by the clock on the wall, waiting included, median; 0: not measured
  double yardstick_ms = 0;  ///< time of the reference implementation, if it has its own
  struct {
    std::string name;
    double value = 0;
    std::string unit = "mm";
    bool pass = false;
  } gate;
};

/// Of the calling thread.
inline double thread_cpu_ms() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

struct Duration {
  int warm_up_steps = 500;
  int steps = 10'000;
};

/// One rod of `elements`, clamped, swinging freely under its own weight (verification: rod-swing). The tick is drive,
/// step and state hash.
Row free_rod(const std::string& name, int elements, const Duration& duration);

/// Two and three coaxial rods of 512 elements and 1 m each, the inner ones 50 mm longer than those around them,
/// clamped, swinging under their weight with the damping of the catalogue's shafts (verification: nesting-pair); run
/// alternately.
std::vector<Row> nested_rods(const Duration& duration);

/// Guide and wire of the catalogue in the moving test vessel, with the scripted procedure of app/gates/drives.h.
Row vessel_pair(const std::string& name, bool quick);

inline constexpr double deepest_drive_m = 0.178e-3;  ///< allowed of a random drive by the gate

/// Random drives 0 to count - 1 of 5 s, and their penetration; or the scripted procedure repeatedly, with energy and
/// memory, one line a minute. Printed; false if any wire escaped, or was deeper than the gates allow.
bool print_drives(int count);
bool print_soak(double minutes);
/// The same of guide, balloon and wire in a case's right coronary, the balloon filled and emptied at random;
/// `arteries`: rigid or yield.
bool print_coronary_drives(int count, const std::string& arteries);

/// Mean CPU time, ms per step, of free rods from 16 to 4,096 elements.
struct GrowthPoint {
  int elements;
  double ms;
};
std::vector<GrowthPoint> growth(const Duration& duration);

/// The thesis's stretch experiment (its figure 3.6) with the reference implementation, and our rod beside it. Printed
/// as it is computed.
void print_stretch_table(bool quick);

/// CPU time of one fluoroscopy frame from scene to grey levels (`ms`; p999_ms is the slowest of 150), beside the
/// angle-opacity shader. `rotating`: the C-arm turns between frames, so that nothing can be cached.
Row frame_row(const std::string& name, int pixels, bool rotating, bool quick);

/// CPU time of frames of a session, from its state to grey levels: median (`ms`), fastest and slowest of 90, without
/// and with a full artery, the C-arm at rest and turning by 0.1 degrees a frame, and small as environments ask for.
/// Those with a full artery are drawn by all of the renderers, the others by scanline only; what is not available is
/// left out with a word on stderr.
std::vector<Row> session_frame_rows(const std::vector<std::string>& renderers, bool quick);
/// What they draw: triangles by body, a line each.
std::string session_triangles();
/// The angle-opacity shader's time.
double shader_ms(int pixels, bool quick);

/// CPU time of flow and contrast per frame at 15 a second (`ms`; p999_ms is the slowest), while both coronaries fill.
Row circulation_row(bool quick);
/// CPU time of a step of balloon, stent and wall (ms, and 99.9th percentile), while a stent is expanded in a lesion.
Row treatment_row(bool quick);

/// The number of late ticks of a 1 kHz loop, alone and with another thread drawing frames. Printed.
void print_late_ticks(double seconds);

}  // namespace ostium::bench
