/// Frames: a chest of some 190,000 fixed and 90,000 moving triangles, guide, wire and balloon, both coronaries full.
#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <thread>

#include "app/gates/gate.h"
#include "core/samples/steel_wire.h"
#include "fluoro/console/fluoroscope.h"
#include "fluoro/phantom/chest.h"
#include "tests/bench/angle_opacity.h"
#include "tests/bench/rows.h"

namespace ostium::bench {

namespace {

double clock_ms(clockid_t clock) {
  timespec t;
  clock_gettime(clock, &t);
  return 1e3 * double(t.tv_sec) + 1e-6 * double(t.tv_nsec);
}

fluoro::Scene bench_scene() {
  fluoro::phantom::ChestOptions options;
  options.filling = fluoro::phantom::Filling::both;
  return fluoro::phantom::chest(options);
}

fluoro::View view_of(int pixels) {
  fluoro::View view;
  view.arm.lao_rad = 0.5;
  view.arm.cran_rad = 0.3;
  view.pixels = pixels;
  return view;
}

struct Session {
  fluoro::Scene scene = bench_scene();
  fluoro::Imager imager{{}, fluoro::make_scanline_renderer()};
  fluoro::FluoroscopeState state;
  fluoro::DisplayScratch scratch;
  fluoro::View view;

  explicit Session(int pixels) : view(view_of(pixels)) {}
  void frame(double turn_rad = 0) {
    view.arm.lao_rad += turn_rad;
    tick(imager, {.scene = scene, .view = view, .collimator = {}, .pedals = {.fluoroscopy = true}}, state, scratch);
  }
};

std::vector<double> frame_times(Session& session, int frames, double turn_rad) {
  std::vector<double> times;
  for (int i = 0; i < frames + 5; ++i) {
    const double start = clock_ms(CLOCK_THREAD_CPUTIME_ID);
    session.frame(turn_rad);
    if (i >= 5) times.push_back(clock_ms(CLOCK_THREAD_CPUTIME_ID) - start);
  }
  std::sort(times.begin(), times.end());
  return times;
}

double yardstick_ms(int pixels, int frames) {
  const fluoro::Scene scene = bench_scene();
  std::vector<fluoro::Body> all = *scene.fixed;
  all.insert(all.end(), scene.moving.begin(), scene.moving.end());
  AngleOpacity shader(std::move(all));
  double best = 1e9;
  for (int i = 0; i < frames; ++i) {
    const double start = clock_ms(CLOCK_THREAD_CPUTIME_ID);
    shader.draw(view_of(pixels));
    best = std::min(best, clock_ms(CLOCK_THREAD_CPUTIME_ID) - start);
  }
  return best;
}

/// Share of ticks of a 1 kHz loop that end after the next one should have begun. Each tick steps a rod of 512 elements.
double late_share(double seconds, Session* drawing) {
  std::atomic<bool> stop = false;
  std::thread drawer([&] {
    while (drawing && !stop) drawing->frame();
  });
  core::Bench rod = core::steel_bench({.elements = 512});
  const auto ticks = static_cast<long>(1000 * seconds);
  long late = 0;
  timespec next;
  clock_gettime(CLOCK_MONOTONIC, &next);
  for (long i = 0; i < ticks; ++i) {
    next.tv_nsec += 1'000'000;
    if (next.tv_nsec >= 1'000'000'000) {
      next.tv_nsec -= 1'000'000'000;
      ++next.tv_sec;
    }
    rod.step();
    const double over = clock_ms(CLOCK_MONOTONIC) - (1e3 * double(next.tv_sec) + 1e-6 * double(next.tv_nsec));
    if (over > 0) {
      ++late;
      clock_gettime(CLOCK_MONOTONIC, &next);  // do not count the same delay twice
    } else {
      clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &next, nullptr);
    }
  }
  stop = true;
  drawer.join();
  return double(late) / double(ticks);
}

}  // namespace

Row frame_row(const std::string& name, int pixels, bool rotating, bool quick) {
  Session session(pixels);
  const std::vector<double> times = frame_times(session, quick ? 10 : 150, rotating ? 0.002 : 0);
  Row row;
  row.name = name;
  row.ms = std::accumulate(times.begin(), times.end(), 0.0) / double(times.size());
  row.p999_ms = times.back();
  row.yardstick_ms = shader_ms(pixels, quick);
  const data::GateResult gate = app::gates::xray_thickness(true).front();
  row.gate = {gate.gate, gate.value, gate.unit, gate.pass()};
  return row;
}

double shader_ms(int pixels, bool quick) { return yardstick_ms(pixels, quick ? 2 : 6); }

void print_late_ticks(double seconds) {
  long fixed = 0, moving = 0;
  const fluoro::Scene scene = bench_scene();
  for (const fluoro::Body& body : *scene.fixed) fixed += body.triangles->cols();
  for (const fluoro::Body& body : scene.moving) moving += body.triangles->cols();
  fmt::print("{} fixed and {} moving triangles; late ticks of a 1 kHz loop that steps a rod of 512 elements\n", fixed,
             moving);
  Session session(512);
  session.frame();
  for (int repeat = 0; repeat < 3; ++repeat)
    fmt::print("alone {:.2f} %   beside frames of 512 x 512 {:.2f} %\n", 100 * late_share(seconds, nullptr),
               100 * late_share(seconds, &session));
}

}  // namespace ostium::bench
