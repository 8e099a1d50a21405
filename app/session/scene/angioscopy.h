#pragma once
/// What a camera inside an artery sees: its wall, the struts of stents, instruments. It is lit by its own lamp.
#include <cstdint>
#include <string>
#include <vector>

#include "app/session/model/session.h"

namespace ostium::app {

struct Angioscopy {
  int pixels = 0;                 ///< a side
  std::vector<std::uint8_t> rgb;  ///< 3 * pixels * pixels bytes, rows from the top
};

/// From the middle of a branch's parent, 4 mm before the branch leaves it, towards the branch's mouth. Throws LoadError
/// for what is no side branch of the coronary arteries. Takes a few seconds.
Angioscopy look_inside(const SessionModel& model, const SessionState& state, const std::string& branch, int pixels);

}  // namespace ostium::app
