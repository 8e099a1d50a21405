#pragma once
/// What the expert of a script does, as a beginner reads it.
#include <string>
#include <vector>

#include "data/catalogue/script/script.h"

namespace ostium::app {

/// "The expert pushes the wire in, 40 mm a second, turning it, until 25 cm of it are in."
std::string hint_of(const data::Script& script, const data::ScriptStep& step);

/// Those of the labelled steps from `from` on, `most` at most, and not those from `end` on.
std::vector<std::string> hints_of(const data::Script& script, int from, int end, std::size_t most = 4);

}  // namespace ostium::app
