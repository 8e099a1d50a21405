#pragma once
/// A film of two runs side by side, stage by stage (data/assessment/stages.h): each goes on as it did, and who is
/// through a stage first waits for the other.
#include <array>

#include "app/session/run/replay.h"
#include "data/assessment/stages.h"
#include "fluoro/projection/path_lengths.h"

namespace ostium::app {

/// Both from their beginning. False: it could not be written, and was said. Ctrl-C ends it with the frames that there
/// are. Throws LoadError as a replay does.
bool film_side_by_side(std::array<Replay, 2>& replays, const std::vector<data::ReportRun>& runs,
                       const std::string& file, fluoro::Renderer renderer);

}  // namespace ostium::app
