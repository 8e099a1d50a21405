/// `ostium-bench`: CPU time of a simulated millisecond, beside the gate's accuracy at the same settings and the
/// reference implementation's time.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/gates/gate.h"
#include "fluoro/projection/path_lengths.h"
#include "tests/bench/corde.h"
#include "tests/bench/procedure_rows.h"
#include "tests/bench/rows.h"

namespace {

using namespace ostium::bench;

/// The thesis's explicit CoRdE with 512 elements at real stiffness and its own largest stable step.
double yardstick_ms(bool quick) {
  CordeSettings settings;
  settings.step_s = largest_stable_step(settings, quick ? 0.002 : 0.02);
  return cpu_ms_per_simulated_ms(settings, quick ? 0.005 : 0.05);
}

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

void print_json(const std::vector<Row>& rows, double yardstick) {
  nlohmann::ordered_json out;
  out["machine"] = {
      {"processor", processor()}, {"cores", std::thread::hardware_concurrency()}, {"compiler", "g++ " __VERSION__}};
  out["rows"] = nlohmann::json::array();
  for (const Row& r : rows)
    out["rows"].push_back(
        {{"name", r.name},
         {"ms", r.ms},
         {"p999_ms", r.p999_ms},
         {"most_ms", r.most_ms},
         {"least_ms", r.least_ms},
         {"wall_ms", r.wall_ms},
         {"yardstick_ms", r.yardstick_ms > 0 ? r.yardstick_ms : yardstick},
         {"gate", {{"name", r.gate.name}, {"value", r.gate.value}, {"unit", r.gate.unit}, {"pass", r.gate.pass}}}});
  fmt::print("{}\n", out.dump(2));
}

void print_table(const std::vector<Row>& rows, double yardstick) {
  const auto of = [&](const Row& r) { return r.yardstick_ms > 0 ? r.yardstick_ms : yardstick; };
  fmt::print("{:<28} {:>9} {:>9} {:>9} {:>10} {:>7}   {}\n", "ms of CPU", "mean", "p99.9", "most", "yardstick", "ratio",
             "gate");
  for (const Row& r : rows)
    fmt::print("{:<28} {:>9.4f} {:>9.4f} {:>9.4f} {:>10.2f} {:>7.0f}   {} {:.3g} {} {}\n", r.name, r.ms, r.p999_ms,
               r.most_ms, of(r), of(r) / r.ms, r.gate.name, r.gate.value, r.gate.unit, r.gate.pass ? "pass" : "FAIL");
}

/// A machine that others use slows single frames down: the fastest and the median say more than the mean.
void print_frames(const std::vector<Row>& rows) {
  fmt::print("\n{:<34} {:>9} {:>9} {:>9} {:>9} {:>10} {:>7}\n", "ms of CPU", "least", "median", "most", "on wall",
             "yardstick", "ratio");
  for (const Row& r : rows)
    fmt::print("{:<34} {:>9.2f} {:>9.2f} {:>9.2f} {:>9.2f} {:>10.2f} {:>7.1f}\n", r.name, r.least_ms, r.ms, r.most_ms,
               r.wall_ms, r.yardstick_ms, r.yardstick_ms / r.ms);
  fmt::print("triangles\n{}", session_triangles());
}

}  // namespace

