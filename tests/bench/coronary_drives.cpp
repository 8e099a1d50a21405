#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <random>

#include "app/session/model/penetration.h"
#include "app/session/operator/setup.h"
#include "core/base/units.h"
#include "data/formats/load_error.h"
#include "tests/bench/rows.h"

namespace ostium::bench {

namespace {

using units::pi;

constexpr int judged_every = 200;      // steps: the judge takes as long as a hundred of them
constexpr int forgotten_every = 1000;  // steps: the scratch of a twin that has to do the same

const char* const instruments = R"({
  "schema": "ostium-script/1", "name": "drives", "title": "Random drives",
  "tools": [ { "name": "guide", "instrument": "guide-jr4-6f" }, { "name": "balloon", "instrument": "balloon-25x15" },
             { "name": "wire", "instrument": "wire-014-workhorse" } ],
  "steps": [ { "do": "wait", "until": [{ "seconds": 1 }] } ]
})";

app::RunSetup setup_with(const std::string& arteries) {
  app::RunSetup setup;
  set_vessel("rca-mid-focal", vascular::LengthUnit::millimetre, setup);
  set_script(data::read_script("drives.json", instruments), setup);
  set_value("begin", "RCA", setup);
  set_value("arteries", arteries, setup);
  return setup;
}

struct Driven {
  double deepest_m = 0, deepest_of_all_steps_m = 0, most_aside_m = 0;
  int outside = 0;
  long troubled = 0;
  bool repeatable = true;  ///< to the bit
};

/// Guide to the ostium, wire and balloon into the artery; then every hand at random. A twin does the same with a
/// scratch that is thrown away now and then.
Driven drive(const app::SessionModel& model, std::uint64_t seed, double seconds) {
  std::mt19937_64 random(seed);
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  app::SessionState state = make_state(model, seed);
  app::SessionScratch scratch(model);
  app::SessionInputs inputs = inputs_at_rest(model);
  app::SessionReport report;
  app::SessionState twin = state;
  auto twin_scratch = std::make_unique<app::SessionScratch>(model);
  app::SessionReport twin_report;
  Driven out;
  const int way_in = 2000, steps = way_in + static_cast<int>(1e3 * seconds);
  int redraw = way_in;
  for (int n = 0; n < steps; ++n) {
    if (n < way_in) {
      inputs.tools[0].feed_m_s = n < 1200 ? 0.015 : 0;
      inputs.tools[1].feed_m_s = n > 1400 ? 0.08 : 0;
      inputs.tools[2].feed_m_s = 0.04, inputs.tools[2].turn_rad_s = pi / 2;
    } else if (n == redraw) {
      inputs.tools[0] = {uniform(-0.02, 0.02), 2 * pi * uniform(-1, 1)};
      inputs.tools[1] = {uniform(-0.1, 0.15), 0};
      inputs.tools[2] = {uniform(-0.1, 0.2), 2 * pi * uniform(-10, 10)};
      inputs.delivery.gauge_Pa = 101325 * uniform(-1, 14);
      redraw += static_cast<int>(uniform(100, 1000));
    }
    step(model, inputs, state, scratch, report);
    if (n % forgotten_every == forgotten_every / 2) twin_scratch = std::make_unique<app::SessionScratch>(model);
    step(model, inputs, twin, *twin_scratch, twin_report);
    if (hash(state) != hash(twin)) {
      fmt::print("drive {} differs from its twin after {} ms: {}\n", seed, n, first_difference(model, state, twin));
      out.repeatable = false;
      return out;
    }
    out.deepest_of_all_steps_m = std::max(out.deepest_of_all_steps_m, report.rods.deepest_m);
    if (report.rods.trouble & ~static_cast<unsigned>(core::feed_stopped)) ++out.troubled;
    for (const Eigen::Vector3d& aside : state.wall_aside_P) out.most_aside_m = std::max(out.most_aside_m, aside.norm());
    if (n % judged_every != judged_every - 1) continue;
    const app::Penetration now = penetration(model, state);
    out.deepest_m = std::max(out.deepest_m, now.deepest_m), out.outside += now.outside;
  }
  return out;
}

}  // namespace

bool print_coronary_drives(int count, const std::string& arteries) {
  const app::RunSetup setup = setup_with(arteries);
  std::string warnings;
  const app::SessionModel model = make_session(setup, make_vessel(setup, warnings));
  Driven all;
  int worst = 0;
  for (int seed = 0; seed < count; ++seed) {
    const Driven one = drive(model, static_cast<std::uint64_t>(seed), 5);
    if (one.deepest_m > all.deepest_m) all.deepest_m = one.deepest_m, worst = seed;
    all.deepest_of_all_steps_m = std::max(all.deepest_of_all_steps_m, one.deepest_of_all_steps_m);
    all.most_aside_m = std::max(all.most_aside_m, one.most_aside_m);
    all.outside += one.outside, all.troubled += one.troubled;
    all.repeatable = all.repeatable && one.repeatable;
    if (one.outside > 0 || one.deepest_m > deepest_drive_m || (seed + 1) % 10 == 0 || seed + 1 == count) {
      fmt::print(
          "drive {:4}: {:.4f} mm, {} outside; so far {:.4f} mm (drive {}), by contact's own account {:.4f} mm, {} "
          "outside, {} steps in trouble, an artery {:.2f} mm aside\n",
          seed, 1e3 * one.deepest_m, one.outside, 1e3 * all.deepest_m, worst, 1e3 * all.deepest_of_all_steps_m,
          all.outside, all.troubled, 1e3 * all.most_aside_m);
      std::fflush(stdout);
    }
  }
  return all.repeatable && all.outside == 0 && all.deepest_m < deepest_drive_m;
}

}  // namespace ostium::bench
