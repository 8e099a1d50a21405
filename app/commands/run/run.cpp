#include "app/commands/run/run.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/command_line/arguments.h"
#include "app/command_line/command.h"
#include "app/command_line/common_options.h"
#include "app/command_line/filled_folder.h"
#include "app/command_line/interrupt.h"
#include "app/command_line/pictures.h"
#include "app/command_line/progress.h"
#include "app/commands/report.h"
#include "app/commands/run/drivers.h"
#include "app/commands/run/record_option.h"
#include "app/commands/run/report.h"
#include "data/formats/load_error.h"
#include "data/formats/write_file.h"
#include "vascular/geometry/mesh_files/open_end.h"

namespace ostium::app {

namespace {

namespace fs = std::filesystem;

void declare(Options& options, RunArguments& a) {
  options
      .add("vessel", a.session.vessel, "A case (`ostium cases`, or a file), or a closed mesh: STL, PLY, OBJ, VTP, ...")
      .type("CASE|MESH")
      .required();
  add_session_options(options, a.session);
  options.add("--seed", a.session.seed, "0: exactly as the script says; others vary hands, roll and the heart's moment")
      .show_default();
  options.add("--out", a.folder, "Where run.h5 and metrics.json go").type("DIR");
  options.add("--record", a.record, record_help()).type(record_words()).show_default();
  options.add("--speed", a.speed, "real: a step a millisecond; the result is the same")
      .one_of({"real", "max"})
      .show_default();
  options
      .add(
          "--device", a.device,
          "Hands at a tracking box instead of the script's: usb; auto: usb if one is plugged in; emulator: a "
          "scripted hand at an emulated box, which does what the script asks; keyboard: keyboard, mouse or gamepad, in "
          "the window")
      .one_of({"auto", "usb", "emulator", "keyboard"});
  options.add("--display", a.display, "window: watch it live, in real time").one_of({"none", "window"}).show_default();
  options.add("--last-frame", a.last_frame, "The window's last picture").type("FILE.png").writes();
  options.add("--serve", a.serve, "A trainer's station in the browser beside it, at this port (0: any), in real time")
      .type("PORT")
      .range(0, 65535);
  add_box_serial_option(options, a.serial);
  options.flag("--film", a.film, "Film it as it goes: DIR/procedure.mp4");
  add_renderer_option(options, a.renderer);
  options.flag("--report", a.report, "DIR/report.html, events.csv and key-frames/");
  add_json_flag(options, a.json, "run.schema.json");
}

/// Shows the script's current step, and how deep the tools are.
void show_tools(const ScriptedRun& run) {
  const double now = seconds(run.model, run.state);
  const auto s = static_cast<std::size_t>(run.hands.step);
  if (s >= run.plan.script.steps.size()) return;
  std::string tools;
  for (std::size_t t = 0; t < run.model.tools.size(); ++t)
    tools += fmt::format("  {} {:.0f} mm {:.2f} N", run.model.tools[t].name, 1e3 * run.state.rods.rods[t].inserted_m,
                         run.report.tools[t].wall_force_N);
  show_progress(fmt::format("{:7.1f} s  {}{}", now, run.plan.script.steps[s].words(), tools));
}

RecorderOptions recorder_options_of(const RunArguments& a) {
  RecorderOptions recorder = recorder_of(a.record);
  if (a.folder.empty())
    recorder.mode = RecordMode::none;
  else
    recorder.file = (fs::path(a.folder) / "run.h5").string();
  return recorder;
}

PlayOptions play_options(const RunArguments& a, BoxRun* device) {
  PlayOptions options;
  options.recorder = recorder_options_of(a);
  options.real = a.speed == "real" || (device && device->real());
  options.seconds = a.session.seconds;
  options.progress = [device, shown = LastingProblem()](const ScriptedRun& now) mutable {
    const std::string_view problem = device ? advice(device->hand().now()) : "";
    if (problem.empty()) show_tools(now);
    shown.show(fmt::format("{:7.1f} s", seconds(now.model, now.state)), problem);
  };
  options.stop = &interrupted;
  return options;
}

void tell(const RunArguments& a, const RunSetup& setup, const ScriptedRun& run, const PlayReport& report,
          const std::string& file, const BoxRun* device) {
  if (a.json) {
    auto out = to_json(setup, run, report, file);
    if (device) out["device"] = to_json(device->hand());
    fmt::print("{}\n", out.dump(2));
  } else {
    print_report(run, report, file);
    if (device) print_report(device->hand());
  }
}

/// Before anything is made.
void require_arguments(const RunArguments& a) {
  const RecorderOptions recorder = recorder_of(a.record);
  if (a.folder.empty() && (a.film || a.report))
    throw data::LoadError(std::string(a.film ? "--film" : "--report") + " has no place; expected --out DIR with it");
  if (a.report && recorder.mode == RecordMode::none)
    throw data::LoadError("--report is made of a recording; expected another --record than none");
  if (!a.last_frame.empty() && !a.in_window())
    throw data::LoadError("--last-frame is of the window; expected --display window with it");
  if (!a.serial.empty() && (a.device.empty() || a.device == "keyboard"))
    throw data::LoadError("--serial is of a tracking box; expected --device usb, or auto, with it");
  if (a.device == "emulator") require_emulated_box(a.serial);
  if (!a.last_frame.empty()) require_ending(a.last_frame, {".png"});
}

}  // namespace

std::shared_ptr<const Vessel> build_vessel(RunSetup& setup, const std::string& command) {
  show_progress("building " + setup.vessel);
  std::string warnings;
  auto vessel = make_vessel(setup, warnings);
  if (!warnings.empty())
    fmt::print(stderr, "ostium {}: of {}, near whose faults nothing is held back:\n{}", command, setup.vessel,
               warnings);
  if (const std::string doubt = setup.is_mesh() ? vascular::doubt_of_mesh_end(setup.vessel) : ""; !doubt.empty())
    fmt::print(stderr, "ostium {}: {}\n", command, doubt);
  for (const std::string& size : choose_sizes(*vessel, setup)) fmt::print(stderr, "{}, chosen by the vessel\n", size);
  return vessel;
}

int run_script(const RunArguments& a) {
  require_arguments(a);
  if (std::string why; a.in_window() && !has_display(why))
    throw data::LoadError("there is no window here (" + why + "); expected a display, or --display none with a script");
  RunSetup setup = setup_of(a.session);
  const FilledFolder folder(a.folder);
  const auto device = device_of(a, setup);
  PlayOptions options = play_options(a, device.get());
  const auto vessel = build_vessel(setup, "run");
  ScriptedRun run(setup, vessel);
  stop_on_signals();
  Drivers drivers(a, device.get(), run);
  if (drivers.station) options.recorder.heard = drivers.station->ear(), options.real = true;
  const PlayReport report = play_with(drivers, a, device.get(), run, setup, options);
  if (drivers.station) drivers.station->keep_notes();
  const std::string film_problem = drivers.film ? drivers.film->finish() : "";
  show_progress("");
  const bool recorded = options.recorder.mode != RecordMode::none;
  if (!a.folder.empty())
    data::write_file((fs::path(a.folder) / "metrics.json").string(),
                     metrics_json(setup.vessel, setup.seed, report.outcome, report.reason, report.metrics));
  tell(a, setup, run, report, recorded ? options.recorder.file : "", device.get());
  if (!film_problem.empty()) fmt::print(stderr, "ostium run: no film: {}\n", film_problem);
  if (a.report && recorded && report.problem.empty())
    report_folder(a.folder, vessel, "run.h5", data::find_score_list("pci-elective"), renderer_named(a.renderer));
  if (!report.problem.empty()) {
    fmt::print(stderr, "ostium run: the recording ends early: {}\n", report.problem);
    return 1;
  }
  if (device && device->hand().now().reports == 0) {
    fmt::print(stderr,
               "ostium run: the tracking box never answered, so nobody moved an instrument; `ostium device list` says "
               "what is plugged in\n");
    return 1;
  }
  return report.outcome == "success" || report.outcome == "ended" ? 0 : 1;
}

Command run_command() {
  return make_command("run", "Runs a script on a case, or in a mesh",
                      {"ostium run rca-mid-focal --script aorta-arch-wire --out out",
                       "ostium run lad-proximal-eccentric --set wire=bentson --set person=3 --seed 7 --json",
                       "ostium run rca-mid-focal --script jr4-engages-rca --device usb --out out",
                       "ostium run rca-mid-focal --script jr4-engages-rca --device keyboard --out out",
                       "ostium run aorta.obj --entry -20,80,14 --towards -20,90,14 --script my-script.json"},
                      declare, run_script);
}

}  // namespace ostium::app
