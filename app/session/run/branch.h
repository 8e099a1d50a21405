#pragma once
/// A run that goes back to an earlier second of its own recording, to go on from there otherwise.
#include "app/session/recorder/recorder.h"
#include "app/session/run/run.h"

namespace ostium::app {

/// Afterwards `run` is as it was after that many steps: the second before is repeated from its inputs. Returns a watch
/// for events that has seen that second. Throws LoadError if the recording is shorter, or not of this run.
std::shared_ptr<EventWatch> go_back(ScriptedRun& run, const Continued& to);

}  // namespace ostium::app
