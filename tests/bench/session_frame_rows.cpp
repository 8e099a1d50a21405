/// Frames of a session, from its state to grey levels: chest, lumen and twigs of the default case at successive moments
/// of the beat, guide and wire before the right ostium, as the window, films and Python's Imager draw them.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "app/session/scene/film.h"
#include "data/catalogue/case/case.h"
#include "data/catalogue/catalogue.h"
#include "tests/bench/rows.h"

namespace ostium::bench {

namespace {

struct FrameCase {
  const char* name;
  app::Fill fill;
  bool turns;
  int pixels;
  double field_m;
};

constexpr FrameCase frame_cases[] = {
    {"session-512", app::Fill::none, false, 512, 0.2},
    {"session-512-filled", app::Fill::right, false, 512, 0.2},
    {"session-512-turning", app::Fill::none, true, 512, 0.2},
    {"session-512-turning-filled", app::Fill::right, true, 512, 0.2},
    {"session-1024-filled", app::Fill::right, false, 1024, 0.2},
    {"session-84", app::Fill::none, false, 84, 0.3},
};

app::SessionModel default_session() {
  const std::vector<data::Instrument> catalogue = data::load_catalogue();
  std::vector<app::SessionTool> tools;
  for (const auto& [name, instrument] : {std::pair{"guide", "guide-jr4-6f"}, std::pair{"wire", "wire-014-workhorse"}})
    tools.push_back({name, data::find_instrument(catalogue, instrument), ""});
  app::SessionOptions options;
  options.begin = "RCA";
  return app::make_session(app::vessel_of(data::find_case("rca-mid-focal"), {}), std::move(tools), options);
}

fluoro::Renderer renderer_of(const std::string& name) {
  const auto& names = fluoro::renderer_names;
  return static_cast<fluoro::Renderer>(std::ranges::find(names, name) - names.begin());
}

double median_of(std::vector<double>& times) {
  std::ranges::sort(times);
  return times[times.size() / 2];
}

Row timed(const FrameCase& c, fluoro::Renderer renderer, const app::SessionModel& model,
          const app::PatientScene& patient, int frames) {
  app::FilmOptions options;
  options.renderer = renderer;
  options.field_m = c.field_m;
  options.pixels = c.pixels;
  options.overlay = false;
  options.fill = c.fill;
  app::Film film(model, options, &patient);
  app::SessionInputs inputs = inputs_at_rest(model);
  inputs.c_arm.lao_rad = 0.5, inputs.c_arm.cran_rad = 0.3;
  app::SessionState state = make_state(model, 0);
  std::vector<double> times, wall_times;
  for (int i = -3; i < frames; ++i) {
    state.blood.heart.phase = 0.5 + 0.5 * std::sin(0.77 * i);
    if (c.turns) inputs.c_arm.lao_rad += 0.002;
    const double start = thread_cpu_ms();
    const auto wall_start = std::chrono::steady_clock::now();
    film.frame(model, state, inputs);
    if (i < 0) continue;
    times.push_back(thread_cpu_ms() - start);
    wall_times.push_back(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - wall_start).count());
  }
  Row row;
  row.ms = median_of(times), row.wall_ms = median_of(wall_times);
  row.least_ms = times.front(), row.most_ms = times.back();
  return row;
}

}  // namespace

std::vector<Row> session_frame_rows(const std::vector<std::string>& renderers, bool quick) {
  const app::SessionModel model = default_session();
  const app::PatientScene patient(*model.vessel->patient, model.physiology);
  std::vector<Row> rows;
  for (const std::string& name : renderers) {
    const fluoro::Renderer renderer = renderer_of(name);
    const bool is_own = renderer == fluoro::Renderer::scanline;
    try {
      for (const FrameCase& c : frame_cases) {
        if (!is_own && c.fill == app::Fill::none) continue;
        rows.push_back(timed(c, renderer, model, patient, quick ? 5 : 90));
        rows.back().name = is_own ? c.name : c.name + ("-" + name);
      }
    } catch (const std::runtime_error& missing) {
      fmt::print(stderr, "{}; its frames are left out\n", missing.what());
    }
  }
  return rows;
}

std::string session_triangles() {
  const app::SessionModel model = default_session();
  app::PatientScene patient(*model.vessel->patient, model.physiology);
  std::string out;
  const auto add = [&](const fluoro::Body& body) {
    out += fmt::format("{:>9} {}\n", body.triangles->cols(), body.name);
  };
  for (const fluoro::Body& body : *patient.scene().fixed) add(body);
  out += "that move:\n";
  for (const fluoro::Body& body : patient.scene().moving) add(body);
  return out;
}

}  // namespace ostium::bench
