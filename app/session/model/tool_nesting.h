#pragma once
/// Which of a session's tools run in which, and what lies side by side. Internal to the session's model; see
/// in_the_way.
#include <vector>

#include "app/session/model/session.h"

namespace ostium::app {

/// Throws LoadError naming tools in the wrong order, or wires that a balloon does not run over, or does not choose.
void require_nesting(const std::vector<SessionTool>& tools);

/// All pairs of which one fits through the other's lumen, but for wires that a balloon does not run over.
std::vector<core::Nesting> nestings_of(const std::vector<SessionTool>& tools);

}  // namespace ostium::app
