#pragma once

namespace ostium::core {

/// How one end of a rod is held. An end that is released and held again is held where it is then.
enum class Hold : unsigned char {
  free,     ///< not held
  pinned,   ///< position held
  clamped,  ///< position and material frame held
  guided,   ///< material frame held, and position across the frame's d3; slides along d3
};

}  // namespace ostium::core
