/// Frames of a session, from its state to grey levels: chest, lumen and twigs of the default case at successive moments
/// of the beat, guide and wire before the right ostium, as the window, films and Python's Imager draw them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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
    tools.push_back({name, data::find_instrument(catalogue, instrument)});
  app::SessionOptions options;
  options.begin = "RCA";
  return app::make_session(app::vessel_of(data::find_case("rca-mid-focal"), {}), std::move(tools), options);
}

std::vector<double> times_of(const FrameCase& c, const app::SessionModel& model, const app::PatientScene& patient,
                             int frames) {
  app::FilmOptions options;
  options.field_m = c.field_m;
  options.pixels = c.pixels;
  options.overlay = false;
  options.fill = c.fill;
  app::Film film(model, options, &patient);
  app::SessionInputs inputs = inputs_at_rest(model);
  inputs.c_arm.lao_rad = 0.5, inputs.c_arm.cran_rad = 0.3;
  app::SessionState state = make_state(model, 0);
  std::vector<double> times;
  for (int i = -3; i < frames; ++i) {
    state.blood.heart.phase = 0.5 + 0.5 * std::sin(0.77 * i);
    if (c.turns) inputs.c_arm.lao_rad += 0.002;
    const double start = thread_cpu_ms();
    film.frame(model, state, inputs);
    if (i >= 0) times.push_back(thread_cpu_ms() - start);
  }
  std::sort(times.begin(), times.end());
  return times;
}

}  // namespace

std::vector<Row> session_frame_rows(bool quick) {
  const app::SessionModel model = default_session();
  const app::PatientScene patient(*model.vessel->patient, model.physiology);
  std::vector<Row> rows;
  const double yardstick = shader_ms(512, quick);
  for (const FrameCase& c : frame_cases) {
    const std::vector<double> times = times_of(c, model, patient, quick ? 5 : 90);
    Row row;
    row.name = c.name;
    row.ms = times[times.size() / 2];
    row.least_ms = times.front(), row.most_ms = times.back();
    row.yardstick_ms = yardstick;
    rows.push_back(row);
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
