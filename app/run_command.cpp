#include "app/run_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <exception>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/report_command.h"
#include "app/session/device_run.h"
#include "app/session/filming.h"
#include "app/session/play.h"
#include "app/window/window.h"
#include "data/formats/load_error.h"
#include "data/formats/write_file.h"
#include "device/usb_port.h"
#include "fluoro/views.h"
#include "vascular/patient_frame.h"

namespace ostium {

namespace {

namespace fs = std::filesystem;

std::atomic<bool> interrupted{false};

void say(const std::string& what) {
  if (isatty(STDERR_FILENO)) fmt::print(stderr, "{:<100}\r", what);
}

/// "X,Y,Z" in the mesh's unit.
Eigen::Vector3d point(const std::string& text, const char* option, LengthUnit unit) {
  double x, y, z;
  char rest;
  if (std::sscanf(text.c_str(), "%lf,%lf,%lf%c", &x, &y, &z, &rest) != 3)
    throw LoadError(fmt::format("{} is \"{}\"; expected three numbers: X,Y,Z", option, text));
  return metres(unit) * Eigen::Vector3d(x, y, z);
}

void show_progress(const ScriptedRun& run) {
  const double now = seconds(run.model, run.state);
  const auto s = static_cast<std::size_t>(run.hands.step);
  if (s >= run.plan.script.steps.size()) return;
  std::string tools;
  for (std::size_t t = 0; t < run.model.tools.size(); ++t)
    tools += fmt::format("  {} {:.0f} mm {:.2f} N", run.model.tools[t].name, 1e3 * run.state.rods.rods[t].inserted_m,
                         run.report.tools[t].wall_force_N);
  say(fmt::format("{:7.1f} s  {}{}", now, run.plan.script.steps[s].words(), tools));
}

/// What is asked for; null: no box. With a box and people, `setup` loses what its script does to tools.
std::unique_ptr<DeviceRun> device_of(const RunOptions& o, RunSetup& setup) {
  if (o.device == "keyboard") {
    setup.script = free_hands(setup.script);
    return nullptr;
  }
  if (o.device.empty() || (o.device == "auto" && find_boxes().empty())) return nullptr;
  DeviceHandSettings settings;
  for (const StandardView& view : standard_views())
    settings.views.emplace_back(view.lao_deg * EIGEN_PI / 180, view.cran_deg * EIGEN_PI / 180);
  settings.watch = [before = Pause::none](const BoxSnapshot& now) mutable {
    if (now.pause != before && now.pause != Pause::none) say(std::string(advice(now)));  // nothing steps now
    before = now.pause;
  };
  if (o.device == "emulator") return run_at_emulator(settings, &interrupted);
  setup.script = free_hands(setup.script);
  return run_at_usb(o.serial, settings, &interrupted);
}

nlohmann::ordered_json to_json(const DeviceHand& hand) {
  const BoxSnapshot& now = hand.now();
  return {{"stood", hand.stood()},  {"openings", now.openings},          {"reports", now.reports}, {"lost", now.lost},
          {"ignored", now.ignored}, {"departures", now.port.departures}, {"advice", advice(now)}};
}

nlohmann::ordered_json to_json(const RunSetup& setup, const ScriptedRun& run, const PlayReport& r,
                               const std::string& file) {
  nlohmann::ordered_json out = {{"case", setup.vessel},
                                {"script", setup.script.name},
                                {"seed", setup.seed},
                                {"outcome", r.outcome},
                                {"reason", r.reason},
                                {"simulated_s", r.simulated_s},
                                {"clock_s", r.clock_s},
                                {"deepest_penetration_mm", 1e3 * r.penetration.deepest_m},
                                {"nodes_outside", r.penetration.outside},
                                {"step_ms",
                                 {{"mean", r.times.mean_ms},
                                  {"p50", r.times.p50_ms},
                                  {"p99", r.times.p99_ms},
                                  {"p999", r.times.p999_ms},
                                  {"most", r.times.most_ms}}},
                                {"overruns", r.times.overruns},
                                {"behind_most_ms", r.times.behind_most_ms},
                                {"troubled_steps", run.troubled},
                                {"trouble", trouble_words(run.troubles)},
                                {"hash", fmt::format("{:016x}", r.hash)},
                                {"recording", file},
                                {"recording_problem", r.problem}};
  out["metrics"] =
      nlohmann::ordered_json::parse(metrics_json(setup.vessel, setup.seed, r.outcome, r.reason, r.metrics))["metrics"];
  return out;
}

void print_report(const ScriptedRun& run, const PlayReport& r, const std::string& file) {
  fmt::print("{}{}{}\n", r.outcome, r.reason.empty() ? "" : ": ", r.reason);
  fmt::print("{:.3f} s simulated in {:.1f} s; deepest in the wall {:.3f} mm, {} nodes found outside\n", r.simulated_s,
             r.clock_s, 1e3 * r.penetration.deepest_m, r.penetration.outside);
  fmt::print("step {:.2f} ms of CPU, p50 {:.2f}, p99 {:.2f}, p99.9 {:.2f}, most {:.1f}\n", r.times.mean_ms,
             r.times.p50_ms, r.times.p99_ms, r.times.p999_ms, r.times.most_ms);
  if (r.times.behind_most_ms > 0)
    fmt::print("{} steps began over a millisecond late, at most {:.1f} ms\n", r.times.overruns, r.times.behind_most_ms);
  if (run.troubled) fmt::print("{} steps had to give way: {}\n", run.troubled, trouble_words(run.troubles));
  for (const Metric& m : r.metrics)
    if (std::isfinite(m.value)) fmt::print("  {:<32} {:.4g} {}\n", m.name, m.value, m.unit == "1" ? "" : m.unit);
  fmt::print("state {:016x}{}{}\n", r.hash, file.empty() ? "" : ", recorded in ", file);
}

}  // namespace

RunSetup setup_of(const RunOptions& o) {
  const LengthUnit unit = o.unit == "m"    ? LengthUnit::metre
                          : o.unit == "cm" ? LengthUnit::centimetre
                                           : LengthUnit::millimetre;
  RunSetup setup;
  setup.seed = o.seed;
  set_vessel(o.vessel, unit, setup);
  if (setup.is_mesh()) {
    if (o.entry.empty() || o.towards.empty())
      throw LoadError(o.vessel + " is a mesh: --entry X,Y,Z and --towards X,Y,Z say where an instrument comes in");
    setup.entry = {point(o.entry, "--entry", unit), point(o.towards, "--towards", unit)};
  } else if (!o.entry.empty() || !o.towards.empty()) {
    throw LoadError("--entry and --towards are for a mesh; a case has its access");
  }
  set_script(find_script(o.script), setup);
  for (const std::string& set : o.set) {
    const std::size_t equals = set.find('=');
    if (equals == std::string::npos || equals == 0) throw LoadError(fmt::format("--set {}: expected KEY=VALUE", set));
    set_value(set.substr(0, equals), set.substr(equals + 1), setup);
  }
  return setup;
}

namespace {

/// Plays in another thread while the window is up in this one, with the film's pictures if a film is made; else null.
PlayReport play_in_window(const RunOptions& o, ScriptedRun& run, const RunSetup& setup, DeviceRun* device,
                          LiveHand& hand, Filming* film, PlayOptions options) {
  options.real = true;
  std::atomic<bool> over{false};
  PlayReport report;
  std::exception_ptr failed;
  std::thread steps([&] {
    try {
      report = play(run, setup, options);
    } catch (...) {
      failed = std::current_exception();
    }
    over = true;
  });
  WindowOptions window;
  window.plays = o.device == "keyboard", window.over = &over, window.last_frame_png = o.last_frame;
  if (film) window.filmed = &film->pictures();
  if (device) {
    window.problem = [device] { return std::string(advice(device->hand().shown())); };
    window.brightness = [device] { return device->hand().shown().picture; };
  }
  try {
    show_window(run.model, run.plan, hand, window);
  } catch (...) {
    hand.controls.press(Action::quit);
    steps.join();
    throw;
  }
  steps.join();
  if (failed) std::rethrow_exception(failed);
  return report;
}

}  // namespace

int run_command(const RunOptions& o) {
  const bool in_window = o.display == "window" || o.device == "keyboard";
  if (std::string why; in_window && !has_display(why))
    throw LoadError("there is no window here (" + why + "); expected a display, or --display none with a script");
  RunSetup setup = setup_of(o);
  const auto device = device_of(o, setup);
  PlayOptions options;
  options.recorder.mode = o.folder.empty() || o.record == "none" ? RecordMode::none
                          : o.record == "events"                 ? RecordMode::events
                                                                 : RecordMode::full;
  if (!o.folder.empty()) {
    std::error_code error;
    fs::create_directories(o.folder, error);
    if (error) throw LoadError(fmt::format("{}: cannot be made ({}); expected a folder", o.folder, error.message()));
    options.recorder.file = (fs::path(o.folder) / "run.h5").string();
  }
  say("building " + setup.vessel);
  std::string warnings;
  const auto vessel = make_vessel(setup, warnings);
  if (!warnings.empty())
    fmt::print(stderr, "ostium run: of {}, near whose faults nothing is held back:\n{}", setup.vessel, warnings);
  for (const std::string& size : choose_sizes(*vessel, setup)) fmt::print(stderr, "{}, chosen by the vessel\n", size);
  ScriptedRun run(setup, vessel);
  options.real = o.real || (device && device->real());
  options.seconds = o.seconds;
  options.progress = [&](const ScriptedRun& now) {
    const std::string_view problem = device ? advice(device->hand().now()) : "";
    if (problem.empty())
      show_progress(now);
    else
      say(fmt::format("{:7.1f} s  {}", seconds(now.model, now.state), problem));
  };
  options.stop = &interrupted;
  const auto ask_to_stop = [](int) { interrupted = true; };
  std::signal(SIGINT, ask_to_stop);
  std::signal(SIGTERM, ask_to_stop);
  // Each asks the next: the film sees what hands ask for, they what the box says.
  Driver* driver = device ? &device->driver() : nullptr;
  std::optional<LiveHand> hand;
  if (in_window) hand.emplace(run.model, o.device == "keyboard", 15, driver), driver = &*hand;
  std::optional<Filming> film;
  if (o.film && !o.folder.empty()) {
    FilmOptions look;
    look.always_on = false, look.monitor = run.model.has_patient();
    film.emplace(run.model, (fs::path(o.folder) / "procedure.mp4").string(), look, driver);
    driver = &*film;
  }
  run.take_over(driver);
  const PlayReport report = hand ? play_in_window(o, run, setup, device.get(), *hand, film ? &*film : nullptr, options)
                                 : play(run, setup, options);
  const std::string film_problem = film ? film->finish() : "";
  say("");
  const std::string file = options.recorder.mode == RecordMode::none ? "" : options.recorder.file;
  if (!o.folder.empty())
    write_file((fs::path(o.folder) / "metrics.json").string(),
               metrics_json(setup.vessel, setup.seed, report.outcome, report.reason, report.metrics));
  if (o.json) {
    auto out = to_json(setup, run, report, file);
    if (device) out["device"] = to_json(device->hand());
    fmt::print("{}\n", out.dump(2));
  } else {
    print_report(run, report, file);
    if (device)
      fmt::print("at the box: {} reports, {} lost, {} ignored; stood {} times at an end of the travel\n",
                 device->hand().now().reports, device->hand().now().lost, device->hand().now().ignored,
                 device->hand().stood());
  }
  if (!film_problem.empty()) fmt::print(stderr, "ostium run: no film: {}\n", film_problem);
  if (o.report && options.recorder.mode != RecordMode::none && report.problem.empty()) report_folder(o.folder, vessel);
  if (!report.problem.empty()) {
    fmt::print(stderr, "ostium run: the recording ends early: {}\n", report.problem);
    return 1;
  }
  return report.outcome == "success" ? 0 : 1;
}

int demonstration_command(const std::string& folder) {
  RunOptions o;
  o.vessel = "rca-mid-focal", o.script = "pci-rca-mid-focal";
  o.folder = folder, o.film = o.report = true;
  std::string why;
  if (has_display(why)) o.display = "window";
  fmt::print(
      stderr,
      "A right coronary angioplasty by script, from the groin to the last film{}. What comes of it goes to {}.\n",
      why.empty() ? "" : ", without a window (" + why + ")", folder);
  const int code = run_command(o);
  fmt::print(
      "\n{0}/report.html: what happened; procedure.mp4, key-frames/, run.h5, metrics.json, events.csv beside it\n"
      "Yourself: ostium run rca-mid-focal --script pci-rca-mid-focal --device keyboard --out mine\n"
      "More: ostium --help\n",
      folder);
  return code;
}

int scripts_command(bool json) {
  const std::vector<Script> scripts = load_scripts();
  if (json) {
    auto out = nlohmann::ordered_json::array();
    for (const Script& s : scripts) {
      nlohmann::ordered_json tools;
      for (const ScriptTool& tool : s.tools) tools.push_back({{"name", tool.name}, {"instrument", tool.instrument}});
      out.push_back({{"name", s.name}, {"title", s.title}, {"steps", s.steps.size()}, {"tools", tools}});
    }
    fmt::print("{}\n", out.dump(2));
    return 0;
  }
  std::size_t width = 0;
  for (const Script& s : scripts) width = std::max(width, s.name.size());
  for (const Script& s : scripts) fmt::print("{:<{}} {:>2} steps  {}\n", s.name, width, s.steps.size(), s.title);
  return 0;
}

}  // namespace ostium
