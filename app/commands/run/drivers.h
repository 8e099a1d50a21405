#pragma once
/// Who moves the instruments of a run: its script, a tracking box, or keyboard, mouse and gamepad in the window.
#include <memory>
#include <optional>

#include "app/commands/run/run.h"
#include "app/serve/station/station.h"
#include "app/session/device/box_run.h"
#include "app/session/run/filming.h"
#include "app/session/run/play.h"
#include "app/window/window.h"

namespace ostium::app {

/// The tracking box that was asked for; null: none. If people move the tools at it, the tool movements are removed from
/// `setup`'s script.
std::unique_ptr<BoxRun> device_of(const RunArguments& arguments, RunSetup& setup);

/// Drivers are chained: the film sees the inputs of the live driver, which sees those of the box.
struct Drivers {
  std::optional<LiveDriver> hand;
  std::optional<Station> station;
  std::optional<Filming> film;

  Drivers(const RunArguments& arguments, BoxRun* device, ScriptedRun& run);
};

/// Plays here, or in the window.
PlayReport play_with(Drivers& drivers, const RunArguments& arguments, BoxRun* device, ScriptedRun& run,
                     const RunSetup& setup, const PlayOptions& options);

}  // namespace ostium::app