int main(int argc, char** argv) try {
  bool json = false, quick = false, growth_only = false, stretch_only = false, frames_only = false,
       physiology_only = false;
  double late_s = 0, soak_min = 0;
  std::string recording;
  std::vector<std::string> procedures, renderers;
  ProfileOptions replays;
  int feed_trips = 0, drives = 0, coronary_drives = 0;
  std::string arteries = "rigid";
  CLI::App app("Times the step: CPU time of one simulated millisecond, beside its accuracy gate and the yardstick.",
               "ostium-bench");
  app.add_flag("--json", json, "Machine-readable: {\"machine\", \"rows\"}");
  app.add_flag("--quick", quick, "A tenth of the simulated time, for a test");
  app.add_flag("--growth", growth_only, "Instead: time against the number of elements, 16 to 4,096");
  app.add_flag("--stretch", stretch_only, "Instead: the stretch table of the thesis' figure 3.6 (about two minutes)");
  app.add_option("--feed", feed_trips,
                 "Instead: feed a wire 1 m in and out so often, and compare its rest (100: three minutes)");
  CLI::Option* frames_option = app.add_flag("--frames", frames_only, "Instead: the X-ray frames alone");
  app.add_option("--renderer", renderers, "Of these only a session's frames, drawn by each of the named, no yardstick")
      ->check(CLI::IsMember(
          std::vector<std::string>(ostium::fluoro::renderer_names.begin(), ostium::fluoro::renderer_names.end())))
      ->needs(frames_option);
  app.add_flag("--physiology", physiology_only, "Instead: flow and contrast, balloon and stent alone");
  app.add_option("--late", late_s, "Instead: so many seconds of a 1 kHz loop, alone and beside frames");
  app.add_option("--drives", drives,
                 "Instead: so many random drives through the beating test vessel (10 take a minute)");
  CLI::Option* in_coronary =
      app.add_option("--coronary-drives", coronary_drives,
                     "Instead: so many with wire and balloon in a case's beating artery (10 take a minute)");
  app.add_option("--arteries", arteries, "With --coronary-drives: rigid, or yield to instruments")
      ->check(CLI::IsMember({"rigid", "yield"}))
      ->needs(in_coronary);
  app.add_option("--soak", soak_min, "Instead: so many simulated minutes of the scripted procedure there");
  CLI::Option* procedure =
      app.add_option("--procedure", procedures,
                     "Instead: whole procedures (names of scripts, each on the case of its name; without one, the five "
                     "that are judged), each run once and then replayed; minutes each")
          ->expected(0, -1);
  app.add_option("--profile", recording, "Instead: where the time of a recorded run goes: RUN.h5");
  app.add_option("--from", replays.from_s, "With --profile: second to begin at");
  app.add_option("--seconds", replays.seconds, "With --profile: how many; 0: to the end");
  app.add_option("--replays", replays.replays, "A step's time is the least of so many bit-identical replays")
      ->check(CLI::Range(1, 20));
  app.footer(
      "Examples:\n  ostium-bench\n  ostium-bench --json > bench.json\n  ostium-bench --growth\n"
      "  ostium-bench --frames --renderer scanline egl\n"
      "  ostium-bench --procedure pci-rca-mid-focal\n  ostium-bench --profile out/run.h5 --from 80 --seconds 10");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }

  const Duration duration = quick ? Duration{100, 1000} : Duration{};
  if (stretch_only) {
    print_stretch_table(quick);
    return 0;
  }
  if (drives > 0) return print_drives(drives) ? 0 : 1;
  if (coronary_drives > 0) return print_coronary_drives(coronary_drives, arteries) ? 0 : 1;
  if (soak_min > 0) return print_soak(soak_min) ? 0 : 1;
  if (late_s > 0) {
    print_late_ticks(late_s);
    return 0;
  }
  if (frames_only && !renderers.empty()) {
    const std::vector<Row> session = session_frame_rows(renderers, quick);
    json ? print_json(session, 0) : print_frames(session);
    return 0;
  }
  if (frames_only) {
    std::vector<Row> frames{frame_row("frame-512", 512, false, quick),
                            frame_row("frame-512-rotating", 512, true, quick),
                            frame_row("frame-1024", 1024, false, quick)};
    if (!json) print_table(frames, 0);
    std::vector<Row> session =
        session_frame_rows({ostium::fluoro::renderer_names.begin(), ostium::fluoro::renderer_names.end()}, quick);
    const double shader = shader_ms(512, quick);
    for (Row& row : session) row.yardstick_ms = shader;
    frames.insert(frames.end(), session.begin(), session.end());
    json ? print_json(frames, 0) : print_frames(session);
    return 0;
  }
  if (physiology_only) {
    const std::vector<Row> rows{circulation_row(quick), treatment_row(quick)};
    json ? print_json(rows, 0) : print_table(rows, 0);
    return 0;
  }
  if (feed_trips > 0) {
    const auto results = ostium::app::gates::feed_round_trips(feed_trips, 1.0);
    for (const ostium::data::GateResult& r : results) fmt::print("{}\n", ostium::data::table_line(r));
    return ostium::data::all_pass(results) ? 0 : 1;
  }
  if (growth_only) {
    fmt::print("{:>9} {:>10} {:>12}\n", "elements", "ms", "ns/element");
    for (const GrowthPoint& p : growth({100, quick ? 200 : 2000}))
      fmt::print("{:>9} {:>10.4f} {:>12.1f}\n", p.elements, p.ms, 1e6 * p.ms / p.elements);
    return 0;
  }
  if (!recording.empty()) {
    print_profile(profile(recording, replays));
    return 0;
  }
  if (procedure->count() > 0) {
    if (procedures.empty())
      procedures = {"pci-rca-mid-focal", "pci-lad-proximal-eccentric", "pci-rca-diffuse", "pci-rca-diffuse-radial",
                    "pci-left-main-shaft"};
    std::vector<Row> rows;
    const double yardstick = yardstick_ms(quick);
    for (const std::string& script : procedures) {
      if (!json) fmt::print(stderr, "{} ...\n", script);
      rows.push_back(procedure_row(script.substr(script.find('-') + 1), script, replays));
    }
    json ? print_json(rows, yardstick) : print_table(rows, yardstick);
    return 0;
  }
  if (!json) fmt::print(stderr, "yardstick: finding its largest stable step ...\n");
  const double yardstick = yardstick_ms(quick);
  std::vector<Row> rows;
  for (auto [name, elements] : {std::pair{"rod-512-free", 512}, std::pair{"rod-4096-free", 4096}}) {
    if (!json) fmt::print(stderr, "{} ...\n", name);
    rows.push_back(free_rod(name, elements, duration));
  }
  if (!json) fmt::print(stderr, "nested rods ...\n");
  for (const Row& row : nested_rods(duration)) rows.push_back(row);
  if (!json) fmt::print(stderr, "guide and wire in a vessel ...\n");
  rows.push_back(vessel_pair("pair-in-vessel", quick));
  if (!json) fmt::print(stderr, "frames ...\n");
  rows.push_back(frame_row("frame-512", 512, false, quick));
  rows.push_back(frame_row("frame-512-rotating", 512, true, quick));
  rows.push_back(frame_row("frame-1024", 1024, false, quick));
  if (!quick) {
    if (!json) fmt::print(stderr, "flow, contrast, balloon, stent ...\n");
    rows.push_back(circulation_row(quick));
    rows.push_back(treatment_row(quick));
  }
  json ? print_json(rows, yardstick) : print_table(rows, yardstick);
  return 0;
} catch (const std::exception& error) {
  fmt::print(stderr, "ostium-bench: {}\n", error.what());
  return 3;
}
