#pragma once
/// Who moves the instruments of a run: its script, a tracking box, or hands at the window.
#include <memory>
#include <optional>

#include "app/commands/run/run.h"
#include "app/session/device/box_run.h"
#include "app/session/run/filming.h"
#include "app/session/run/play.h"
#include "app/window/window.h"

namespace ostium::app {

/// What is asked for; null: no box. With a box and people, `setup` loses what its script does to tools.
std::unique_ptr<BoxRun> device_of(const RunArguments& arguments, RunSetup& setup);

/// Each asks the next: the film sees what hands ask for, they what the box says.
struct Drivers {
  std::optional<LiveDriver> hand;
  std::optional<Filming> film;

  Drivers(const RunArguments& arguments, BoxRun* device, ScriptedRun& run);
};

/// Here, or in the window.
PlayReport play_with(Drivers& drivers, const RunArguments& arguments, BoxRun* device, ScriptedRun& run,
                     const RunSetup& setup, const PlayOptions& options);

}  // namespace ostium::app
