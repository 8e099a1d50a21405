#include "app/commands/run/drivers.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <thread>

#include "app/command_line/interrupt.h"
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

Drivers::Drivers(const RunArguments& a, BoxRun* device, ScriptedRun& run) {
  Driver* driver = device ? &device->driver() : nullptr;
  if (a.in_window()) hand.emplace(run.model, a.device == "keyboard", 15, driver), driver = &*hand;
  if (a.film && !a.folder.empty()) {
    FilmOptions look;
    look.always_on = false, look.monitor = run.model.has_patient();
    film.emplace(run.model, (std::filesystem::path(a.folder) / "procedure.mp4").string(), look, driver);
    driver = &*film;
  }
  run.take_over(driver);
}

namespace {

bool uses_the_beam(const data::Script& script) {
  return std::any_of(script.steps.begin(), script.steps.end(), [](const data::ScriptStep& step) {
    return step.action == data::ScriptAction::fluoroscopy || step.action == data::ScriptAction::cine;
  });
}

WindowOptions window_of(const RunArguments& a, const data::Script& script, BoxRun* device, Filming* film,
                        std::atomic<bool>& over) {
  WindowOptions window;
  window.plays = a.device == "keyboard";
  window.has_pedals = window.plays || device || uses_the_beam(script);
  window.over = &over, window.last_frame_png = a.last_frame;
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
    hand.controls.press(Action::quit);
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
  if (!drivers.hand) return play(run, setup, options);
  return play_in_window(a, run, setup, device, *drivers.hand, drivers.film ? &*drivers.film : nullptr, options);
}

}  // namespace ostium::app
