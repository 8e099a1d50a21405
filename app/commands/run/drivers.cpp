#include "app/commands/run/drivers.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <thread>

#include "app/command_line/interrupt.h"
#include "app/command_line/links.h"
#include "app/command_line/pictures.h"
#include "app/command_line/progress.h"
#include "core/base/units.h"
#include "device/transport/usb_port.h"
#include "fluoro/projection/views.h"

namespace ostium::app {

/// The tracking box that was asked for; null: none. If people move the tools at it, the tool movements are removed from
/// `setup`'s script.
std::unique_ptr<BoxRun> device_of(const RunArguments& a, RunSetup& setup) {
  if (a.device == "keyboard") {
    setup.script = free_hands(setup.script);
    return nullptr;
  }
  if (a.device.empty() || (a.device == "auto" && device::find_boxes().empty())) return nullptr;
  BoxDriverSettings settings;
  for (const fluoro::StandardView& view : fluoro::standard_views())
    settings.views.emplace_back(view.lao_deg * units::pi / 180, view.cran_deg * units::pi / 180);
  settings.watch = [before = device::Pause::none](const device::BoxSnapshot& now) mutable {
    if (now.pause != before && now.pause != device::Pause::none)
      show_progress(std::string(advice(now)));  // nothing is simulated now
    before = now.pause;
  };
  if (a.device == "emulator") return run_at_emulator(settings, &interrupted);
  setup.script = free_hands(setup.script);
  return run_at_usb(a.serial, settings, &interrupted);
}

namespace {

bool uses_the_beam(const data::Script& script) {
  return std::any_of(script.steps.begin(), script.steps.end(), [](const data::ScriptStep& step) {
    return step.action == data::ScriptAction::fluoroscopy || step.action == data::ScriptAction::cine;
  });
}

bool has_pedals(const RunArguments& a, const BoxRun* device, const data::Script& script) {
  return a.device == "keyboard" || device || uses_the_beam(script);
}

}  // namespace

Drivers::Drivers(const RunArguments& a, BoxRun* device, ScriptedRun& run) {
  Driver* driver = device ? &device->driver() : nullptr;
  const Hands hands = a.device == "keyboard" ? Hands::seats : device ? Hands::box : Hands::script;
  if (a.in_window() || a.serve) hand.emplace(run.model, hands, 15, driver), driver = &*hand;
  if (hand) hand->end_on(interrupted);
  if (a.serve) {
    StationSettings settings;
    settings.port = static_cast<std::uint16_t>(*a.serve);
    settings.has_pedals = has_pedals(a, device, run.plan.script);
    settings.renderer = renderer_named(a.renderer);
    settings.folder = a.folder;
    station.emplace(run, *hand, data::find_score_list("pci-elective"), settings);
    tell_links("trainer", station->trainer_link(), station->viewer_link(), false);
  }
  if (a.film && !a.folder.empty()) {
    FilmOptions look;
    look.always_on = false, look.monitor = run.model.has_patient();
    look.renderer = renderer_named(a.renderer);
    film.emplace(run.model, (std::filesystem::path(a.folder) / "procedure.mp4").string(), look, driver);
    driver = &*film;
  }
  run.take_over(driver);
}

namespace {

WindowOptions window_of(const RunArguments& a, const data::Script& script, BoxRun* device, Filming* film,
                        std::atomic<bool>& over) {
  WindowOptions window;
  window.has_pedals = has_pedals(a, device, script);
  window.over = &over, window.last_frame_png = a.last_frame;
  window.renderer = renderer_named(a.renderer);
  if (film) window.filmed = &film->pictures();
  if (device) {
    window.problem = [device] { return std::string(advice(device->hand().shown())); };
    window.brightness = [device] { return device->hand().shown().picture; };
  }
  return window;
}

/// Plays in another thread while this thread shows the window. The window shows the film's pictures if a film is made,
/// else its own.
PlayReport play_in_window(const RunArguments& a, ScriptedRun& run, const RunSetup& setup, BoxRun* device,
                          LiveDriver& hand, Filming* film, PlayOptions options) {
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
  try {
    show_window(run.model, run.plan, hand, window_of(a, run.plan.script, device, film, over));
  } catch (...) {
    hand.controls(Seat::window).order(ConsoleCommand::end);
    steps.join();
    throw;
  }
  steps.join();
  if (failed) std::rethrow_exception(failed);
  return report;
}

}  // namespace

PlayReport play_with(Drivers& drivers, const RunArguments& a, BoxRun* device, ScriptedRun& run, const RunSetup& setup,
                     const PlayOptions& options) {
  if (!a.in_window()) return play(run, setup, options);
  return play_in_window(a, run, setup, device, *drivers.hand, drivers.film ? &*drivers.film : nullptr, options);
}

}  // namespace ostium::app
